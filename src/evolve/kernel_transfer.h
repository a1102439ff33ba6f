/* Between levels: restriction and prolongation, fused with sweeps. Part of kernel_body.h.
 */
#ifndef FG__KERNEL_TRANSFER_H
#define FG__KERNEL_TRANSFER_H

#include <string.h>

#include "evolve/kernel_space.h"

/* What is restricted, each a line in the level's own layout, or a slice of lines gathered
 * to coarse columns (and in 3D to coarse rows). */
typedef struct lines {
  float *value[FG__RESTRICTED];
} lines;

/* The interface shape of the finest u, slice by slice: the three round the last one asked
 * for. */
typedef struct shapes {
  const fg__level *level;
  float *slot[3]; /* that of slice s is s + 1 modulo 3 */
  int held[3];    /* which slice each has, -2: none */
} shapes;

/* Floats of a slice with its ghosts. */
INLINE ptrdiff_t slice_floats(const fg__level *level)
{
  return FG__DIMENSION == 3 ? level->layout.plane : level->layout.stride;
}

/* Of row 0 in a slice. */
INLINE ptrdiff_t row_in_slice(const fg__level *level)
{
  return FG__DIMENSION == 3 ? level->layout.stride : 0;
}

static shapes shapes_of(const fg__level *level, const fg__share *share)
{
  shapes x = {.level = level, .held = {-2, -2, -2}};
  float *space = level->shapes + (size_t)share->member * 3 * (size_t)slice_floats(level);
  for (int n = 0; n < 3; ++n)
    x.slot[n] = space + n * slice_floats(level);
  return x;
}

ROW_LOOP void shape_floats(const float *u, float *shape, ptrdiff_t count)
{
  INDEPENDENT
  for (ptrdiff_t n = 0; n < count; ++n)
    shape[n] = interface_shape(u[n]);
}

/* Sees to slices s - 1, s and s + 1; out: where their rows 0 begin. */
static void shapes_round(shapes *x, int s, const float *out[3])
{
  const fg__level *level = x->level;
  for (int n = 0; n < 3; ++n) {
    int slice = s - 1 + n, slot = (slice + 1) % 3;
    if (x->held[slot] != slice) {
      ptrdiff_t row = fg__row_at(&level->layout, row_index(slice, 0), plane_index(slice));
      shape_floats(level->u + row - row_in_slice(level), x->slot[slot],
                   slice_floats(level));
      x->held[slot] = slice;
    }
    out[n] = x->slot[slot] + row_in_slice(level);
  }
}

/* What a restriction needs: the fine slices, one after the other, gathered. */
typedef struct restriction {
  const fg__level *fine, *coarse;
  const float *const *given; /* arrays with ghosts that hold all; NULL: to be found */
  laplacian l;
  shapes shapes;          /* of a nonlinear level */
  const float *around[3]; /* the shapes round the slice at work */
  ptrdiff_t line;         /* floats of a gathered line */
  lines fine_line;
  lines row[3];   /* 3D: gathered rows 2 J - 1, 2 J, 2 J + 1 */
  lines slice[3]; /* gathered slices 2 S - 1, 2 S, 2 S + 1 */
} restriction;

/* The coarse columns' values, 1/4, 1/2, 1/4 of fine lines, in natural order, which is
 * the order of the fine lines' even columns. */
ROW_LOOP void gather_columns(const fg__level *fine, const lines *from, const lines *to)
{
  const lines in = *from, out = *to;
  ptrdiff_t odd = fine->layout.odd_offset;
  INDEPENDENT
  for (int k = 0; k < fine->even_count; ++k) {
    UNROLLED
    for (int n = 0; n < FG__RESTRICTED; ++n)
      out.value[n][k] = 0.5F * in.value[n][k] +
                        0.25F * (in.value[n][odd + k - 1] + in.value[n][odd + k]);
  }
}

/* The same across lines, from `begin` on. */
ROW_LOOP void combine_lines(const lines three[3], ptrdiff_t begin, int count,
                            const lines *to)
{
  const lines low = three[0], middle = three[1], high = three[2], out = *to;
  INDEPENDENT
  for (ptrdiff_t k = 0; k < count; ++k) {
    UNROLLED
    for (int n = 0; n < FG__RESTRICTED; ++n)
      out.value[n][k] = 0.5F * middle.value[n][begin + k] +
                        0.25F * (low.value[n][begin + k] + high.value[n][begin + k]);
  }
}

