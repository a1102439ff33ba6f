/* Prolongation: a coarse correction added to u and w. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_CORRECT_H
#define FG__KERNEL_CORRECT_H

#include <string.h>

#include "solver/kernel/coarse_space.h"

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

INLINE float shaped_change(float u, float v)
{
  return bounded_change(u, (bulk + interface_shape(u)) * v);
}

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
      change = shaped_change(even[n], change);
    else if (by == SCALE)
      change *= scale[n];
    even[n] += change;
  }
  INDEPENDENT
  for (int n = 0; n < fine->odd_count; ++n) {
    float change = 0.5F * (natural[n] + natural[n + 1]);
    if (by == SHAPE)
      change = shaped_change(odd[n], change);
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

/* With a mask nodes follow coarse ones as level->interpolation says: adds what one of the
 * coarse rows round a fine row gives to the changes there, `side` which it is. */
ROW_LOOP void follow_row(const fg__level *coarse, const float *from,
                         const fg__level *fine, ptrdiff_t at, int side, float *natural,
                         float *change)
{
  const float *const same[4] = {from, from, from, from};
  const float *low = fine->interpolation[side] + at;
  const float *high = fine->interpolation[side | 1] + at;
  ptrdiff_t odd = fine->layout.odd_offset;
  merge(coarse, same, natural);
  INDEPENDENT
  for (int n = 0; n < fine->even_count; ++n)
    change[n] += low[n] * natural[n];
  INDEPENDENT
  for (int n = 0; n < fine->odd_count; ++n)
    change[odd + n] += low[odd + n] * natural[n] + high[odd + n] * natural[n + 1];
}

INLINE void add_to_row(const fg__level *fine, const float *change, ptrdiff_t at,
                       float *array, factor by)
{
  const float *scale = by == SCALE ? fine->scale + at : NULL;
  float *values = array + at;
  INDEPENDENT
  for (ptrdiff_t n = 0; n < fine->layout.stride; ++n) {
    float amount = change[n];
    if (by == SHAPE)
      amount = shaped_change(values[n], amount);
    else if (by == SCALE)
      amount *= scale[n];
    values[n] += amount;
  }
}

ROW_LOOP void add_by_shape(const fg__level *fine, const float *change, ptrdiff_t at)
{
  add_to_row(fine, change, at, fine->u, SHAPE);
}

ROW_LOOP void add_by_scale(const fg__level *fine, const float *change, ptrdiff_t at)
{
  add_to_row(fine, change, at, fine->u, SCALE);
}

ROW_LOOP void add_as_it_is(const fg__level *fine, const float *change, ptrdiff_t at)
{
  add_to_row(fine, change, at, fine->w, ONE);
}

static void correct_masked(const fg__level *coarse, const ptrdiff_t at[4], int odd,
                           const fg__level *fine, ptrdiff_t row, float *natural,
                           bool linear)
{
  float *change = natural - fine->layout.stride;
  const float *const arrays[] = {coarse->u, coarse->w};
  for (int a = 0; a < 2; ++a) {
    memset(change, 0, (size_t)fine->layout.stride * sizeof *change);
    for (int n = 0; n < 4; ++n)
      if ((n & ~odd) == 0)
        follow_row(coarse, arrays[a] + at[n], fine, row, n << 1, natural, change);
    (a == 1 ? add_as_it_is : linear ? add_by_scale : add_by_shape)(fine, change, row);
  }
  fg__fill_ghost_columns(fine, fine->u + row);
  fg__fill_ghost_columns(fine, fine->w + row);
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
  if (fine->mass)
    correct_masked(coarse, at, (j & 1) | (k & 1) << 1, fine, row, natural, linear);
  else
    (linear ? correct_by_scale : correct_by_shape)(coarse, at, fine, row, natural);
  for (int side = 0; side < 2; ++side)
    if (fine->ghost_row_source[side] == j) {
      fg__fill_ghost_row(fine, fine->u, k, side);
      fg__fill_ghost_row(fine, fine->w, k, side);
    }
}

static void correct_slice(const fg__level *coarse, const fg__level *fine, int s,
                          bool linear, const fg__thread *thread)
{
  float *natural = fine->scratch + (size_t)(thread->index + 1) * fine->scratch_size -
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
static void correct_ends(const fg__level *coarse, const fg__level *fine, slab mine,
                         bool linear, const fg__thread *thread)
{
  int last = mine.end - 1;
  for (int s = mine.begin; s < mine.end && s < mine.begin + 2; ++s)
    correct_slice(coarse, fine, s, linear, thread);
  if (last >= mine.begin + 2)
    correct_slice(coarse, fine, last, linear, thread);
  fg__threads_exchange(thread, FG__FIRST_SLICE | FG__LAST_SLICE);
}

#endif
