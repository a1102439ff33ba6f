/* The space of a coarse level's corrections. Part of kernel_body.h.
 *
 * An interface moves nearly free: J = Psi'' + K has near-null vectors of the shape of
 * 1 - u^2 across it, times whatever slowly changing v along it, which multilinear
 * corrections can not express. So u is corrected by d P v and w by P w, with d = 1 - u^2,
 * where that is positive, and a small share for the bulk, whose own changes are then v's.
 * Testing the first equation with P and the second with d P gives the coarse one weights
 * R d for the couplings of v to w, and R d^2 for K. In terms of scale * v,
 * scale^2 = R d^2, K keeps the coefficients that it has, and neighbours' scales differ by
 * what find_curvature adds (docs/design/interfaces.md). */
#ifndef FG__KERNEL_SPACE_H
#define FG__KERNEL_SPACE_H

#include <math.h>

#include "evolve/kernel_sums.h"

/* d in the pure phases. More slows interfaces where coarse cells hold little of them: at
 * 1025 nodes 0.02, 0.01, 0.0025 leave a lag in time of 4.4, 3.5, 2.2 %, but the least
 * needs more cycles and rejects. */
static const float bulk = 0.01F;

/* Integrals across a resting interface: of (1 - u^2)^2 over those of 1 - u^2. */
static const float shape_square = 2.0F / 3.0F;

/* R d^2 follows from R d where there are interfaces; where d is constant (noise) it is
 * the square. */
ROW_LOOP void scale_row(const fg__level *level, ptrdiff_t at)
{
  float *scale = level->scale + at, *coupling = level->coupling + at;
  float *q = level->q + at, least = bulk * bulk;
  INDEPENDENT
  for (ptrdiff_t k = 0; k < level->layout.stride; ++k) {
    float shape = coupling[k];
    float square = least + shape_square * (shape - bulk);
    square = greater(greater(square, shape * shape), least);
    scale[k] = sqrtf(square);
    coupling[k] = shape / scale[k];
    q[k] /= scale[k];
  }
}

static void find_scale(const fg__level *level, const fg__share *share)
{
  part mine = part_of(level, share);
  for (int s = mine.begin; s < mine.end; ++s) {
    for (int n = 0; n < rows_of_slice(level); ++n) {
      ptrdiff_t at = fg__row_at(&level->layout, row_index(s, n), plane_index(s));
      scale_row(level, at);
      fg__fill_ghost_columns(level, level->scale + at);
    }
    fill_ghosts_of_slice(level, level->scale, s);
  }
  fg__team_barrier(share);
}

/* Restricted, d J d is near 0 at interfaces, of either sign. Negative values, of droplets
 * about to vanish, make cycles diverge. */
INLINE void curvature_nodes(const fg__level *level, ptrdiff_t row, int colour,
                            bool masked)
{
  ptrdiff_t own = row + begin_of(level, colour);
  int count = colour == ODD ? level->odd_count : level->even_count;
  couplings c = couplings_row(level, &level->energy, row, colour);
  around scale = around_row(level, level->scale, row, colour);
  const float *shape_curvature = level->shape_curvature + own;
  const float *inverse = masked ? level->mass_inverse + own : NULL;
  float *curvature = level->curvature + own;
  INDEPENDENT
  for (int k = 0; k < count; ++k) {
    float energy = apply(&c, &scale, k), s = scale.center[k];
    if (masked)
      energy *= inverse[k];
    curvature[k] = (greater(shape_curvature[k], 0.0F) / s - energy) / s;
  }
}

ROW_LOOP void curvature_plain(const fg__level *level, ptrdiff_t row, int colour)
{
  curvature_nodes(level, row, colour, false);
}

ROW_LOOP void curvature_masked(const fg__level *level, ptrdiff_t row, int colour)
{
  curvature_nodes(level, row, colour, true);
}

static void find_curvature(const fg__level *level, const fg__share *share)
{
  part mine = part_of(level, share);
  for (int s = mine.begin; s < mine.end; ++s)
    for (int n = 0; n < rows_of_slice(level); ++n)
      for (int colour = EVEN; colour <= ODD; ++colour)
        (level->mass ? curvature_masked : curvature_plain)(
            level, fg__row_at(&level->layout, row_index(s, n), plane_index(s)), colour);
  fg__team_barrier(share);
}

static void unscale(const fg__level *level, const fg__share *share)
{
  ptrdiff_t begin, end;
  floats_of(level, share, &begin, &end);
  float *u = level->u;
  const float *scale = level->scale;
  INDEPENDENT
  for (ptrdiff_t n = begin; n < end; ++n)
    u[n] /= scale[n];
  fg__team_barrier(share);
}

#endif