ROW_LOOP void multiply(const float *by, float *values, ptrdiff_t count)
{
  INDEPENDENT
  for (ptrdiff_t k = 0; k < count; ++k)
    values[k] *= by[k];
}

INLINE void residual_nodes(const fg__level *fine, ptrdiff_t at, int colour,
                           const laplacian *constants, const float *const shape_round[3],
                           ptrdiff_t row, const lines *out, bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  row_view r = row_of(fine, at, colour, false, masked);
  around x = around_slices(fine, shape_round, row, colour);
  ptrdiff_t own = begin_of(fine, colour);
  float *first = out->value[0] + own, *second = out->value[1] + own;
  float *shape = out->value[2] + own, *curvature = out->value[3] + own;
  INDEPENDENT
  for (int k = 0; k < r.count; ++k) {
    residuals f = residuals_at(&r, l, k, false, masked);
    first[k] = f.first;
    float d = bulk + x.center[k], energy = apply(&r.energy, &x, k);
    if (masked)
      energy *= r.mass_inverse[k];
    second[k] = f.second * d;
    shape[k] = d;
    curvature[k] = d * (f.curvature * d + energy);
  }
}

INLINE void residual_linear_nodes(const fg__level *fine, ptrdiff_t at, int colour,
                                  const laplacian *constants, const lines *out,
                                  bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  row_view r = row_of(fine, at, colour, true, masked);
  ptrdiff_t own = begin_of(fine, colour);
  float *first = out->value[0] + own, *second = out->value[1] + own;
  float *shape = out->value[2] + own, *curvature = out->value[3] + own;
  const float *scale = fine->scale + at + own;
  const float *shape_curvature = fine->shape_curvature + at + own;
  INDEPENDENT
  for (int k = 0; k < r.count; ++k) {
    residuals f = residuals_at(&r, l, k, true, masked);
    first[k] = f.first;
    second[k] = f.second * scale[k];
    shape[k] = r.coupling[k] * scale[k];
    curvature[k] = shape_curvature[k];
  }
}

ROW_LOOP void residual_plain(const fg__level *fine, ptrdiff_t at, int colour,
                             const laplacian *l, const float *const shape_round[3],
                             ptrdiff_t row, const lines *out)
{
  residual_nodes(fine, at, colour, l, shape_round, row, out, false);
}

ROW_LOOP void residual_masked(const fg__level *fine, ptrdiff_t at, int colour,
                              const laplacian *l, const float *const shape_round[3],
                              ptrdiff_t row, const lines *out)
{
  residual_nodes(fine, at, colour, l, shape_round, row, out, true);
}

ROW_LOOP void residual_linear_plain(const fg__level *fine, ptrdiff_t at, int colour,
                                    const laplacian *l, const lines *out)
{
  residual_linear_nodes(fine, at, colour, l, out, false);
}

ROW_LOOP void residual_linear_masked(const fg__level *fine, ptrdiff_t at, int colour,
                                     const laplacian *l, const lines *out)
{
  residual_linear_nodes(fine, at, colour, l, out, true);
}

/* Of row j of plane k. The shapes round its slice: NULL for a linear level. */
static void residual_line(const fg__level *fine, int j, int k, const laplacian *l,
                          const float *const shape_round[3], const lines *out)
{
  ptrdiff_t at = fg__row_at(&fine->layout, j, k);
  ptrdiff_t row = FG__DIMENSION == 3 ? j * fine->layout.stride : 0;
  for (int colour = EVEN; colour <= ODD; ++colour)
    if (shape_round)
      (fine->mass ? residual_masked : residual_plain)(fine, at, colour, l, shape_round,
                                                      row, out);
    else
      (fine->mass ? residual_linear_masked : residual_linear_plain)(fine, at, colour, l,
                                                                    out);
}

static void gather_row(restriction *r, int j, int k, const lines *to, bool linear)
{
  const fg__level *fine = r->fine;
  ptrdiff_t at = fg__row_at(&fine->layout, j, k);
  if (r->given)
    for (int n = 0; n < FG__RESTRICTED; ++n)
      memcpy(r->fine_line.value[n], r->given[n] + at,
             (size_t)fine->layout.stride * sizeof(float));
  else
    residual_line(fine, j, k, &r->l, linear ? NULL : r->around, &r->fine_line);
  for (int n = 0; n < FG__RESTRICTED; ++n) {
    float *values = r->fine_line.value[n];
    fg__fill_ghost_columns(fine, values);
    if (fine->mass)
      multiply(fine->mass + at, values, fine->layout.stride);
  }
  gather_columns(fine, &r->fine_line, to);
}

