#include "density/density.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "component/components.h"

struct fg_density {
  fg_density_arrays arrays;
  fg__density_block block;
};

static fg_status check(fg_context *context, const fg_density_arrays *arrays)
{
  if (arrays->dimension != 2 && arrays->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: dimension %d, not 2 or 3",
                    arrays->dimension);
  if (!arrays->u)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: no values");
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k) {
    if (arrays->nodes[k] < 2)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "density: %d nodes along axis %d, at least 2 are needed",
                      arrays->nodes[k], k);
    if (!(arrays->spacing[k] > 0.0) || !isfinite(arrays->spacing[k]) ||
        !isfinite(arrays->origin[k]))
      return fg__fail(
          context, FG_STATUS_ARGUMENT,
          "density: spacing %g and origin %g along axis %d; a spacing above 0 and "
          "finite numbers are needed",
          arrays->spacing[k], arrays->origin[k], k);
    if ((size_t)arrays->nodes[k] > SIZE_MAX / 16 / count)
      return fg__fail(context, FG_STATUS_ARGUMENT, "density: the grid is too large");
    count *= (size_t)arrays->nodes[k];
  }
  return FG_STATUS_OK;
}

void fg__density_block_clear(fg__density_block *block)
{
  fg__partition_clear(&block->partition);
  free(block->u);
  free(block->label);
  free(block->active);
  free(block->area);
  *block = (fg__density_block){0};
}

static fg_status allocate(fg__density_block *out, fg_context *context,
                          const fg__box *nodes)
{
  fg__box cells = fg__block_cells(&out->partition, nodes);
  size_t node_count = (size_t)fg__box_count(nodes);
  size_t cell_count = out->masked ? (size_t)fg__box_count(&cells) : 0;
  out->u = fg__allocate(node_count, sizeof *out->u);
  out->label = fg__allocate(node_count, sizeof *out->label);
  out->active = out->masked ? fg__allocate(cell_count, 1) : NULL;
  if (out->u && out->label && (out->active || !out->masked))
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a density",
                         node_count * (sizeof *out->u + sizeof *out->label) + cell_count);
}

fg_status fg__density_block_create(fg__density_block *out, fg_context *context,
                                   const fg__partition *partition, bool masked)
{
  *out = (fg__density_block){.masked = masked};
  fg_status status = fg__partition_copy(&out->partition, context, partition);
  if (!status)
    status = allocate(out, context, fg__own_block(partition));
  if (status)
    fg__density_block_clear(out);
  return status;
}

fg_status fg__density_create(fg_density **out, fg_context *context,
                             const fg_density_arrays *arrays, fg__density_block *block)
{
  fg_density *density = *out = fg__allocate(1, sizeof *density);
  if (!density)
    return fg__fail_memory(context, "a density", sizeof *density);
  density->arrays = *arrays;
  for (int k = arrays->dimension; k < 3; ++k) {
    density->arrays.nodes[k] = 1;
    density->arrays.origin[k] = density->arrays.spacing[k] = 0.0;
    density->arrays.periodic[k] = false;
  }
  density->block = *block;
  *block = (fg__density_block){0};
  bool alone = density->block.partition.ranks->count == 1;
  density->arrays.u = alone ? density->block.u : NULL;
  density->arrays.active = alone ? density->block.active : NULL;
  return FG_STATUS_OK;
}

/* Labels of a whole grid. */
static fg_status find_clusters(fg__density_block *block, fg_context *context,
                               const fg_density_arrays *arrays)
{
  fg__component_grid grid = {.nodes = {1, 1, 1}, .u = block->u, .active = block->active};
  fg__components found = {0};
  double cell = 1.0;
  for (int k = 0; k < arrays->dimension; ++k) {
    grid.nodes[k] = arrays->nodes[k];
    grid.periodic[k] = arrays->periodic[k];
    cell *= arrays->spacing[k];
  }
  grid.debris_area = arrays->debris_area / cell;
  fg_status status = fg__components_count(&found, context, &grid);
  if (!status) {
    fg__component_box box = fg__component_box_of(&grid);
    fg__components_label(&found, &box, found.piece_label, 0, block->label);
    block->area = found.area;
    block->count = found.count;
    block->debris = found.debris;
    found.area = NULL;
  }
  fg__components_clear(&found);
  return status;
}

static fg_status create_block(fg__density_block *out, fg_context *context,
                              const fg_density_arrays *arrays)
{
  static const int blocks[3] = {1, 1, 1};
  int cells[3] = {1, 1, 1};
  fg__partition partition;
  *out = (fg__density_block){0};
  for (int k = 0; k < arrays->dimension; ++k)
    cells[k] = arrays->nodes[k] - !arrays->periodic[k];
  fg_status status =
      fg__partition_create(&partition, context, &fg__single_rank, arrays->dimension,
                           cells, arrays->periodic, blocks, 1);
  if (!status)
    status = fg__density_block_create(out, context, &partition, arrays->active);
  if (!status) {
    fg__box own = fg__block_cells(&partition, fg__own_block(&partition));
    size_t nodes = (size_t)fg__box_count(fg__own_block(&partition));
    memcpy(out->u, arrays->u, nodes * sizeof *out->u);
    if (arrays->active && out->active)
      memcpy(out->active, arrays->active, (size_t)fg__box_count(&own));
    status = find_clusters(out, context, arrays);
  }
  fg__partition_clear(&partition);
  return status;
}

