/* Operations on one of the pencils that share a level, between which ghosts are
 * exchanged. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_BOXES_H
#define FG__KERNEL_BOXES_H

#include "solver/kernel/pass.h"

static void smooth_rows_of(const fg__level *level, float tau, bool linear, int rows)
{
  laplacian l = laplacian_times(level, tau);
  const int *nodes = level->layout.nodes;
  smooth_row_loop *loop = smooth_loop[linear][level->mass != NULL];
  for (int k = rows >> 1; k < nodes[2]; k += 2)
    for (int j = rows & 1; j < nodes[1]; j += 2)
      loop(level, fg__row_at(&level->layout, j, k), &l);
}

static void find_residuals(const fg__level *level, float tau, bool linear,
                           float *const out[FG__RESTRICTED])
{
  fg__thread alone = fg__single_thread();
  laplacian l = laplacian_times(level, tau);
  shapes of_u = {0};
  const float *shape_round[3];
  if (!linear)
    of_u = shapes_of(level, &alone);
  for (int s = 0; s < fg__slices(level); ++s) {
    if (!linear)
      shapes_round(&of_u, s, shape_round);
    for (int n = 0; n < rows_of_slice(level); ++n) {
      int j = row_index(s, n), k = plane_index(s);
      ptrdiff_t at = fg__row_at(&level->layout, j, k);
      lines rows = {{out[0] + at, out[1] + at, out[2] + at, out[3] + at}};
      residual_line(level, j, k, &l, linear ? NULL : shape_round, &rows);
    }
  }
}

static void restrict_arrays(const fg__level *fine, const float *const from[],
                            const fg__level *coarse)
{
  fg__thread alone = fg__single_thread();
  restriction r = restriction_of(fine, coarse, 0.0F, &alone);
  float *const out[] = {coarse->p, coarse->q, coarse->coupling, coarse->shape_curvature};
  r.given = from;
  for (int S = 0; S < fg__slices(coarse); ++S)
    restrict_slice(&r, S, S == 0, out, true);
}

static void correct(const fg__level *coarse, const fg__level *fine, bool linear)
{
  fg__thread alone = fg__single_thread();
  for (int s = 0; s < fg__slices(fine); ++s)
    correct_slice(coarse, fine, s, linear, &alone);
}

#endif