static void swap_lines(lines *a, lines *b)
{
  lines kept = *a;
  *a = *b;
  *b = kept;
}

#if FG__DIMENSION == 3
static void gather_slice(restriction *r, int k, const lines *to, bool linear)
{
  const fg__level *fine = r->fine;
  if (!linear)
    shapes_round(&r->shapes, k, r->around);
  gather_row(r, fine->ghost_row_source[0], k, &r->row[0], linear);
  for (int J = 0; J < r->coarse->layout.nodes[1]; ++J) {
    int above = 2 * J + 1;
    if (above >= fine->layout.nodes[1])
      above = fine->ghost_row_source[1];
    gather_row(r, 2 * J, k, &r->row[1], linear);
    gather_row(r, above, k, &r->row[2], linear);
    lines out = *to;
    for (int n = 0; n < FG__RESTRICTED; ++n)
      out.value[n] += J * r->line;
    combine_lines(r->row, 0, fine->even_count, &out);
    swap_lines(&r->row[0], &r->row[2]);
  }
}
#else
static void gather_slice(restriction *r, int j, const lines *to, bool linear)
{
  if (!linear)
    shapes_round(&r->shapes, j, r->around);
  gather_row(r, j, 0, to, linear);
}
#endif

/* The slice whose values stand for slice s, which may lie one beyond the level. */
static int slice_source(const fg__level *level, int s)
{
  const int *source =
      FG__DIMENSION == 3 ? level->ghost_plane_source : level->ghost_row_source;
  if (s < 0)
    return source[0];
  return s < fg__slices(level) ? s : source[1];
}

/* Writes a coarse row given in natural order into the split layout. */
ROW_LOOP void split(const fg__level *coarse, const float *natural, float *to)
{
  float *even = to, *odd = to + coarse->layout.odd_offset;
  /* both in one loop, which becomes loads and shuffles of whole vectors; what lies beyond
   * the last column, ghosts are filled after */
  INDEPENDENT
  for (int k = 0; k < coarse->even_count; ++k) {
    even[k] = natural[2 * k];
    odd[k] = natural[2 * k + 1];
  }
  fg__fill_ghost_columns(coarse, to);
}

static void combine_slices(restriction *r, int S, float *const out[])
{
  const fg__level *coarse = r->coarse;
  int rows = FG__DIMENSION == 3 ? coarse->layout.nodes[1] : 1;
  for (int J = 0; J < rows; ++J) {
    ptrdiff_t at = FG__DIMENSION == 3 ? fg__row_at(&coarse->layout, J, S)
                                      : fg__row_at(&coarse->layout, S, 0);
    combine_lines(r->slice, J * r->line, r->fine->even_count, &r->fine_line);
    for (int n = 0; n < FG__RESTRICTED; ++n) {
      split(coarse, r->fine_line.value[n], out[n] + at);
      if (coarse->mass)
        multiply(coarse->mass_inverse + at, out[n] + at, coarse->layout.stride);
    }
  }
}

/* Coarse slice S from fine slices 2 S - 1 (kept from the slice before, unless it is the
 * first of a part), 2 S and 2 S + 1. */
static void restrict_slice(restriction *r, int S, bool first, float *const out[],
                           bool linear)
{
  if (first)
    gather_slice(r, slice_source(r->fine, 2 * S - 1), &r->slice[0], linear);
  gather_slice(r, 2 * S, &r->slice[1], linear);
  gather_slice(r, slice_source(r->fine, 2 * S + 1), &r->slice[2], linear);
  combine_slices(r, S, out);
  swap_lines(&r->slice[0], &r->slice[2]);
}

/* Cuts all lines from the member's piece of the fine level's scratch space. */
static restriction restriction_of(const fg__level *fine, const fg__level *coarse,
                                  float tau, const fg__share *share)
{
  restriction r = {.fine = fine,
                   .coarse = coarse,
                   .l = laplacian_times(fine, tau),
                   .line = fine->layout.odd_offset};
  if (fine->shapes)
    r.shapes = shapes_of(fine, share);
  ptrdiff_t stride = fine->layout.stride;
  ptrdiff_t slice = FG__DIMENSION == 3 ? r.line * coarse->layout.nodes[1] : stride;
  float *space = fine->scratch + (size_t)share->member * fine->scratch_size;
  for (int n = 0; n < FG__RESTRICTED; ++n) {
    r.fine_line.value[n] = space;
    space += stride;
    for (int m = 0; m < 3; ++m) {
      r.row[m].value[n] = space;
      space += stride;
    }
    for (int m = 0; m < 3; ++m) {
      r.slice[m].value[n] = space;
      space += slice;
    }
  }
  return r;
}

