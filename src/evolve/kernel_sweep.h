/* The collective Gauss-Seidel sweep. Part of kernel_body.h. */
#ifndef FG__KERNEL_SWEEP_H
#define FG__KERNEL_SWEEP_H

#include "evolve/kernel_stencil.h"

/* One colour of one row. Eliminating dw from
 *     m du + tau l0 dw = first,   m dw - g du = second,   g = Psi''(u) + k0
 * (m = 1 on the finest level) leaves a denominator m^2 + tau l0 g, which in the spinodal
 * region may vanish: it (on coarse levels g) is kept above a quarter of its value without
 * Psi''. On coarse levels its inverse, the relaxation, is found once a cycle. */
INLINE void smooth_nodes(const fg__level *level, ptrdiff_t at, int colour,
                         const laplacian *constants, bool linear, bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  row_view r = row_of(level, at, colour, linear, masked);
  ptrdiff_t own = at + begin_of(level, colour);
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
    if (linear) {
      float m = r.coupling[k], inverse = r.relaxation[k];
      g = greater(g, 0.25F * k0);
      u[k] += (m * f.first - l0 * f.second) * inverse;
      w[k] += (m * f.second + g * f.first) * inverse;
      continue;
    }
    float denominator = greater(1.0F + l0 * g, 0.25F + 0.25F * l0 * k0);
    float du = (f.first - l0 * f.second) / denominator;
    u[k] += du;
    w[k] += f.second + g * du;
  }
}

ROW_LOOP void smooth_plain(const fg__level *level, ptrdiff_t at, int colour,
                           const laplacian *l)
{
  smooth_nodes(level, at, colour, l, false, false);
}

ROW_LOOP void smooth_masked(const fg__level *level, ptrdiff_t at, int colour,
                            const laplacian *l)
{
  smooth_nodes(level, at, colour, l, false, true);
}

ROW_LOOP void smooth_linear_plain(const fg__level *level, ptrdiff_t at, int colour,
                                  const laplacian *l)
{
  smooth_nodes(level, at, colour, l, true, false);
}

ROW_LOOP void smooth_linear_masked(const fg__level *level, ptrdiff_t at, int colour,
                                   const laplacian *l)
{
  smooth_nodes(level, at, colour, l, true, true);
}

static void smooth_colour(const fg__level *level, ptrdiff_t at, int colour,
                          const laplacian *l, bool linear)
{
  if (level->mass)
    (linear ? smooth_linear_masked : smooth_masked)(level, at, colour, l);
  else
    (linear ? smooth_linear_plain : smooth_plain)(level, at, colour, l);
  fg__fill_ghost_columns(level, level->u + at);
  fg__fill_ghost_columns(level, level->w + at);
}

/* Row j of plane k, and the ghost rows that are its copies. */
static void smooth_row(const fg__level *level, int j, int k, const laplacian *l,
                       bool linear)
{
  ptrdiff_t at = fg__row_at(&level->layout, j, k);
  smooth_colour(level, at, EVEN, l, linear);
  smooth_colour(level, at, ODD, l, linear);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_row_source[side] == j) {
      fg__fill_ghost_row(level, level->u, k, side);
      fg__fill_ghost_row(level, level->w, k, side);
    }
}

#if FG__DIMENSION == 3
/* Rows j (even) and j - 1: even rows run one ahead of odd rows, so that a sweep passes
 * memory once and yet every odd row finds both its neighbours done. */
static void smooth_rows(const fg__level *level, int j, int k, const laplacian *l,
                        bool linear)
{
  int rows = level->layout.nodes[1];
  if (j < rows)
    smooth_row(level, j, k, l, linear);
  if (j > 0 && j - 1 < rows)
    smooth_row(level, j - 1, k, l, linear);
}

static void smooth_slice(const fg__level *level, int k, const laplacian *l, bool linear)
{
  for (int j = 0; j < level->layout.nodes[1] + 2; j += 2)
    smooth_rows(level, j, k, l, linear);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_plane_source[side] == k) {
      fg__fill_ghost_plane(level, level->u, side);
      fg__fill_ghost_plane(level, level->w, side);
    }
}
#else
static void smooth_slice(const fg__level *level, int j, const laplacian *l, bool linear)
{
  smooth_row(level, j, 0, l, linear);
}
#endif

/* A member's slices in a sweep: [begin, end), begin even. */
typedef struct part {
  int begin, end;
} part;

static part part_of(const fg__level *level, const fg__share *share)
{
  part p;
  fg__team_part(share, fg__slices(level), 2, &p.begin, &p.end);
  return p;
}

/* The first slice of each part comes first: the last one of the part before needs it. */
static void begin_sweep(const fg__level *level, part mine, const laplacian *l,
                        bool linear, const fg__share *share)
{
  if (mine.begin < mine.end)
    smooth_slice(level, mine.begin, l, linear);
  fg__team_meet(share, FG__FIRST_SLICE);
}

/* Slices s (even, not the first) and s - 1, as far as they are of the part: again even
 * ones run ahead. */
static void continue_sweep(const fg__level *level, int s, part mine, const laplacian *l,
                           bool linear)
{
  if (s < mine.end)
    smooth_slice(level, s, l, linear);
  if (s - 1 < mine.end)
    smooth_slice(level, s - 1, l, linear);
}

static void sweep(const fg__level *level, float tau, bool linear, const fg__share *share)
{
  laplacian l = laplacian_times(level, tau);
  part mine = part_of(level, share);
  begin_sweep(level, mine, &l, linear, share);
  for (int s = mine.begin + 2; s <= mine.end + 1; s += 2)
    continue_sweep(level, s, mine, &l, linear);
  fg__team_meet(share, FG__LAST_SLICE);
}

static void smooth_linear(const fg__level *level, float tau, const fg__share *share)
{
  sweep(level, tau, true, share);
}

static void smooth(const fg__level *level, float tau, const fg__share *share)
{
  sweep(level, tau, false, share);
}

#endif
