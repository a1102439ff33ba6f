/* The reader that continues the tangents harmonically: conjugate gradients,
 * preconditioned by a V-cycle of multigrid and begun from the solution on a raster of
 * half as many cells a side, and so on (Trottenberg, Oosterlee and Schueller, Multigrid,
 * 2001). */
#include "base/memory.h"
#include "score/level.h"
#include "score/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the preconditioned residual, which is about the error of unit vectors, root mean
 * square; the mean angle is then off by less than 0.01 degrees (the tests). */
static const double USUAL_TOLERANCE = 3e-5;

enum {
  MOST_LEVELS = 26,
  SMALLEST_SIDE = 4,
  COARSEST_SWEEPS = 16,
  MOST_ITERATIONS = 10000
};

/* The rasters, finest first. */
typedef struct levels {
  fg__score_level level[MOST_LEVELS];
  int count;
} levels;

static void add_tangents(fg__score_level *level, const fg__domain_raster *raster,
                         const fg__samples *samples)
{
  for (size_t n = 0; n < samples->count; ++n) {
    size_t found;
    if (!fg__domain_raster_find(raster, samples->position[n], &found) ||
        !raster->inside[found])
      continue;
    const size_t columns = (size_t)level->size[0], rows = (size_t)level->size[1];
    const size_t place = fg__score_level_place(level, (int)(found % columns),
                                               (int)(found / columns % rows),
                                               (int)(found / columns / rows));
    for (int k = 0; k < level->dimension; ++k)
      level->value[k][place] += samples->tangent[n][k];
  }
  for (size_t n = 0; n < level->cells; ++n)
    if (level->kind[n] != FG__OUTSIDE)
      fg__score_level_fix(level, n);
}

/* Every fixed cell leads to its neighbours, and they to theirs; parts of the domain that
 * are not reached become outside. `queue` has room for all cells. */
static void leave_out_unreached(fg__score_level *level, size_t *queue,
                                unsigned char *reached)
{
  size_t begin = 0, end = 0;
  for (size_t n = 0; n < level->cells; ++n)
    if (level->kind[n] == FG__FIXED) {
      reached[n] = 1;
      queue[end++] = n;
    }
  while (begin < end) {
    const size_t at = queue[begin++];
    for (int side = 0; side < 2 * level->dimension; ++side) {
      const ptrdiff_t step = side % 2 ? level->step[side / 2] : -level->step[side / 2];
      const size_t next = (size_t)((ptrdiff_t)at + step);
      if (level->kind[next] != FG__OUTSIDE && !reached[next]) {
        reached[next] = 1;
        queue[end++] = next;
      }
    }
  }
  for (size_t n = 0; n < level->cells; ++n)
    if (!reached[n])
      level->kind[n] = FG__OUTSIDE;
}

static fg_status fill_finest(fg__score_level *level, fg_context *context,
                             const fg__domain_raster *raster, const fg__samples *samples)
{
  const unsigned char *inside = raster->inside;
  size_t *queue = fg__allocate(level->cells, sizeof *queue);
  unsigned char *reached = fg__allocate(level->cells, 1);
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < level->size[2]; ++k)
    for (int j = 0; j < level->size[1]; ++j)
      for (int i = 0; i < level->size[0]; ++i)
        level->kind[fg__score_level_place(level, i, j, k)] =
            *inside++ ? FG__UNKNOWN : FG__OUTSIDE;
  add_tangents(level, raster, samples);
  if (queue && reached)
    leave_out_unreached(level, queue, reached);
  else
    status = fg__fail_memory(context, "a raster's parts", level->cells * sizeof *queue);
  fg__score_level_finish(level);
  free(queue);
  free(reached);
  return status;
}

static fg_status make_levels(levels *out, fg_context *context,
                             const fg__domain_raster *raster, const fg__samples *samples)
{
  out->count = 1;
  fg_status status =
      fg__score_level_create(&out->level[0], context, raster->dimension, raster->size);
  if (status == FG_STATUS_OK)
    status = fill_finest(&out->level[0], context, raster, samples);
  while (status == FG_STATUS_OK && out->count < MOST_LEVELS) {
    fg__score_level *last = &out->level[out->count - 1];
    const int *size = last->size;
    if (last->unknown == 0 || (size[0] <= SMALLEST_SIDE && size[1] <= SMALLEST_SIDE &&
                               size[2] <= SMALLEST_SIDE))
      break;
    status = fg__score_level_coarsen(&out->level[out->count++], context, last);
  }
  return status;
}

/* What is taken of the residual in a damped Jacobi step, by a cell's degree: damps what
 * coarser rasters do not see (Trottenberg, Oosterlee and Schueller 2001). */
