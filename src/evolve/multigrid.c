#include "evolve/multigrid.h"

#include <stdlib.h>

#include "base/memory.h"

/* Enough Gauss-Seidel sweeps for the coarsest grid when it is small (design.md section
 * 9); a side that cannot be halved further needs more, in proportion. */
enum { COARSEST_SWEEPS = 12, COARSEST_CELLS = 4 };

fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tile *tile,
                               const fg__tensor *tensor, double gamma)
{
  *out = (fg__multigrid){.kernel = fg__kernel_choose()};
  size_t count = (size_t)tile->cells[0] * (size_t)tile->cells[1];
  float *weight = fg__allocate(count, sizeof *weight);
  if (!weight)
    return fg__fail_memory(context, "the mask", count * sizeof *weight);
  for (size_t n = 0; n < count; ++n)
    weight[n] = tensor->active[n] ? 1.0F : 0.0F;
  fg_status status = fg__level_create(&out->level[0], context, tile->cells,
                                      mesh->periodic, mesh->spacing, gamma, tensor->xx,
                                      tensor->xy, tensor->yy, weight, true);
  free(weight);
  out->level_count = 1;
  while (!status && out->level_count < FG__MOST_LEVELS &&
         fg__level_can_coarsen(&out->level[out->level_count - 1])) {
    fg__level *fine = &out->level[out->level_count - 1];
    status = fg__level_create_coarser(fine + 1, context, fine, gamma);
    ++out->level_count;
  }
  if (status) {
    fg__multigrid_clear(out);
    return status;
  }
  const fg__level *coarsest = &out->level[out->level_count - 1];
  int side =
      coarsest->cells[0] > coarsest->cells[1] ? coarsest->cells[0] : coarsest->cells[1];
  out->coarsest_sweeps =
      COARSEST_SWEEPS * (side > COARSEST_CELLS ? side / COARSEST_CELLS : 1);
  return FG_STATUS_OK;
}

void fg__multigrid_clear(fg__multigrid *multigrid)
{
  for (int n = 0; n < multigrid->level_count; ++n)
    fg__level_clear(&multigrid->level[n]);
  multigrid->level_count = 0;
}

void fg__multigrid_cycle(const fg__multigrid *multigrid, double tau)
{
  const fg__kernel *kernel = multigrid->kernel;
  const fg__level *level = multigrid->level;
  int last = multigrid->level_count - 1;
  float step = (float)tau;
  if (last == 0) { /* a mesh too small to coarsen: smoothing alone */
    for (int sweep = 0; sweep < multigrid->coarsest_sweeps; ++sweep)
      kernel->smooth(&level[0], step);
    return;
  }
  kernel->smooth_restrict(&level[0], &level[1], step);
  for (int n = 1; n < last; ++n)
    kernel->smooth_restrict_linear(&level[n], &level[n + 1], step);
  for (int sweep = 0; sweep < multigrid->coarsest_sweeps; ++sweep)
    kernel->smooth_linear(&level[last], step);
  for (int n = last - 1; n > 0; --n)
    kernel->prolong_smooth_linear(&level[n + 1], &level[n], step);
  kernel->prolong_smooth(&level[1], &level[0], step);
}