/* The mean of coarse rows in natural order, with one ghost at its end: of the two (in 3D
 * four) rows round a fine row, which are the same where it lies on one. */
INLINE void merge(const fg__level *coarse, const float *const from[4], float *natural)
{
  int columns = coarse->layout.nodes[0];
  ptrdiff_t odd = coarse->layout.odd_offset, ghost = coarse->ghost_column[1];
  const float *a = from[0], *b = from[1];
#if FG__DIMENSION == 3
  const float *c = from[2], *d = from[3];
#define MEAN(n) (0.25F * ((a[n] + b[n]) + (c[n] + d[n])))
#else
#define MEAN(n) (0.5F * (a[n] + b[n]))
#endif
  INDEPENDENT
  for (int k = 0; k < coarse->even_count; ++k) {
    natural[2 * k] = MEAN(k);
    natural[2 * k + 1] = MEAN(odd + k);
  }
  natural[columns] = MEAN(ghost);
#undef MEAN
}

/* What a correction is multiplied by: d of the density that it changes, the scale of a
 * linear level, or nothing. */
typedef enum factor { ONE, SHAPE, SCALE } factor;

INLINE void correct_nodes(const fg__level *fine, const float *natural, ptrdiff_t at,
                          float *array, factor by)
{
  ptrdiff_t odd_offset = fine->layout.odd_offset;
  float *even = array + at, *odd = even + odd_offset;
  const float *scale = by == SCALE ? fine->scale + at : NULL;
  INDEPENDENT
  for (int n = 0; n < fine->even_count; ++n) {
    float change = natural[n];
    if (by == SHAPE)
      change *= bulk + interface_shape(even[n]);
    else if (by == SCALE)
      change *= scale[n];
    even[n] += change;
  }
  INDEPENDENT
  for (int n = 0; n < fine->odd_count; ++n) {
    float change = 0.5F * (natural[n] + natural[n + 1]);
    if (by == SHAPE)
      change *= bulk + interface_shape(odd[n]);
    else if (by == SCALE)
      change *= scale[odd_offset + n];
    odd[n] += change;
  }
}

/* u and w of a row from the coarse rows round it, which begin `at` in u and w. */
INLINE void correct_both(const fg__level *coarse, const ptrdiff_t at[4],
                         const fg__level *fine, ptrdiff_t row, float *natural, factor by)
{
  const float *rows[4];
  for (int n = 0; n < 4; ++n)
    rows[n] = coarse->u + at[n];
  merge(coarse, rows, natural);
  correct_nodes(fine, natural, row, fine->u, by);
  for (int n = 0; n < 4; ++n)
    rows[n] = coarse->w + at[n];
  merge(coarse, rows, natural);
  correct_nodes(fine, natural, row, fine->w, ONE);
  fg__fill_ghost_columns(fine, fine->u + row);
  fg__fill_ghost_columns(fine, fine->w + row);
}

ROW_LOOP void correct_by_shape(const fg__level *coarse, const ptrdiff_t at[4],
                               const fg__level *fine, ptrdiff_t row, float *natural)
{
  correct_both(coarse, at, fine, row, natural, SHAPE);
}

ROW_LOOP void correct_by_scale(const fg__level *coarse, const ptrdiff_t at[4],
                               const fg__level *fine, ptrdiff_t row, float *natural)
{
  correct_both(coarse, at, fine, row, natural, SCALE);
}

/* Row j of plane k. */
static void correct_row(const fg__level *coarse, const fg__level *fine, int j, int k,
                        bool linear, float *natural)
{
  ptrdiff_t at[4], row = fg__row_at(&fine->layout, j, k);
  at[0] = fg__row_at(&coarse->layout, j / 2, k / 2);
  at[1] = at[0] + j % 2 * coarse->layout.stride;
  at[2] = at[0] + k % 2 * coarse->layout.plane;
  at[3] = at[1] + k % 2 * coarse->layout.plane;
  (linear ? correct_by_scale : correct_by_shape)(coarse, at, fine, row, natural);
  for (int side = 0; side < 2; ++side)
    if (fine->ghost_row_source[side] == j) {
      fg__fill_ghost_row(fine, fine->u, k, side);
      fg__fill_ghost_row(fine, fine->w, k, side);
    }
}

