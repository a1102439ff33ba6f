/* Restriction: the residuals of a level, and what its next coarser space is made of,
 * gathered to coarse nodes. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_RESTRICT_H
#define FG__KERNEL_RESTRICT_H

#include <string.h>

#include "solver/kernel/coarse_space.h"

/* What is restricted, each a line in the level's own layout, or a slice of lines gathered
 * to coarse columns (and in 3D to coarse rows). */
typedef struct lines {
  float *value[FG__RESTRICTED];
} lines;

/* The interface shape of the finest u, slice by slice: the three round the last one
 * computed. */
typedef struct shapes {
  const fg__level *level;
  float *slot[3]; /* that of slice s is s + 1 modulo 3 */
  int held[3];    /* which slice each has, -2: none */
} shapes;

/* Of row 0 in a slice. */
INLINE ptrdiff_t row_in_slice(const fg__level *level)
{
  return FG__DIMENSION == 3 ? level->layout.stride : 0;
}

static shapes shapes_of(const fg__level *level, const fg__thread *thread)
{
  shapes x = {.level = level, .held = {-2, -2, -2}};
  float *space =
      level->shapes + (size_t)thread->index * 3 * (size_t)fg__slice_floats(level);
  for (int n = 0; n < 3; ++n)
    x.slot[n] = space + n * fg__slice_floats(level);
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
                   fg__slice_floats(level));
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

/* Both residuals at a block of columns, and in a linear level's terms the rest. */
INLINE void put_residuals(const fg__level *fine, ptrdiff_t at, ptrdiff_t column,
                          const laplacian *l, vector energy, vector flux,
                          const float *shape_of_row, const lines *out, bool linear,
                          bool masked)
{
  vector u = load(fine->u + at), w = load(fine->w + at), p = load(fine->p + at);
  if (masked) {
    vector inverse = load(fine->mass_inverse + at);
    energy *= inverse;
    flux *= l->tau * inverse;
  }
  vector first, second, d;
  if (linear) {
    vector m = load(fine->coupling + at), scale = load(fine->scale + at);
    first = (p - m * u) - flux;
    second =
        ((load(fine->q + at) + load(fine->curvature + at) * u + energy) - m * w) * scale;
    d = m * scale;
    store(out->value[3] + column, load(fine->shape_curvature + at));
  } else {
    d = bulk + load(shape_of_row + column);
    first = (p - u) - flux;
    second = ((2.0F * u * (u * u - 1.0F) + energy) - w) * d;
  }
  store(out->value[0] + column, first);
  store(out->value[1] + column, second);
  store(out->value[2] + column, d);
}

/* d J d, from K on the shape. */
INLINE void put_curvature(const fg__level *fine, ptrdiff_t at, ptrdiff_t column,
                          vector energy, const float *shape_of_row, const lines *out,
                          bool masked)
{
  vector u = load(fine->u + at), d = bulk + load(shape_of_row + column);
  if (masked)
    energy *= load(fine->mass_inverse + at);
  store(out->value[3] + column, d * ((6.0F * (u * u) - 2.0F) * d + energy));
}

INLINE void residual_nodes(const fg__level *fine, ptrdiff_t at,
                           const laplacian *constants, const float *shape_of_row,
                           const lines *out, bool linear, bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  block n = first_block(fine);
  strand energy =
      strand_of(fine, &fine->energy, l, neighbours_round(fine, fine->u, at), at);
  strand flux = strand_of(fine, masked ? &fine->laplacian : NULL, l,
                          neighbours_round(fine, fine->w, at), at);
  begin(&energy, &n);
  begin(&flux, &n);
  for (; n.even < n.evens; next_block(&n)) {
    advance(&energy, n.even, n.odd);
    advance(&flux, n.even, n.odd);
    put_residuals(fine, at + n.even, n.even, l, at_even_block(&energy, &n),
                  at_even_block(&flux, &n), shape_of_row, out, linear, masked);
    if (n.even > 0)
      put_residuals(fine, at + n.odd - WIDTH, n.odd - WIDTH, l,
                    at_odd_before(&energy, &n), at_odd_before(&flux, &n), shape_of_row,
                    out, linear, masked);
  }
  if (n.even - WIDTH < n.odds)
    put_residuals(fine, at + n.odd - WIDTH, n.odd - WIDTH, l, at_last_odd(&energy, &n),
                  at_last_odd(&flux, &n), shape_of_row, out, linear, masked);
}

