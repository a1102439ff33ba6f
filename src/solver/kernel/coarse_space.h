/* The coarse space: the corrections that a coarse level can represent. Part of
 * solver/kernel/body.h.
 *
 * An interface moves nearly free: J = Psi'' + K has near-null vectors of the shape of 1 -
 * u^2 across it, times whatever slowly changing v along it, which multilinear corrections
 * can not express. So u is corrected by d P v and w by P w, with d = 1 - u^2, where that
 * is positive, and a small share for the bulk, whose own changes are then v's. Testing
 * the first equation with P and the second with d P gives the coarse one weights R d for
 * the couplings of v to w, and R d^2 for K. In terms of scale * v, scale^2 = R d^2, K
 * keeps the coefficients that it has, and neighbours' scales differ by what
 * find_curvature adds (docs/design/interfaces.md). */
#ifndef FG__KERNEL_COARSE_SPACE_H
#define FG__KERNEL_COARSE_SPACE_H

#include <float.h>
#include <math.h>

#include "solver/kernel/sums.h"

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
  float *inverse = level->scale_inverse + at, *q = level->q + at;
  const float least = bulk * bulk;
  INDEPENDENT
  for (ptrdiff_t k = 0; k < level->layout.stride; ++k) {
    float shape = coupling[k];
    float square = least + shape_square * (shape - bulk);
    square = greater(greater(square, shape * shape), least);
    scale[k] = sqrtf(square);
    inverse[k] = 1.0F / scale[k];
    coupling[k] = shape * inverse[k];
    q[k] *= inverse[k];
  }
}

static void find_scale(const fg__level *level, const fg__thread *thread)
{
  slab mine = slab_of(level, thread);
  for (int s = mine.begin; s < mine.end; ++s) {
    for (int n = 0; n < rows_of_slice(level); ++n) {
      ptrdiff_t at = fg__row_at(&level->layout, row_index(s, n), plane_index(s));
      scale_row(level, at);
      fg__fill_ghost_columns(level, level->scale + at);
      fg__fill_ghost_columns(level, level->scale_inverse + at);
    }
    fill_ghosts_of_slice(level, level->scale, s);
    fill_ghosts_of_slice(level, level->scale_inverse, s);
  }
  fg__threads_barrier(thread);
}

/* Of the diagonal of K, what is left of it and the curvature at least. */
static const float least_diagonal = 0.25F;

/* Scales below this, twice bulk, are those of pure phases, whose curvature is positive.
 */
static const float pure_scale = 0.02F;

/* Restricted, d J d is near 0 at interfaces, of either sign. Negative values, of droplets
 * about to vanish, make cycles diverge. So does, in the corners of a mask, what positive
 * couplings of K to neighbours of far larger scale take from the diagonal; of a pure
 * phase round such a corner it would take even the curvature of the minimum. */
INLINE void curvature_nodes(const fg__level *level, ptrdiff_t row, int colour,
                            bool masked)
{
  ptrdiff_t own = row + begin_of(level, colour);
  int count = colour == ODD ? level->odd_count : level->even_count;
  couplings c = couplings_row(level, &level->energy, row, colour);
  around scale = around_row(level, level->scale, row, colour);
  const float *shape_curvature = level->shape_curvature + own;
  const float *inverse = level->scale_inverse + own;
  const float *mass_inverse = masked ? level->mass_inverse + own : NULL;
  float *curvature = level->curvature + own;
  INDEPENDENT
  for (int k = 0; k < count; ++k) {
    float energy = apply(&c, &scale, k);
    if (masked)
      energy *= mass_inverse[k];
    curvature[k] = (greater(shape_curvature[k], 0.0F) * inverse[k] - energy) * inverse[k];
    if (masked) {
      float least = (least_diagonal - 1.0F) * (c.center[k] * mass_inverse[k]);
      least = scale.center[k] < pure_scale ? 0.0F : least;
      curvature[k] = greater(curvature[k], least);
    }
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

/* The inverse denominator of a linear sweep (solver/kernel/sweep.h). Nodes without mass
 * have m = l0 = 0 and nothing to solve. */
INLINE void relaxation_nodes(const fg__level *level, ptrdiff_t row, int colour,
                             const laplacian *l, bool masked)
{
  ptrdiff_t own = row + begin_of(level, colour);
  int count = colour == ODD ? level->odd_count : level->even_count;
  const float *center = level->energy.center + own, *coupling = level->coupling + own;
  const float *curvature = level->curvature + own;
  const float *laplacian_center = masked ? level->laplacian.center + own : NULL;
  const float *mass_inverse = masked ? level->mass_inverse + own : NULL;
  float *relaxation = level->relaxation + own;
  float tau = l->tau, constant = l->center;
  INDEPENDENT
  for (int k = 0; k < count; ++k) {
    float k0 = center[k], l0 = masked ? tau * laplacian_center[k] : constant;
    if (masked) {
      k0 *= mass_inverse[k];
      l0 *= mass_inverse[k];
    }
    float m = coupling[k], g = greater(curvature[k] + k0, 0.25F * k0);
    relaxation[k] = 1.0F / (m * m + l0 * g + FLT_MIN);
  }
}

ROW_LOOP void relaxation_plain(const fg__level *level, ptrdiff_t row, int colour,
                               const laplacian *l)
{
  relaxation_nodes(level, row, colour, l, false);
}

ROW_LOOP void relaxation_masked(const fg__level *level, ptrdiff_t row, int colour,
                                const laplacian *l)
{
  relaxation_nodes(level, row, colour, l, true);
}

/* Of a level whose scale has its ghosts, or whose curvature is known. */
static void find_coefficients(const fg__level *level, float tau, bool curvature,
                              const fg__thread *thread)
{
  laplacian l = laplacian_times(level, tau);
  slab mine = slab_of(level, thread);
  for (int s = mine.begin; s < mine.end; ++s)
    for (int n = 0; n < rows_of_slice(level); ++n)
      for (int colour = EVEN; colour <= ODD; ++colour) {
        ptrdiff_t at = fg__row_at(&level->layout, row_index(s, n), plane_index(s));
        if (curvature)
          (level->mass ? curvature_masked : curvature_plain)(level, at, colour);
        (level->mass ? relaxation_masked : relaxation_plain)(level, at, colour, &l);
      }
  fg__threads_barrier(thread);
}

static void find_curvature(const fg__level *level, float tau, const fg__thread *thread)
{
  find_coefficients(level, tau, true, thread);
}

static void find_relaxation(const fg__level *level, float tau, const fg__thread *thread)
{
  find_coefficients(level, tau, false, thread);
}

static void unscale(const fg__level *level, const fg__thread *thread)
{
  ptrdiff_t begin, end;
  floats_of(level, thread, &begin, &end);
  float *u = level->u;
  const float *inverse = level->scale_inverse;
  INDEPENDENT
  for (ptrdiff_t n = begin; n < end; ++n)
    u[n] *= inverse[n];
  fg__threads_barrier(thread);
}

#endif