static void correct_slice(const fg__level *coarse, const fg__level *fine, int s,
                          bool linear, const fg__share *share)
{
  float *natural = fine->scratch + (size_t)(share->member + 1) * fine->scratch_size -
                   fine->layout.stride;
#if FG__DIMENSION == 3
  for (int j = 0; j < fine->layout.nodes[1]; ++j)
    correct_row(coarse, fine, j, s, linear, natural);
  for (int side = 0; side < 2; ++side)
    if (fine->ghost_plane_source[side] == s) {
      fg__fill_ghost_plane(fine, fine->u, side);
      fg__fill_ghost_plane(fine, fine->w, side);
    }
#else
  correct_row(coarse, fine, s, 0, linear, natural);
#endif
}

/* The slices at either end of a part are corrected before all others, because the
 * neighbours' sweeps need them. */
static void correct_ends(const fg__level *coarse, const fg__level *fine, part mine,
                         bool linear, const fg__share *share)
{
  int last = mine.end - 1;
  for (int s = mine.begin; s < mine.end && s < mine.begin + 2; ++s)
    correct_slice(coarse, fine, s, linear, share);
  if (last >= mine.begin + 2)
    correct_slice(coarse, fine, last, linear, share);
  fg__team_barrier(share);
}

static void clear(const fg__level *level, float *array)
{
  memset(array - level->layout.first, 0, level->layout.array_size * sizeof *array);
}

/* What is done to a fine level, in this order, in one pass over its memory. */
typedef struct work {
  bool correct, sweep, restriction;
} work;

/* Slice s is smoothed when those up to s + 1 are corrected. Once slices up to s = 2 S + 2
 * are smoothed, those up to 2 S + 1 have their final residuals, while they are still
 * near. Not so at the start of a part, whose neighbour may be at work still, nor across a
 * periodic border, where slice 0 needs the last. */
static void pass(const fg__level *fine, const fg__level *coarse, float tau, bool linear,
                 work todo, const fg__share *share)
{
  laplacian l = laplacian_times(fine, tau);
  restriction r = restriction_of(fine, coarse, tau, share);
  float *const out[] = {coarse->p, coarse->q, coarse->coupling, coarse->shape_curvature};
  part mine = part_of(fine, share);
  int first = mine.begin / 2, last = (mine.end + 1) / 2; /* coarse slices */
  bool together = todo.sweep && todo.restriction && !fine->periodic[FG__DIMENSION - 1];
  int started = together && mine.begin == 0 ? first : first + 1;
  if (todo.correct)
    correct_ends(coarse, fine, mine, linear, share);
  if (todo.sweep)
    begin_sweep(fine, mine, &l, linear, share);
  for (int s = mine.begin + 2; todo.sweep && s <= mine.end + 1; s += 2) {
    int S = s / 2 - 1;
    for (int next = s; todo.correct && next <= s + 1 && next < mine.end - 1; ++next)
      correct_slice(coarse, fine, next, linear, share);
    continue_sweep(fine, s, mine, &l, linear);
    if (together && S >= started)
      restrict_slice(&r, S, S == started, out, linear);
  }
  fg__team_barrier(share);
  if (!todo.restriction)
    return;
  int end = together ? started : last;
  for (int S = first; S < end && S < last; ++S)
    restrict_slice(&r, S, S == first, out, linear);
  if (share->member == 0)
    clear(coarse, coarse->u);
  if (share->member == share->members - 1)
    clear(coarse, coarse->w);
  fg__team_barrier(share);
}

static void restrict_residuals(const fg__level *fine, const fg__level *coarse, float tau,
                               const fg__share *share)
{
  pass(fine, coarse, tau, false, (work){.restriction = true}, share);
}

static void smooth_restrict_linear(const fg__level *fine, const fg__level *coarse,
                                   float tau, const fg__share *share)
{
  pass(fine, coarse, tau, true, (work){.sweep = true, .restriction = true}, share);
}

static void correct_smooth(const fg__level *coarse, const fg__level *fine, float tau,
                           const fg__share *share)
{
  pass(fine, coarse, tau, false, (work){.correct = true, .sweep = true}, share);
}

static void correct_smooth_linear(const fg__level *coarse, const fg__level *fine,
                                  float tau, const fg__share *share)
{
  pass(fine, coarse, tau, true, (work){.correct = true, .sweep = true}, share);
}

static void correct_smooth_restrict(const fg__level *coarse, const fg__level *fine,
                                    float tau, const fg__share *share)
{
  pass(fine, coarse, tau, false, (work){true, true, true}, share);
}

#endif
