#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "solver/multigrid.h"

/* Enough Gauss-Seidel sweeps for the coarsest grid when it is small; a side that cannot
 * be halved further needs more, in proportion. */
enum { COARSEST_SWEEPS = 12, COARSEST_CELLS = 4 };

const double fg__least_team_nodes = 200000.0;

/* A level is shared while each member gets so many nodes, or it is as large as that. */
static const double least_nodes_of_member = 5000.0;

static fg_status create_finest(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tensor *tensor,
                               double gamma, fg__team *team)
{
  fg__cells_of_box cells;
  fg_status status = fg__cells_from_tensor(&cells, context, tensor, mesh->dimension,
                                           mesh->cells, mesh->periodic, team);
  if (status)
    return status;
  fg__level_description description = {
      .dimension = mesh->dimension, .gamma = gamma, .finest = true, .team = team};
  for (int k = 0; k < 3; ++k) {
    description.cells[k] = mesh->cells[k];
    description.periodic[k] = mesh->periodic[k];
    description.spacing[k] = mesh->spacing[k];
  }
  return fg__level_create(&out->level[0], context, &description, &cells, NULL);
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
static fg_status create_coarser(fg__multigrid *out, fg_context *context, double gamma)
{
  while (out->level_count < FG__MOST_LEVELS &&
         fg__level_can_coarsen(&out->level[out->level_count - 1])) {
    fg__level *fine = &out->level[out->level_count - 1];
    ++out->level_count;
    fg_status status =
        fg__level_create_coarser(fine + 1, context, fine, gamma, out->team);
    if (status)
      return status;
    if (out->level_count > 2 || !fine->mass)
      fg__cells_clear(&fine->tensor);
    fg__elements_clear(&fine->elements);
  }
  return FG_STATUS_OK;
}

fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tensor *tensor,
                               double gamma, fg__team *team)
{
  static const fg__ranks one = {.count = 1};
  *out = (fg__multigrid){.kernel = fg__kernel_choose(mesh->dimension, FG_VECTORS_WIDEST),
                         .ranks = &one,
                         .team = team,
                         .level_count = 1};
  fg_status status = create_finest(out, context, mesh, tensor, gamma, team);
  if (!status)
    status = create_coarser(out, context, gamma);
  if (status) {
    fg__multigrid_clear(out);
    return status;
  }
  double least =
      fmin(least_nodes_of_member * fg__team_members(team), fg__least_team_nodes);
  while (out->team && out->shared_levels < out->level_count &&
         out->level[out->shared_levels].nodes >= least)
    ++out->shared_levels;
  choose_coarsest_sweeps(out);
  return FG_STATUS_OK;
}

static fg_status spread_levels(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tensor_recipe *recipe,
                               double gamma)
{
  fg__partition partition;
  fg_status status = fg__partition_copy(&partition, context, &mesh->partition);
  status = fg__ranks_agree(mesh->ranks, context, status);
  for (int halvings = 0; !status; ++halvings) {
    bool workable = fg__partition_is_workable(&partition, FG__LEAST_BLOCK_NODES) &&
                    halvings + 1 < FG__MOST_LEVELS;
    fg__spread *spread = &out->spread[halvings];
    fg__spread_description description = {
        halvings, gamma, halvings > 0 ? &out->spread[halvings - 1] : NULL};
    status = fg__spread_create(spread, context, mesh, recipe, &partition, &description);
    if (status || !workable)
      break;
    ++out->spread_count;
    if (halvings > 0)
      fg__elements_clear(&spread[-1].block.elements);
    status = fg__partition_coarsen(&partition, context, &spread->partition);
    status = fg__ranks_agree(mesh->ranks, context, status);
  }
  fg__partition_clear(&partition); /* what no level has taken over */
  return status;
}

/* The tensor of the first whole level from all ranks' blocks: a cell's values travel as
 * those of its lowest corner. */
