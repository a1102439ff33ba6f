/* The reader that continues the tangents harmonically: conjugate gradients (Hestenes and
 * Stiefel 1952), begun on each raster from the solution on the one with half as many
 * cells a side (Bornemann and Deuflhard 1996). */
#include "score/reader.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the residual; the mean angle is then off by less than 0.01 degrees (the tests). */
static const double USUAL_TOLERANCE = 1e-5;

enum { MOST_LEVELS = 16, SMALLEST_SIDE = 8, MOST_ITERATIONS = 100000 };

enum { OUTSIDE = 0, UNKNOWN = 1, FIXED = 2 };

/* A raster with a layer of outside cells around, in 2D none across z. */
typedef struct level {
  int dimension, size[3], margin; /* margin along z */
  ptrdiff_t step[3];
  size_t cells;
  unsigned char *kind;
  double *degree;   /* neighbours in the domain, of an unknown cell; else 0 */
  double *value[3]; /* 0 outside */
} level;

static size_t place_of(const level *l, int i, int j, int k)
{
  return (size_t)((k + l->margin) * l->step[2] + (j + 1) * l->step[1] + (i + 1));
}

static fg_status level_create(level *out, fg_context *context, int dimension,
                              const int size[3])
{
  *out = (level){.dimension = dimension, .margin = dimension == 3};
  memcpy(out->size, size, sizeof out->size);
  out->step[0] = 1;
  out->step[1] = size[0] + 2;
  out->step[2] = out->step[1] * (size[1] + 2);
  out->cells = (size_t)out->step[2] * (size_t)(size[2] + 2 * out->margin);
  out->kind = fg__allocate(out->cells, 1);
  out->degree = fg__allocate(out->cells, sizeof(double));
  bool all = out->kind && out->degree;
  for (int k = 0; k < dimension; ++k) {
    out->value[k] = fg__allocate(out->cells, sizeof(double));
    all = all && out->value[k];
  }
  return all ? FG_STATUS_OK
             : fg__fail_memory(context, "a raster to diffuse on",
                               out->cells * (size_t)(1 + dimension) * sizeof(double));
}

static void level_clear(level *l)
{
  free(l->kind);
  free(l->degree);
  for (int k = 0; k < 3; ++k)
    free(l->value[k]);
}

/* Makes the sum of tangents in a cell a unit vector, which fixes the cell; tangents that
 * cancel each other tell nothing. */
static void fix(level *l, size_t n)
{
  double length = 0.0;
  for (int k = 0; k < l->dimension; ++k)
    length += l->value[k][n] * l->value[k][n];
  length = sqrt(length);
  for (int k = 0; k < l->dimension; ++k)
    l->value[k][n] = length > 0.0 ? l->value[k][n] / length : 0.0;
  if (length > 0.0)
    l->kind[n] = FIXED;
}

static void add_tangents(level *l, const fg__score_raster *raster,
                         const fg__samples *samples)
{
  for (size_t n = 0; n < samples->count; ++n) {
    size_t found;
    if (!fg__score_raster_find(raster, samples->position[n], &found) ||
        !raster->inside[found])
      continue;
    const size_t columns = (size_t)l->size[0], rows = (size_t)l->size[1];
    const size_t place =
        place_of(l, (int)(found % columns), (int)(found / columns % rows),
                 (int)(found / columns / rows));
    for (int k = 0; k < l->dimension; ++k)
      l->value[k][place] += samples->tangent[n][k];
  }
  for (size_t n = 0; n < l->cells; ++n)
    if (l->kind[n] != OUTSIDE)
      fix(l, n);
}

/* Every fixed cell leads to its neighbours, and they to theirs; parts of the domain that
 * are not reached become outside. `queue` has room for all cells. */
static void leave_out_unreached(level *l, size_t *queue, unsigned char *reached)
{
  size_t begin = 0, end = 0;
  for (size_t n = 0; n < l->cells; ++n)
    if (l->kind[n] == FIXED) {
      reached[n] = 1;
      queue[end++] = n;
    }
  while (begin < end) {
    const size_t at = queue[begin++];
    for (int side = 0; side < 2 * l->dimension; ++side) {
      const ptrdiff_t step = side % 2 ? l->step[side / 2] : -l->step[side / 2];
      const size_t next = (size_t)((ptrdiff_t)at + step);
      if (l->kind[next] != OUTSIDE && !reached[next]) {
        reached[next] = 1;
        queue[end++] = next;
      }
    }
  }
  for (size_t n = 0; n < l->cells; ++n)
    if (!reached[n])
      l->kind[n] = OUTSIDE;
}

