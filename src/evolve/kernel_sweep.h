/* The collective Gauss-Seidel sweep. Part of kernel_body.h. */
#ifndef FG__KERNEL_SWEEP_H
#define FG__KERNEL_SWEEP_H

#include "evolve/kernel_stencil.h"

/* One colour of one row. Eliminating dw from
 *     du + tau l0 dw = first,   dw - g du = second,   g = Psi''(u) + k0
 * leaves a denominator 1 + tau l0 g, which in the spinodal region may vanish: it is kept
 * above a quarter of its value without Psi''. */
INLINE void smooth_row(const fg__level *level, int j, int colour, const laplacian *l,
                       bool linear, bool masked)
{
  row r = row_of(level, j, colour, linear, masked);
  ptrdiff_t own = (ptrdiff_t)j * level->stride + (colour == ODD ? level->odd_offset : 0);
  float *u = level->u + own, *w = level->w + own;
  INDEPENDENT
  for (int k = 0; k < r.count; ++k) {
    residuals f = residuals_at(&r, l, k, linear, masked);
    float k0 = r.energy.center[k];
    float l0 = masked ? l->tau * r.laplacian.center[k] : l->center;
    if (masked) {
      k0 *= r.mass_inverse[k];
      l0 *= r.mass_inverse[k];
    }
    float g = f.curvature + k0;
    float denominator = 1.0F + l0 * g;
    if (!linear)
      denominator = greater(denominator, 0.25F + 0.25F * l0 * k0);
    float du = (f.first - l0 * f.second) / denominator;
    u[k] += du;
    w[k] += f.second + g * du;
  }
  fg__fill_ghost_columns(level, level->u + (ptrdiff_t)j * level->stride);
  fg__fill_ghost_columns(level, level->w + (ptrdiff_t)j * level->stride);
}

INLINE void smooth_both(const fg__level *level, int j, const laplacian *l, bool linear,
                        bool masked)
{
  smooth_row(level, j, EVEN, l, linear, masked);
  smooth_row(level, j, ODD, l, linear, masked);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_row_source[side] == j) {
      fg__fill_ghost_row(level, level->u, side);
      fg__fill_ghost_row(level, level->w, side);
    }
}

/* Rows j (even) and j - 1: even rows run one ahead of odd rows, so that a sweep passes
 * memory once and yet every odd row finds both its neighbours done. */
INLINE void sweep_rows(const fg__level *level, int j, const laplacian *l, bool linear,
                       bool masked)
{
  if (j < level->rows)
    smooth_both(level, j, l, linear, masked);
  if (j > 0 && j - 1 < level->rows)
    smooth_both(level, j - 1, l, linear, masked);
}

INLINE void sweep(const fg__level *level, float tau, bool linear, bool masked)
{
  laplacian l = laplacian_times(level, tau);
  for (int j = 0; j < level->rows + 2; j += 2)
    sweep_rows(level, j, &l, linear, masked);
}

static void smooth_linear(const fg__level *level, float tau)
{
  if (level->mass)
    sweep(level, tau, true, true);
  else
    sweep(level, tau, true, false);
}

static void smooth(const fg__level *level, float tau)
{
  if (level->mass)
    sweep(level, tau, false, true);
  else
    sweep(level, tau, false, false);
}

#endif
