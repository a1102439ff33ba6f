#include "evolve/multigrid.h"

#include <stdlib.h>

#include "base/memory.h"

/* Enough Gauss-Seidel sweeps for the coarsest grid when it is small (design.md section
 * 9); a side that cannot be halved further needs more, in proportion. */
enum { COARSEST_SWEEPS = 12, COARSEST_CELLS = 4 };

/* A level of fewer nodes is done sooner by one thread than by several that wait for each
 * other (docs/design/evolution.md). */
static const double least_shared_nodes = 60000.0;

static fg_status create_finest(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tile *tile,
                               const fg__tensor *tensor, double gamma, int threads)
{
  fg__cells_of_box cells;
  fg_status status = fg__cells_from_tensor(&cells, context, tensor, mesh->dimension,
                                           tile->cells, mesh->periodic);
  if (status)
    return status;
  fg__level_description description = {
      .dimension = mesh->dimension, .gamma = gamma, .finest = true, .members = threads};
  for (int k = 0; k < 3; ++k) {
    description.cells[k] = tile->cells[k];
    description.periodic[k] = mesh->periodic[k];
    description.spacing[k] = mesh->spacing[k];
  }
  return fg__level_create(&out->level[0], context, &description, &cells);
}

static void choose_coarsest_sweeps(fg__multigrid *multigrid)
{
  const fg__level *coarsest = &multigrid->level[multigrid->level_count - 1];
  int side = 1;
  for (int k = 0; k < coarsest->layout.dimension; ++k)
    side = coarsest->cells[k] > side ? coarsest->cells[k] : side;
  multigrid->coarsest_sweeps =
      COARSEST_SWEEPS * (side > COARSEST_CELLS ? side / COARSEST_CELLS : 1);
}

/* The tensor of a level has done its service once the next level has its own; the finest
 * level's weights still tell the parts of the domain. */
static fg_status create_coarser(fg__multigrid *out, fg_context *context, double gamma,
                                int threads)
{
  while (out->level_count < FG__MOST_LEVELS &&
         fg__level_can_coarsen(&out->level[out->level_count - 1])) {
    fg__level *fine = &out->level[out->level_count - 1];
    ++out->level_count;
    fg_status status = fg__level_create_coarser(fine + 1, context, fine, gamma, threads);
    if (status)
      return status;
    if (out->level_count > 2 || !fine->mass)
      fg__cells_clear(&fine->tensor);
  }
  return FG_STATUS_OK;
}

fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tile *tile,
                               const fg__tensor *tensor, double gamma, int threads)
{
  *out = (fg__multigrid){.kernel = fg__kernel_choose(mesh->dimension), .level_count = 1};
  fg_status status = create_finest(out, context, mesh, tile, tensor, gamma, threads);
  if (!status)
    status = create_coarser(out, context, gamma, threads);
  if (!status && out->level[0].nodes >= least_shared_nodes)
    status = fg__team_create(&out->team, context, threads);
  if (status) {
    fg__multigrid_clear(out);
    return status;
  }
  while (out->team && out->shared_levels < out->level_count &&
         out->level[out->shared_levels].nodes >= least_shared_nodes)
    ++out->shared_levels;
  choose_coarsest_sweeps(out);
  return FG_STATUS_OK;
}

void fg__multigrid_clear(fg__multigrid *multigrid)
{
  fg__team_destroy(multigrid->team);
  for (int n = 0; n < multigrid->level_count; ++n)
    fg__level_clear(&multigrid->level[n]);
  *multigrid = (fg__multigrid){0};
}

/* The levels below the shared ones, from and back to level n. */
static void cycle_alone(const fg__multigrid *multigrid, int n, float tau)
{
  const fg__kernel *kernel = multigrid->kernel;
  const fg__level *level = multigrid->level;
  int last = multigrid->level_count - 1;
  fg__share alone = fg__alone();
  for (int m = n; m < last; ++m)
    if (m == 0)
      kernel->smooth_restrict(&level[0], &level[1], tau, &alone);
    else
      kernel->smooth_restrict_linear(&level[m], &level[m + 1], tau, &alone);
  for (int sweep = 0; sweep < multigrid->coarsest_sweeps; ++sweep)
    if (last == 0) /* a mesh too small to coarsen: smoothing alone */
      kernel->smooth(&level[0], tau, &alone);
    else
      kernel->smooth_linear(&level[last], tau, &alone);
  for (int m = last - 1; m >= n; --m)
    if (m == 0)
      kernel->prolong_smooth(&level[1], &level[0], tau, &alone);
    else
      kernel->prolong_smooth_linear(&level[m + 1], &level[m], tau, &alone);
}

void fg__multigrid_cycle(const fg__multigrid *multigrid, double tau,
                         const fg__share *share)
{
  const fg__kernel *kernel = multigrid->kernel;
  const fg__level *level = multigrid->level;
  int last = multigrid->level_count - 1;
  int shared = multigrid->shared_levels < last ? multigrid->shared_levels : last;
  float step = (float)tau;
  for (int n = 0; n < shared; ++n)
    if (n == 0)
      kernel->smooth_restrict(&level[0], &level[1], step, share);
    else
      kernel->smooth_restrict_linear(&level[n], &level[n + 1], step, share);
  if (share->member == 0)
    cycle_alone(multigrid, shared, step);
  fg__team_barrier(share);
  for (int n = shared - 1; n >= 0; --n)
    if (n == 0)
      kernel->prolong_smooth(&level[1], &level[0], step, share);
    else
      kernel->prolong_smooth_linear(&level[n + 1], &level[n], step, share);
}