static fg_status fill_finest(level *l, fg_context *context,
                             const fg__score_raster *raster, const fg__samples *samples)
{
  const unsigned char *inside = raster->inside;
  size_t *queue = fg__allocate(l->cells, sizeof *queue);
  unsigned char *reached = fg__allocate(l->cells, 1);
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < l->size[2]; ++k)
    for (int j = 0; j < l->size[1]; ++j)
      for (int i = 0; i < l->size[0]; ++i)
        l->kind[place_of(l, i, j, k)] = *inside++ ? UNKNOWN : OUTSIDE;
  add_tangents(l, raster, samples);
  if (queue && reached)
    leave_out_unreached(l, queue, reached);
  else
    status = fg__fail_memory(context, "a raster's parts", l->cells * sizeof *queue);
  free(queue);
  free(reached);
  return status;
}

static void count_neighbours(level *l)
{
  const ptrdiff_t *step = l->step;
  for (size_t n = 0; n < l->cells; ++n) {
    if (l->kind[n] != UNKNOWN)
      continue;
    const unsigned char *kind = l->kind + n;
    int neighbours = 0;
    for (int k = 0; k < l->dimension; ++k)
      neighbours += (kind[step[k]] != OUTSIDE) + (kind[-step[k]] != OUTSIDE);
    l->degree[n] = neighbours;
  }
}

static void add_to_coarse(level *coarse, const level *fine, size_t to, size_t from)
{
  if (fine->kind[from] == OUTSIDE)
    return;
  if (coarse->kind[to] == OUTSIDE)
    coarse->kind[to] = UNKNOWN;
  for (int k = 0; fine->kind[from] == FIXED && k < fine->dimension; ++k)
    coarse->value[k][to] += fine->value[k][from];
}

/* Two cells a side become one. */
static fg_status coarsen(level *coarse, fg_context *context, const level *fine)
{
  int size[3] = {1, 1, 1};
  for (int k = 0; k < fine->dimension; ++k)
    size[k] = (fine->size[k] + 1) / 2;
  fg_status status = level_create(coarse, context, fine->dimension, size);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < fine->size[2]; ++k)
    for (int j = 0; j < fine->size[1]; ++j)
      for (int i = 0; i < fine->size[0]; ++i)
        add_to_coarse(coarse, fine, place_of(coarse, i / 2, j / 2, k / 2),
                      place_of(fine, i, j, k));
  for (size_t n = 0; n < coarse->cells; ++n)
    if (coarse->kind[n] != OUTSIDE)
      fix(coarse, n);
  return status;
}

/* From the 4, in 3D 8, nearest coarse cells in the domain, 3 : 1 along each axis. */
static void interpolate_cell(level *fine, const level *coarse, size_t to, size_t from,
                             const int at[3])
{
  double weights = 0.0, sum[3] = {0.0};
  for (int corner = 0; corner < 1 << fine->dimension; ++corner) {
    ptrdiff_t place = (ptrdiff_t)from;
    double weight = 1.0;
    for (int k = 0; k < fine->dimension; ++k) {
      const bool far = corner >> k & 1;
      weight *= far ? 0.25 : 0.75;
      place += !far ? 0 : at[k] % 2 ? coarse->step[k] : -coarse->step[k];
    }
    if (coarse->kind[place] == OUTSIDE)
      continue;
    weights += weight;
    for (int k = 0; k < fine->dimension; ++k)
      sum[k] += weight * coarse->value[k][place];
  }
  for (int k = 0; k < fine->dimension; ++k)
    fine->value[k][to] = sum[k] / weights;
}

static void interpolate(level *fine, const level *coarse)
{
  for (int k = 0; k < fine->size[2]; ++k)
    for (int j = 0; j < fine->size[1]; ++j)
      for (int i = 0; i < fine->size[0]; ++i) {
        const size_t to = place_of(fine, i, j, k);
        if (fine->kind[to] == UNKNOWN)
          interpolate_cell(fine, coarse, to, place_of(coarse, i / 2, j / 2, k / 2),
                           (int[3]){i, j, k});
      }
}

/* The vectors of the iteration; all are 0 where no cell is unknown. */
typedef struct vectors {
  double *residual[3], *search[3], *product[3];
  double *memory;
} vectors;

