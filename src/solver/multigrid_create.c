#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "solver/multigrid.h"

/* Enough Gauss-Seidel sweeps for the coarsest grid when it is small; a side that cannot
 * be halved further needs more, in proportion. */
enum { COARSEST_SWEEPS = 12, COARSEST_CELLS = 4 };

const double fg__least_threaded_nodes = 200000.0;

/* A level is shared while each thread gets so many nodes, or it is as large as that. */
static const double least_nodes_of_member = 5000.0;

/* The finest level of a process alone. */
static fg_status create_finest(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, fg__cells_of_box *cells, bool masked,
                               double gamma)
{
  fg__level_description description = {.dimension = mesh->dimension,
                                       .gamma = gamma,
                                       .finest = true,
                                       .masked = masked,
                                       .threads = out->threads};
  for (int k = 0; k < 3; ++k) {
    description.cells[k] = mesh->cells[k];
    description.periodic[k] = mesh->periodic[k];
    description.spacing[k] = mesh->spacing[k];
  }
  out->level_count = 1;
  return fg__level_create(&out->level[0], context, &description, cells, NULL);
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

/* The tensor of a level is freed once the next level has its own; the finest level's
 * weights are kept, because they define the subdomains. */
static fg_status create_coarser(fg__multigrid *out, fg_context *context, double gamma)
{
  while (out->level_count < FG__MOST_LEVELS &&
         fg__level_can_coarsen(&out->level[out->level_count - 1])) {
    fg__level *fine = &out->level[out->level_count - 1];
    ++out->level_count;
    fg_status status =
        fg__level_create_coarser(fine + 1, context, fine, gamma, out->threads);
    if (status)
      return status;
    if (out->level_count > 2 || !fine->mass)
      fg__cells_clear(&fine->tensor);
    fg__elements_clear(&fine->elements);
  }
  return FG_STATUS_OK;
}

static fg_status create_distributed(fg__multigrid *out, fg_context *context,
                                    const fg__mesh *mesh, fg__cells_of_box *cells,
                                    bool masked, double gamma)
{
  fg__partition partition;
  fg_status status = fg__partition_copy(&partition, context, &mesh->partition);
  status = fg__ranks_agree(mesh->ranks, context, status);
  for (int halvings = 0; !status; ++halvings) {
    bool workable = fg__partition_is_workable(&partition, FG__LEAST_BLOCK_NODES) &&
                    halvings + 1 < FG__MOST_LEVELS;
    fg__distributed *level = &out->distributed[halvings];
    fg__distributed_description description = {
        halvings, gamma, masked, halvings > 0 ? &out->distributed[halvings - 1] : NULL};
    status =
        fg__distributed_create(level, context, mesh, cells, &partition, &description);
    if (status || !workable)
      break;
    ++out->distributed_count;
    if (halvings > 0)
      fg__elements_clear(&level[-1].block.elements);
    status = fg__partition_coarsen(&partition, context, &level->partition);
    status = fg__ranks_agree(mesh->ranks, context, status);
  }
  fg__partition_clear(&partition); /* what no level has taken over */
  return status;
}

/* The tensor of the first replicated level from all ranks' blocks: a cell's values travel
 * as those of its lowest corner. */
static fg_status gather_cells(fg__cells_of_box *out, fg__elements *elements,
                              fg_context *context, const fg__multigrid *multigrid,
                              const fg__distributed *image)
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

static fg_status create_first_replicated(fg__multigrid *out, fg_context *context,
                                         const fg__mesh *mesh, double gamma)
{
  const fg__distributed *image = &out->distributed[out->distributed_count];
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
        mesh->spacing[k] * (k < mesh->dimension ? 1 << out->distributed_count : 1);
  }
  out->level_count = 1;
  return image->masked
             ? fg__level_create(&out->level[0], context, &description, NULL, &elements)
             : fg__level_create(&out->level[0], context, &description, &cells, NULL);
}

static void choose_shared_levels(fg__multigrid *multigrid)
{
  double least = fmin(least_nodes_of_member * fg__threads_count(multigrid->threads),
                      fg__least_threaded_nodes);
  while (multigrid->threads && multigrid->threaded_levels < multigrid->level_count &&
         multigrid->level[multigrid->threaded_levels].nodes >= least)
    ++multigrid->threaded_levels;
}

fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, fg__cells_of_box *cells, bool masked,
                               double gamma, fg__threads *threads)
{
  const fg__ranks *ranks = mesh->ranks;
  *out = (fg__multigrid){.kernel = fg__kernel_choose(mesh->dimension, FG_VECTORS_WIDEST),
                         .ranks = ranks,
                         .threads = threads};
  fg_status status = fg__partition_copy(&out->partition, context, &mesh->partition);
  status = fg__ranks_agree(ranks, context, status);
  if (!status && ranks->count > 1) {
    status = create_distributed(out, context, mesh, cells, masked, gamma);
    if (!status)
      status = create_first_replicated(out, context, mesh, gamma);
  } else if (!status) {
    status = create_finest(out, context, mesh, cells, masked, gamma);
  }
  if (!status)
    status = create_coarser(out, context, gamma);
  status = fg__ranks_agree(ranks, context, status);
  fg__cells_clear(cells); /* unless a level has taken them over */
  if (status) {
    fg__multigrid_clear(out);
    return status;
  }
  choose_shared_levels(out);
  choose_coarsest_sweeps(out);
  return FG_STATUS_OK;
}

void fg__multigrid_clear(fg__multigrid *multigrid)
{
  for (int n = 0; n < multigrid->level_count; ++n)
    fg__level_clear(&multigrid->level[n]);
  for (int n = 0; n < FG__MOST_LEVELS; ++n)
    fg__distributed_clear(&multigrid->distributed[n]);
  fg__gather_destroy(multigrid->gather);
  fg__partition_clear(&multigrid->partition);
  *multigrid = (fg__multigrid){0};
}