static const double RELAX[] = {0.0, 0.8, 0.8 / 2, 0.8 / 3, 0.8 / 4, 0.8 / 5, 0.8 / 6};

/* x += relax (right - A x). */
static void smooth(const fg__score_level *level, double *restrict x,
                   const double *restrict right)
{
  double *restrict work = level->work;
  const unsigned char *restrict degree = level->degree;
  fg__score_level_apply(level, work, x);
  for (size_t n = level->begin; n < level->end; ++n)
    x[n] += RELAX[degree[n]] * (right[n] - work[n]);
}

/* The coarse equation's right side is the sum over as many cells as a coarse one has, and
 * its differences span two of them. */
static double scale_of(const fg__score_level *fine)
{
  double cells = 1.0;
  for (int k = 0; k < fine->dimension; ++k)
    cells *= fine->size[k] > 1 ? 2.0 : 1.0;
  return 4.0 / cells;
}

/* x = about the solution of A x = right: one V-cycle with a damped Jacobi step before and
 * after, symmetric. */
static void cycle(const levels *all, int number, double *restrict x,
                  const double *restrict right)
{
  const fg__score_level *level = &all->level[number];
  const unsigned char *restrict degree = level->degree;
  double *restrict work = level->work;
  for (size_t n = level->begin; n < level->end; ++n)
    x[n] = RELAX[degree[n]] * right[n];
  if (number + 1 == all->count) {
    for (int sweep = 1; sweep < COARSEST_SWEEPS; ++sweep)
      smooth(level, x, right);
    return;
  }
  const fg__score_level *coarse = level + 1;
  const double scale = scale_of(level);
  fg__score_level_apply(level, work, x);
  for (size_t n = level->begin; n < level->end; ++n)
    work[n] = scale * (right[n] - work[n]);
  fg__score_level_restrict(coarse, coarse->right, level, work);
  cycle(all, number + 1, coarse->correction, coarse->right);
  fg__score_level_interpolate(level, x, coarse, coarse->correction);
  smooth(level, x, right);
}

/* The vectors of the iteration; all are 0 where no cell is unknown. */
typedef struct vectors {
  double *residual[3], *search[3], *product[3];
} vectors;

/* Ends with vectors_clear, also after a failure. */
static fg_status vectors_create(vectors *out, fg_context *context,
                                const fg__score_level *level)
{
  *out = (vectors){0};
  for (int k = 0; k < level->dimension; ++k) {
    out->residual[k] = fg__allocate(level->cells, sizeof(double));
    out->search[k] = fg__allocate(level->cells, sizeof(double));
    out->product[k] = fg__allocate(level->cells, sizeof(double));
    if (!out->residual[k] || !out->search[k] || !out->product[k])
      return fg__fail_memory(context, "a reader", 3 * level->cells * sizeof(double));
  }
  return FG_STATUS_OK;
}

static void vectors_clear(vectors *v)
{
  for (int k = 0; k < 3; ++k) {
    free(v->residual[k]);
    free(v->search[k]);
    free(v->product[k]);
  }
}

/* Always added up in the same order. */
static double inner(const fg__score_level *level, const double *a, const double *b)
{
  enum { LANES = 8 };
  double sum[LANES] = {0.0};
  size_t n = level->begin;
  for (; n + LANES <= level->end; n += LANES)
    for (size_t k = 0; k < LANES; ++k)
      sum[k] += a[n + k] * b[n + k];
  for (; n < level->end; ++n)
    sum[0] += a[n] * b[n];
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) +
         ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static double inner_all(const fg__score_level *level, double *const a[3],
                        double *const b[3])
{
  double sum = 0.0;
  for (int k = 0; k < level->dimension; ++k)
    sum += inner(level, a[k], b[k]);
  return sum;
}

/* a += factor b. */
static void add(const fg__score_level *level, double *restrict a, double factor,
                const double *restrict b)
{
  for (size_t n = level->begin; n < level->end; ++n)
    a[n] += factor * b[n];
}

/* a = factor a + b. */
static void scale_and_add(const fg__score_level *level, double *restrict a, double factor,
                          const double *restrict b)
{
  for (size_t n = level->begin; n < level->end; ++n)
    a[n] = factor * a[n] + b[n];
}