static fg_status vectors_create(vectors *out, fg_context *context, const level *l)
{
  const size_t count = 3 * (size_t)l->dimension;
  out->memory = fg__allocate(count * l->cells, sizeof(double));
  if (!out->memory)
    return fg__fail_memory(context, "a reader", count * l->cells * sizeof(double));
  for (int k = 0; k < l->dimension; ++k) {
    out->residual[k] = out->memory + (size_t)(3 * k) * l->cells;
    out->search[k] = out->residual[k] + l->cells;
    out->product[k] = out->search[k] + l->cells;
  }
  return FG_STATUS_OK;
}

/* The cells from the first that may be unknown to the last. */
static void set_span(const level *l, size_t *begin, size_t *end)
{
  *begin = place_of(l, 0, 0, 0);
  *end = place_of(l, l->size[0] - 1, l->size[1] - 1, l->size[2] - 1) + 1;
}

/* out = sum over neighbours of (x - theirs), of unknown cells. */
static void apply(const level *l, double *restrict out, const double *restrict x)
{
  const ptrdiff_t row = l->step[1], layer = l->step[2];
  const double *restrict degree = l->degree;
  size_t begin, end;
  set_span(l, &begin, &end);
  if (l->dimension == 2)
    for (size_t n = begin; n < end; ++n) {
      const double *at = x + n;
      const double product = degree[n] * at[0] - (at[-1] + at[1] + at[-row] + at[row]);
      out[n] = degree[n] > 0.0 ? product : 0.0;
    }
  else
    for (size_t n = begin; n < end; ++n) {
      const double *at = x + n;
      const double product = degree[n] * at[0] - (at[-1] + at[1] + at[-row] + at[row] +
                                                  at[-layer] + at[layer]);
      out[n] = degree[n] > 0.0 ? product : 0.0;
    }
}

/* Always added up in the same order. */
static double inner(const level *l, const double *restrict a, const double *restrict b)
{
  enum { LANES = 8 };
  double sum[LANES] = {0.0};
  size_t n, end;
  set_span(l, &n, &end);
  for (; n + LANES <= end; n += LANES)
    for (int k = 0; k < LANES; ++k)
      sum[k] += a[n + (size_t)k] * b[n + (size_t)k];
  for (; n < end; ++n)
    sum[0] += a[n] * b[n];
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) +
         ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static double inner_all(const level *l, double *const a[3], double *const b[3])
{
  double sum = 0.0;
  for (int k = 0; k < l->dimension; ++k)
    sum += inner(l, a[k], b[k]);
  return sum;
}

/* a += factor b, or a = factor a + b. */
static void add(const level *l, double *restrict a, double factor,
                const double *restrict b)
{
  size_t n, end;
  set_span(l, &n, &end);
  for (; n < end; ++n)
    a[n] += factor * b[n];
}

static void scale_and_add(const level *l, double *restrict a, double factor,
                          const double *restrict b)
{
  size_t n, end;
  set_span(l, &n, &end);
  for (; n < end; ++n)
    a[n] = factor * a[n] + b[n];
}

/* The squared residual of values that are 0 where they are not fixed: what the residual
 * is measured by. */
static double squared_start(const level *l)
{
  double sum = 0.0;
  for (size_t n = 0; n < l->cells; ++n) {
    if (l->kind[n] != UNKNOWN)
      continue;
    for (int k = 0; k < l->dimension; ++k) {
      double fixed = 0.0;
      for (int axis = 0; axis < l->dimension; ++axis)
        for (int side = -1; side <= 1; side += 2) {
          const size_t next = (size_t)((ptrdiff_t)n + side * l->step[axis]);
          fixed += l->kind[next] == FIXED ? l->value[k][next] : 0.0;
        }
      sum += fixed * fixed;
    }
  }
  return sum;
}

static void begin_iteration(const level *l, vectors *v)
{
  for (int k = 0; k < l->dimension; ++k) {
    apply(l, v->residual[k], l->value[k]);
    for (size_t n = 0; n < l->cells; ++n)
      v->residual[k][n] = 0.0 - v->residual[k][n];
    memcpy(v->search[k], v->residual[k], l->cells * sizeof(double));
  }
}