static fg_status gather_cells(fg__cells_of_box *out, fg__elements *elements,
                              fg_context *context, const fg__multigrid *multigrid,
                              const fg__spread *image)
{
  int dimension = image->partition.dimension, arrays = dimension == 3 ? 7 : 4;
  if (image->masked)
    arrays = fg__element_values(dimension);
  const int *cells = image->partition.cells;
  fg__layout whole = fg__layout_of(dimension, image->partition.nodes);
  size_t count = (size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2];
  float *nodal = fg__allocate(whole.array_size, sizeof *nodal);
  float *plain = fg__allocate(count * (size_t)arrays, sizeof *plain);
  fg_status status = FG_STATUS_OK;
  if (!nodal || !plain)
    status = fg__fail_memory(context, "the coarse tensor", count * sizeof *plain);
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (status) {
    free(nodal);
    free(plain);
    return status;
  }
  float *place = nodal + whole.first, *carrier = image->residual[0];
  const float *values[FG__MOST_ELEMENT_VALUES];
  for (int a = 0; a < arrays; ++a) {
    const fg__level *block = &image->block;
    const fg__cells_of_box *own = &block->tensor;
    const float *from = image->masked    ? block->elements.value[a]
                        : a + 1 < arrays ? own->component[a]
                                         : own->weight;
    for (int k = 0; k < block->layout.nodes[2]; ++k)
      for (int j = 0; j < block->layout.nodes[1]; ++j)
        for (int i = 0; i < block->layout.nodes[0]; ++i)
          carrier[fg__node_at(&block->layout, i, j, k)] =
              image->masked ? from[fg__element_at(&block->elements, i, j, k)]
                            : from[fg__cell_at(own, i, j, k)];
    fg__gather_fill(multigrid->gather, 1, &carrier, &place);
    float *to = plain + (size_t)a * count;
    values[a] = to;
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i)
          *to++ = place[fg__node_at(&whole, i, j, k)];
  }
  const bool *periodic = image->partition.periodic;
  status = image->masked
               ? fg__elements_from_arrays(elements, context, values, dimension, cells,
                                          periodic)
               : fg__cells_from_arrays(out, context, values, dimension, cells, periodic);
  free(nodal);
  free(plain);
  return status;
}

static fg_status create_first_whole(fg__multigrid *out, fg_context *context,
                                    const fg__mesh *mesh, double gamma)
{
  const fg__spread *image = &out->spread[out->spread_count];
  fg_status status =
      fg__gather_create(&out->gather, context, &image->partition, FG__MOST_EXCHANGED);
  if (status)
    return status;
  fg__cells_of_box cells;
  fg__elements elements;
  status = gather_cells(&cells, &elements, context, out, image);
  if (status)
    return status;
  fg__level_description description = {.dimension = mesh->dimension, .gamma = gamma};
  for (int k = 0; k < 3; ++k) {
    description.cells[k] = image->partition.cells[k];
    description.periodic[k] = mesh->periodic[k];
    description.spacing[k] =
        mesh->spacing[k] * (k < mesh->dimension ? 1 << out->spread_count : 1);
  }
  out->level_count = 1;
  return image->masked
             ? fg__level_create(&out->level[0], context, &description, NULL, &elements)
             : fg__level_create(&out->level[0], context, &description, &cells, NULL);
}

fg_status fg__multigrid_create_spread(fg__multigrid *out, fg_context *context,
                                      const fg__mesh *mesh,
                                      const fg__tensor_recipe *recipe, double gamma)
{
  *out = (fg__multigrid){.kernel = fg__kernel_choose(mesh->dimension, FG_VECTORS_WIDEST),
                         .ranks = mesh->ranks};
  fg_status status = spread_levels(out, context, mesh, recipe, gamma);
  if (!status)
    status = create_first_whole(out, context, mesh, gamma);
  if (!status)
    status = create_coarser(out, context, gamma);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (status) {
    fg__multigrid_clear(out);
    return status;
  }
  choose_coarsest_sweeps(out);
  return FG_STATUS_OK;
}

void fg__multigrid_clear(fg__multigrid *multigrid)
{
  for (int n = 0; n < multigrid->level_count; ++n)
    fg__level_clear(&multigrid->level[n]);
  for (int n = 0; n < FG__MOST_LEVELS; ++n)
    fg__spread_clear(&multigrid->spread[n]);
  fg__gather_destroy(multigrid->gather);
  *multigrid = (fg__multigrid){0};
}