fg_status fg_density_create_from_arrays(fg_density **out, fg_context *context,
                                        const fg_density_arrays *arrays)
{
  if (!out || !arrays)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: a NULL argument");
  *out = NULL;
  fg_status status = check(context, arrays);
  if (status)
    return status;
  fg__density_block block;
  status = create_block(&block, context, arrays);
  if (!status)
    status = fg__density_create(out, context, arrays, &block);
  fg__density_block_clear(&block);
  return status;
}

void fg_density_destroy(fg_density *density)
{
  if (!density)
    return;
  fg__density_block_clear(&density->block);
  free(density);
}

const fg__density_block *fg__density_block_of(const fg_density *density)
{
  return &density->block;
}

bool fg_density_is_distributed(const fg_density *density)
{
  return density->block.partition.ranks->count > 1;
}

fg_status fg__density_fill(const fg_density *density, fg_context *context,
                           fg__density_kind kind, const fg__region *region, int count,
                           void *const out[])
{
  const fg__density_block *block = &density->block;
  const fg__partition *partition = &block->partition;
  const fg__box nodes = *fg__own_block(partition);
  const fg__box cells = fg__block_cells(partition, &nodes);
  const int *along = kind == FG__DENSITY_ACTIVE ? cells.nodes : nodes.nodes;
  fg__region_source source = {.size = 1,
                              .first = block->active,
                              .row = along[0],
                              .plane = (ptrdiff_t)along[0] * along[1]};
  if (kind == FG__DENSITY_U) {
    source.first = block->u;
    source.size = sizeof *block->u;
  } else if (kind == FG__DENSITY_LABEL) {
    source.first = block->label;
    source.size = sizeof *block->label;
  }
  return fg__regions_fill(context, partition, region, count, &source, out);
}

/* The whole grid as one region for rank 0. `to` is empty on other ranks. */
static fg_status gather(const fg_density *density, fg_context *context,
                        fg__density_block *to)
{
  const fg__partition *partition = &density->block.partition;
  fg__region nodes = {.nodes = {{0, 0, 0}, {1, 1, 1}}}, cells = nodes;
  for (int k = 0; k < partition->dimension; ++k) {
    nodes.nodes.nodes[k] = partition->nodes[k];
    cells.nodes.nodes[k] = partition->cells[k];
  }
  void *const values[] = {to->u}, *const labels[] = {to->label};
  void *const flags[] = {to->active};
  fg__counters *counters = partition->ranks->counters;
  fg_phase before = fg__phase_continue(counters, FG_PHASE_SNAPSHOTS);
  fg_status status = fg__density_fill(density, context, FG__DENSITY_U, &nodes, 1, values);
  if (!status)
    status = fg__density_fill(density, context, FG__DENSITY_LABEL, &nodes, 1, labels);
  if (!status && density->block.masked)
    status = fg__density_fill(density, context, FG__DENSITY_ACTIVE, &cells, 1, flags);
  fg__phase_return(counters, before);
  return status;
}

/* An empty block that is the whole grid of a divided one, with its list of clusters. */
static fg_status create_whole(fg__density_block *out, fg_context *context,
                              const fg__density_block *of)
{
  static const int blocks[3] = {1, 1, 1};
  const fg__partition *p = &of->partition;
  fg__partition one;
  fg_status status = fg__partition_create(&one, context, &fg__single_rank, p->dimension,
                                          p->cells, p->periodic, blocks, 1);
  if (!status)
    status = fg__density_block_create(out, context, &one, of->masked);
  fg__partition_clear(&one);
  if (status)
    return status;
  size_t count = (size_t)of->count;
  out->count = of->count;
  out->debris = of->debris;
  out->area = fg__allocate(count, sizeof *out->area);
  if (!out->area)
    return fg__fail_memory(context, "a density", count * sizeof *out->area);
  if (count > 0)
    memcpy(out->area, of->area, count * sizeof *out->area);
  return FG_STATUS_OK;
}

fg_status fg_density_gather(fg_density **out, fg_context *context,
                            const fg_density *density)
{
  if (!out || !density || !fg_density_is_distributed(density))
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: %s",
                    out && density ? "all of it is here" : "a NULL argument");
  *out = NULL;
  const fg__ranks *ranks = density->block.partition.ranks;
  fg__density_block whole = {0};
  fg_status status = FG_STATUS_OK;
  if (ranks->rank == 0)
    status = create_whole(&whole, context, &density->block);
  status = fg__ranks_agree(ranks, context, status);
  if (!status)
    status = gather(density, context, &whole);
  if (!status && ranks->rank == 0)
    status = fg__density_create(out, context, &density->arrays, &whole);
  status = fg__ranks_agree(ranks, context, status);
  fg__density_block_clear(&whole);
  if (status) {
    fg_density_destroy(*out);
    *out = NULL;
  }
  return status;
}

const fg_density_arrays *fg_density_contents(const fg_density *density)
{
  return &density->arrays;
}

const int *fg_density_labels(const fg_density *density)
{
  return density->arrays.u ? density->block.label : NULL;
}