INLINE void curvature_of_shape(const fg__level *fine, ptrdiff_t at,
                               const float *const shape_round[3], ptrdiff_t row,
                               const lines *out, bool masked)
{
  block n = first_block(fine);
  const float *shape_of_row = shape_round[1] + row;
  strand shape = strand_of(fine, &fine->energy, NULL,
                           neighbours_of_slices(fine, shape_round, row), at);
  begin(&shape, &n);
  for (; n.even < n.evens; next_block(&n)) {
    advance(&shape, n.even, n.odd);
    put_curvature(fine, at + n.even, n.even, at_even_block(&shape, &n), shape_of_row, out,
                  masked);
    if (n.even > 0)
      put_curvature(fine, at + n.odd - WIDTH, n.odd - WIDTH, at_odd_before(&shape, &n),
                    shape_of_row, out, masked);
  }
  if (n.even - WIDTH < n.odds)
    put_curvature(fine, at + n.odd - WIDTH, n.odd - WIDTH, at_last_odd(&shape, &n),
                  shape_of_row, out, masked);
}

ROW_LOOP void residual_plain(const fg__level *fine, ptrdiff_t at, const laplacian *l,
                             const float *const shape_round[3], ptrdiff_t row,
                             const lines *out)
{
  residual_nodes(fine, at, l, shape_round[1] + row, out, false, false);
  curvature_of_shape(fine, at, shape_round, row, out, false);
}

ROW_LOOP void residual_masked(const fg__level *fine, ptrdiff_t at, const laplacian *l,
                              const float *const shape_round[3], ptrdiff_t row,
                              const lines *out)
{
  residual_nodes(fine, at, l, shape_round[1] + row, out, false, true);
  curvature_of_shape(fine, at, shape_round, row, out, true);
}

ROW_LOOP void residual_linear_plain(const fg__level *fine, ptrdiff_t at,
                                    const laplacian *l, const lines *out)
{
  residual_nodes(fine, at, l, NULL, out, true, false);
}

ROW_LOOP void residual_linear_masked(const fg__level *fine, ptrdiff_t at,
                                     const laplacian *l, const lines *out)
{
  residual_nodes(fine, at, l, NULL, out, true, true);
}

/* Of row j of plane k. The shapes round its slice: NULL for a linear level. */
static void residual_line(const fg__level *fine, int j, int k, const laplacian *l,
                          const float *const shape_round[3], const lines *out)
{
  ptrdiff_t at = fg__row_at(&fine->layout, j, k);
  ptrdiff_t row = FG__DIMENSION == 3 ? j * fine->layout.stride : 0;
  if (shape_round)
    (fine->mass ? residual_masked : residual_plain)(fine, at, l, shape_round, row, out);
  else
    (fine->mass ? residual_linear_masked : residual_linear_plain)(fine, at, l, out);
}

static void find_row(restriction *r, int j, int k, const lines *out, bool linear)
{
  const fg__level *fine = r->fine;
  ptrdiff_t at = fg__row_at(&fine->layout, j, k);
  if (r->given)
    for (int n = 0; n < FG__RESTRICTED; ++n)
      memcpy(out->value[n], r->given[n] + at,
             (size_t)fine->layout.stride * sizeof(float));
  else
    residual_line(fine, j, k, &r->l, linear ? NULL : r->around, out);
  for (int n = 0; n < FG__RESTRICTED; ++n) {
    float *values = out->value[n];
    fg__fill_ghost_columns(fine, values);
    if (fine->mass)
      multiply(fine->mass + at, values, fine->layout.stride);
  }
}