/* The products' room first holds what the preconditioner makes of the residual. */
static fg_status iterate(const levels *all, int number, fg_context *context, vectors *v,
                         double tolerance)
{
  const fg__score_level *level = &all->level[number];
  const double enough = tolerance * tolerance * (double)level->unknown;
  double before = 0.0;
  for (int k = 0; k < level->dimension; ++k) {
    fg__score_level_apply(level, v->residual[k], level->value[k]);
    for (size_t n = level->begin; n < level->end; ++n)
      v->residual[k][n] = 0.0 - v->residual[k][n];
  }
  for (int iteration = 0; iteration < MOST_ITERATIONS; ++iteration) {
    for (int k = 0; k < level->dimension; ++k)
      cycle(all, number, v->product[k], v->residual[k]);
    const double error = inner_all(level, v->product, v->product);
    const double square = inner_all(level, v->residual, v->product);
    if (error <= enough || !(square > 0.0))
      return FG_STATUS_OK;
    for (int k = 0; k < level->dimension; ++k) {
      scale_and_add(level, v->search[k], before > 0.0 ? square / before : 0.0,
                    v->product[k]);
      fg__score_level_apply(level, v->product[k], v->search[k]);
    }
    before = square;
    const double length = square / inner_all(level, v->search, v->product);
    for (int k = 0; k < level->dimension; ++k) {
      add(level, level->value[k], length, v->search[k]);
      add(level, v->residual[k], -length, v->product[k]);
    }
    if (fg__check_stop(context) != FG_STATUS_OK)
      return FG_STATUS_STOPPED;
  }
  return fg__fail(context, FG_STATUS_NO_CONVERGENCE,
                  "score: the reader by diffusion does not converge in %d iterations",
                  MOST_ITERATIONS);
}

/* From the coarsest raster to the finest. */
static fg_status solve(levels *all, fg_context *context, double tolerance)
{
  fg_status status = FG_STATUS_OK;
  for (int n = all->count - 1; n >= 0 && status == FG_STATUS_OK; --n) {
    const fg__score_level *level = &all->level[n];
    vectors v;
    for (int k = 0; n + 1 < all->count && k < level->dimension; ++k)
      fg__score_level_interpolate(level, level->value[k], level + 1, level[1].value[k]);
    status = vectors_create(&v, context, level);
    if (status == FG_STATUS_OK)
      status = iterate(all, n, context, &v, n > 0 ? 10.0 * tolerance : tolerance);
    vectors_clear(&v);
  }
  return status;
}

static fg_status copy_out(fg__harmonic *out, fg_context *context,
                          const fg__score_level *level)
{
  const size_t columns = (size_t)level->size[0];
  const size_t cells = columns * (size_t)level->size[1] * (size_t)level->size[2];
  out->known = fg__allocate(cells, 1);
  bool all = out->known;
  for (int k = 0; k < level->dimension; ++k) {
    out->value[k] = fg__allocate(cells, sizeof(double));
    all = all && out->value[k];
  }
  if (!all)
    return fg__fail_memory(context, "a reader",
                           cells * (size_t)level->dimension * sizeof(double));
  size_t to = 0;
  for (int k = 0; k < level->size[2]; ++k)
    for (int j = 0; j < level->size[1]; ++j) {
      const size_t from = fg__score_level_place(level, 0, j, k);
      for (size_t i = 0; i < columns; ++i)
        out->known[to + i] = level->kind[from + i] != FG__OUTSIDE;
      for (int c = 0; c < level->dimension; ++c)
        memcpy(out->value[c] + to, level->value[c] + from, columns * sizeof(double));
      to += columns;
    }
  return FG_STATUS_OK;
}

fg_status fg__harmonic_create(fg__harmonic *out, fg_context *context,
                              const fg__domain_raster *raster, const fg__samples *samples,
                              double tolerance)
{
  *out = (fg__harmonic){0};
  levels *all = fg__allocate(1, sizeof *all);
  if (!all)
    return fg__fail_memory(context, "a reader", sizeof *all);
  fg_status status = make_levels(all, context, raster, samples);
  if (status == FG_STATUS_OK)
    status = solve(all, context, tolerance > 0.0 ? tolerance : USUAL_TOLERANCE);
  if (status == FG_STATUS_OK)
    status = copy_out(out, context, &all->level[0]);
  for (int n = 0; n < all->count; ++n)
    fg__score_level_clear(&all->level[n]);
  free(all);
  return status;
}

void fg__harmonic_clear(fg__harmonic *harmonic)
{
  for (int k = 0; k < 3; ++k)
    free(harmonic->value[k]);
  free(harmonic->known);
  *harmonic = (fg__harmonic){0};
}

void fg__harmonic_angles(float *angle, const fg__domain_raster *raster,
                         const fg__harmonic *harmonic)
{
  for (size_t n = 0; n < raster->cells; ++n) {
    double field[3] = {0.0}, read[3] = {0.0};
    if (!raster->counts[n])
      continue;
    for (int k = 0; k < raster->dimension; ++k) {
      field[k] = (double)raster->direction[k][n];
      read[k] = harmonic->value[k][n];
    }
    angle[n] = (float)fg__angle(read, field);
  }
}