static fg_status iterate(level *l, fg_context *context, vectors *v, double tolerance)
{
  /* what is fixed may cancel, and all be 0 but for rounding */
  const double enough = tolerance * tolerance * fmax(squared_start(l), 1e-12);
  begin_iteration(l, v);
  double square = inner_all(l, v->residual, v->residual);
  for (int iteration = 0; square > enough; ++iteration) {
    if (iteration == MOST_ITERATIONS)
      return fg__fail(context, FG_STATUS_NO_CONVERGENCE,
                      "score: the reader by diffusion is %g of where it began after %d "
                      "iterations",
                      sqrt(square / enough) * tolerance, iteration);
    for (int k = 0; k < l->dimension; ++k)
      apply(l, v->product[k], v->search[k]);
    const double length = square / inner_all(l, v->search, v->product);
    for (int k = 0; k < l->dimension; ++k) {
      add(l, l->value[k], length, v->search[k]);
      add(l, v->residual[k], -length, v->product[k]);
    }
    const double before = square;
    square = inner_all(l, v->residual, v->residual);
    for (int k = 0; k < l->dimension; ++k)
      scale_and_add(l, v->search[k], square / before, v->residual[k]);
    if (iteration % 64 == 63 && fg__check_stop(context) != FG_STATUS_OK)
      return FG_STATUS_STOPPED;
  }
  return FG_STATUS_OK;
}

static fg_status solve(level *l, fg_context *context, double tolerance)
{
  vectors v = {0};
  count_neighbours(l);
  fg_status status = vectors_create(&v, context, l);
  if (status == FG_STATUS_OK)
    status = iterate(l, context, &v, tolerance);
  free(v.memory);
  return status;
}

static fg_status solve_all(level *levels, int *count, fg_context *context,
                           double tolerance)
{
  fg_status status = FG_STATUS_OK;
  while (*count < MOST_LEVELS && status == FG_STATUS_OK) {
    const level *fine = &levels[*count - 1];
    bool smallest = fine->size[0] <= SMALLEST_SIDE || fine->size[1] <= SMALLEST_SIDE;
    smallest = smallest || (fine->dimension == 3 && fine->size[2] <= SMALLEST_SIDE);
    if (smallest)
      break;
    status = coarsen(&levels[(*count)++], context, fine);
  }
  for (int n = *count - 1; n >= 0 && status == FG_STATUS_OK; --n) {
    if (n + 1 < *count)
      interpolate(&levels[n], &levels[n + 1]);
    status = solve(&levels[n], context, tolerance);
  }
  return status;
}

static fg_status copy_out(fg__harmonic *out, fg_context *context, const level *l)
{
  const size_t columns = (size_t)l->size[0];
  const size_t cells = columns * (size_t)l->size[1] * (size_t)l->size[2];
  out->known = fg__allocate(cells, 1);
  bool all = out->known;
  for (int k = 0; k < l->dimension; ++k) {
    out->value[k] = fg__allocate(cells, sizeof(double));
    all = all && out->value[k];
  }
  if (!all)
    return fg__fail_memory(context, "a reader", cells * (size_t)l->dimension * 8);
  size_t to = 0;
  for (int k = 0; k < l->size[2]; ++k)
    for (int j = 0; j < l->size[1]; ++j) {
      const size_t from = place_of(l, 0, j, k);
      for (size_t i = 0; i < columns; ++i)
        out->known[to + i] = l->kind[from + i] != OUTSIDE;
      for (int c = 0; c < l->dimension; ++c)
        memcpy(out->value[c] + to, l->value[c] + from, columns * sizeof(double));
      to += columns;
    }
  return FG_STATUS_OK;
}

fg_status fg__harmonic_create(fg__harmonic *out, fg_context *context,
                              const fg__score_raster *raster, const fg__samples *samples,
                              double tolerance)
{
  level levels[MOST_LEVELS] = {0};
  int count = 1;
  *out = (fg__harmonic){0};
  fg_status status = level_create(&levels[0], context, raster->dimension, raster->size);
  if (status == FG_STATUS_OK)
    status = fill_finest(&levels[0], context, raster, samples);
  if (status == FG_STATUS_OK)
    status =
        solve_all(levels, &count, context, tolerance > 0.0 ? tolerance : USUAL_TOLERANCE);
  if (status == FG_STATUS_OK)
    status = copy_out(out, context, &levels[0]);
  for (int n = 0; n < count; ++n)
    level_clear(&levels[n]);
  return status;
}

void fg__harmonic_clear(fg__harmonic *diffusion)
{
  for (int k = 0; k < 3; ++k)
    free(diffusion->value[k]);
  free(diffusion->known);
  *diffusion = (fg__harmonic){0};
}

void fg__harmonic_angles(float *angle, const fg__score_raster *raster,
                         const fg__harmonic *diffusion)
{
  for (size_t n = 0; n < raster->cells; ++n) {
    double field[3] = {0.0}, read[3] = {0.0};
    if (!raster->counts[n])
      continue;
    for (int k = 0; k < raster->dimension; ++k) {
      field[k] = (double)raster->direction[k][n];
      read[k] = diffusion->value[k][n];
    }
    angle[n] = (float)fg__angle(read, field);
  }
}