static void gather_row(restriction *r, int j, int k, const lines *to, bool linear)
{
  find_row(r, j, k, &r->fine_line, linear);
  gather_columns(r->fine, &r->fine_line, to);
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

/* With a mask coarse nodes get back what follows them (level->interpolation): adds what
 * one fine row gives to the coarse row at its `side`. */
ROW_LOOP void return_row(const fg__level *fine, const lines *from, ptrdiff_t begin,
                         ptrdiff_t at, int side, const lines *to)
{
  const float weight = FG__DIMENSION == 3 ? 0.125F : 0.25F;
  const lines in = *from, out = *to;
  const float *low = fine->interpolation[side] + at;
  const float *high = fine->interpolation[side | 1] + at;
  ptrdiff_t odd = fine->layout.odd_offset;
  INDEPENDENT
  for (int k = 0; k < fine->even_count; ++k) {
    UNROLLED
    for (int n = 0; n < FG__RESTRICTED; ++n) {
      const float *value = in.value[n] + begin;
      out.value[n][k] +=
          weight * (low[k] * value[k] + (high[odd + k - 1] * value[odd + k - 1] +
                                         low[odd + k] * value[odd + k]));
    }
  }
}

/* A whole fine slice; in 3D with its ghost rows. */
static void keep_slice(restriction *r, int s, const lines *to, bool linear)
{
  const fg__level *fine = r->fine;
  if (!linear)
    shapes_round(&r->shapes, s, r->around);
  int beyond = FG__DIMENSION == 3;
  for (int n = -beyond; n < rows_of_slice(fine) + beyond; ++n) {
    lines row = *to;
    for (int m = 0; m < FG__RESTRICTED; ++m)
      row.value[m] += row_in_slice(fine) + n * fine->layout.stride;
    int source = n;
    if (n < 0 || n >= rows_of_slice(fine))
      source = fine->ghost_row_source[n >= 0];
    find_row(r, row_index(s, source), plane_index(s), &row, linear);
  }
}

static void return_slices(restriction *r, int S, float *const out[])
{
  const fg__level *fine = r->fine, *coarse = r->coarse;
  for (int J = 0; J < rows_of_slice(coarse); ++J) {
    ptrdiff_t to = fg__row_at(&coarse->layout, row_index(S, J), plane_index(S));
    for (int n = 0; n < FG__RESTRICTED; ++n)
      memset(r->fine_line.value[n], 0, (size_t)fine->layout.stride * sizeof(float));
    for (int s = 0; s < 3; ++s) {
      int beyond = FG__DIMENSION == 3;
      for (int d = -beyond; d <= beyond; ++d) {
        int row = 2 * J + d, slice = 2 * S - 1 + s, side = s == 0;
        if (FG__DIMENSION == 3)
          side = (d < 0) << 1 | side << 2;
        else
          side <<= 1;
        ptrdiff_t at =
            fg__row_at(&fine->layout, row_index(slice, row), plane_index(slice));
        return_row(fine, &r->slice[s],
                   row_in_slice(fine) + row * fine->layout.stride * beyond, at, side,
                   &r->fine_line);
      }
    }
    for (int n = 0; n < FG__RESTRICTED; ++n) {
      split(coarse, r->fine_line.value[n], out[n] + to);
      multiply(coarse->mass_inverse + to, out[n] + to, coarse->layout.stride);
    }
  }
}

static void take_slice(restriction *r, int s, const lines *to, bool linear)
{
  (r->fine->mass ? keep_slice : gather_slice)(r, s, to, linear);
}

/* Coarse slice S from fine slices 2 S - 1 (kept from the slice before, unless it is the
 * first of a part), 2 S and 2 S + 1. */
static void restrict_slice(restriction *r, int S, bool first, float *const out[],
                           bool linear)
{
  if (first)
    take_slice(r, slice_source(r->fine, 2 * S - 1), &r->slice[0], linear);
  take_slice(r, 2 * S, &r->slice[1], linear);
  take_slice(r, slice_source(r->fine, 2 * S + 1), &r->slice[2], linear);
  (r->fine->mass ? return_slices : combine_slices)(r, S, out);
  swap_lines(&r->slice[0], &r->slice[2]);
}

/* Cuts all lines from the thread's piece of the fine level's scratch space. */
static restriction restriction_of(const fg__level *fine, const fg__level *coarse,
                                  float tau, const fg__thread *thread)
{
  restriction r = {.fine = fine,
                   .coarse = coarse,
                   .l = laplacian_times(fine, tau),
                   .line = fine->layout.odd_offset};
  if (fine->shapes)
    r.shapes = shapes_of(fine, thread);
  ptrdiff_t stride = fine->layout.stride;
  ptrdiff_t slice = fg__gathered_floats(fine);
  float *space = fine->scratch + (size_t)thread->index * fine->scratch_size;
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

#endif
