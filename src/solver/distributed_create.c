#include <stdlib.h>

#include "base/memory.h"
#include "solver/distributed.h"
#include "solver/interpolation.h"

/* Room for a slice as restriction gathers it: for the rank above, and of the one below.
 */
static bool take_gathered(fg__distributed *level)
{
  fg__level *block = &level->block;
  size_t floats = FG__RESTRICTED * (size_t)fg__gathered_floats(block);
  level->sent = fg__allocate_aligned(2 * floats, sizeof *level->sent);
  if (!level->sent)
    return false;
  level->received = level->sent + floats;
  block->sent = level->slabs.above == FG__NOBODY ? NULL : level->sent;
  block->received = level->slabs.below == FG__NOBODY ? NULL : level->received;
  return true;
}

/* What a level needs beside its own arrays to be divided. */
static fg_status take_arrays(fg__distributed *level, fg_context *context)
{
  const fg__level *block = &level->block;
  size_t residuals = level->in_slabs ? 1 : FG__RESTRICTED;
  size_t apart = block->layout.array_size + FG__LANES;
  float *memory = fg__allocate_aligned(residuals * apart, sizeof *memory);
  level->memory = memory;
  for (size_t n = 0; n < residuals && memory; ++n)
    level->residual[n] = memory + block->layout.first + n * apart;
  if (memory && (!level->in_slabs || take_gathered(level)))
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a multigrid level",
                         residuals * apart * sizeof *memory);
}

/* What the cells of a block are: the tensor, or element matrices. */
typedef struct block_cells {
  fg__cells_of_box tensor;
  fg__elements elements;
  bool by_elements; /* with a mask, on coarse levels */
} block_cells;

static fg_status create_level(fg__distributed *level, fg_context *context,
                              const fg__mesh *mesh,
                              const fg__distributed_description *description,
                              block_cells *cells)
{
  fg__level_description of = {.dimension = mesh->dimension,
                              .gamma = description->gamma,
                              .finest = !description->finer,
                              .masked = level->masked,
                              .box = fg__own_block(&level->partition)};
  for (int k = 0; k < 3; ++k) {
    of.cells[k] = level->partition.cells[k];
    of.periodic[k] = mesh->periodic[k];
    of.spacing[k] =
        mesh->spacing[k] * (k < mesh->dimension ? 1 << description->halvings : 1);
  }
  return fg__level_create(&level->block, context, &of, &cells->tensor,
                          cells->by_elements ? &cells->elements : NULL);
}

/* A value of the cells below the block: each travels as its lowest corner does. node: an
 * array of the block; c: how the cells lie there, with the value as their weight. */
static void exchange_cells(const fg__distributed *level, const fg__cells_of_box *c,
                           float *node)
{
  fg__layout layout = fg__layout_of(c->dimension, c->nodes);
  for (int pass = 0; pass < 2; ++pass) {
    int first = pass == 0 ? 0 : -1, solid = c->dimension == 3;
    for (int k = solid ? first : 0; k < c->nodes[2]; ++k)
      for (int j = first; j < c->nodes[1]; ++j)
        for (int i = first; i < c->nodes[0]; ++i) {
          ptrdiff_t at = fg__cell_at(c, i, j, k);
          ptrdiff_t corner = fg__node_at(&layout, i, j, k);
          if (pass == 0)
            node[corner] = c->weight[at];
          else if (i < 0 || j < 0 || k < 0)
            c->weight[at] = node[corner];
        }
    if (pass == 0)
      fg__exchange_fill(level->exchange, 1, &node, FG__ALL_COLOURS);
  }
}

static fg_status coarsen_block(const fg__distributed *level, fg_context *context,
                               const fg__distributed_description *description,
                               block_cells *cells)
{
  const fg__partition *partition = &level->partition;
  const fg__box *own = fg__own_block(partition);
  const fg__level *fine = &description->finer->block;
  if (!cells->by_elements)
    return fg__cells_coarsen(&cells->tensor, context, &fine->tensor, own,
                             partition->cells, NULL);
  const fg__box below = fg__block_cells(partition, own);
  return fg__level_coarsen_cells(&cells->elements, context, fine, description->gamma,
                                 own->nodes, below.nodes, NULL);
}

/* Value n of the block's cells, as exchange_cells takes it. */
static fg__cells_of_box view_cells(const block_cells *cells, int n)
{
  fg__cells_of_box out = cells->tensor;
  if (cells->by_elements) {
    const fg__elements *e = &cells->elements;
    out = (fg__cells_of_box){.dimension = e->dimension,
                             .nodes = {e->nodes[0], e->nodes[1], e->nodes[2]},
                             .row = e->row,
                             .plane = e->plane,
                             .weight = e->value[n]};
  } else if (n > 0) {
    out.weight = out.component[n - 1];
  }
  return out;
}

/* Cells of a coarser level from those of the finer one, which the same ranks share.
 * Collective. */
static fg_status coarsen_cells(const fg__distributed *level, fg_context *context,
                               const fg__distributed_description *description,
                               block_cells *cells)
{
  const fg__partition *partition = &level->partition;
  const fg__box *own = fg__own_block(partition);
  int dimension = partition->dimension;
  fg__layout layout = fg__layout_of(dimension, own->nodes);
  float *node = fg__allocate(layout.array_size, sizeof *node);
  fg_status status = node ? coarsen_block(level, context, description, cells)
                          : fg__fail_memory(context, "the coarse tensor",
                                            layout.array_size * sizeof *node);
  status = fg__ranks_agree(partition->ranks, context, status);
  int values = cells->by_elements ? fg__element_values(dimension)
               : dimension == 3   ? 7
                                  : 4;
  for (int n = 0; n < values && !status; ++n) {
    fg__cells_of_box value = view_cells(cells, n);
    exchange_cells(level, &value, node + layout.first);
  }
  if (!status && cells->by_elements)
    fg__elements_fill_images(&cells->elements, own, partition->cells,
                             partition->periodic);
  else if (!status)
    fg__cells_fill_images(&cells->tensor, own, partition->cells, partition->periodic);
  free(node);
  return status;
}

static fg_status create_block(fg__distributed *level, fg_context *context,
                              const fg__mesh *mesh, fg__cells_of_box *finest,
                              const fg__distributed_description *description)
{
  block_cells cells = {.by_elements = level->masked && description->finer};
  fg_status status = FG_STATUS_OK;
  if (description->finer) {
    status = coarsen_cells(level, context, description, &cells);
  } else {
    cells.tensor = *finest;
    *finest = (fg__cells_of_box){0};
  }
  if (!status)
    status = create_level(level, context, mesh, description, &cells);
  /* unless the level has taken them over */
  fg__cells_clear(&cells.tensor);
  fg__elements_clear(&cells.elements);
  return status;
}

/* Relative masses beyond the block come from their owners. */
static void exchange_masses(const fg__distributed *level)
{
  float *const both[] = {level->block.mass, level->block.mass_inverse};
  fg__exchange_fill(level->exchange, 2, both, FG__ALL_COLOURS);
}

/* So does what the nodes there follow, between the stages in which it is found. */
static void find_interpolation(fg__distributed *level)
{
  int dimension = level->partition.dimension;
  for (int stage = 0; stage <= dimension; ++stage) {
    fg__interpolation_find(&level->block, stage);
    for (int side = 0; side < 1 << dimension; ++side)
      fg__exchange_fill(level->exchange, 1, &level->block.interpolation[side],
                        FG__ALL_COLOURS);
    fg__interpolation_mirror(&level->block);
  }
}

fg_status fg__distributed_create(fg__distributed *out, fg_context *context,
                                 const fg__mesh *mesh, fg__cells_of_box *finest,
                                 fg__partition *partition,
                                 const fg__distributed_description *description)
{
  *out = (fg__distributed){.partition = *partition, .masked = description->masked};
  *partition = (fg__partition){0};
  out->in_slabs = fg__slabs_find(&out->slabs, &out->partition);
  fg_status status =
      fg__exchange_create(&out->exchange, context, &out->partition, FG__MOST_EXCHANGED);
  if (!status)
    status = create_block(out, context, mesh, finest, description);
  if (!status)
    status = take_arrays(out, context);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status && out->masked) {
    exchange_masses(out);
    find_interpolation(out);
  }
  return status;
}

void fg__distributed_clear(fg__distributed *level)
{
  fg__level_clear(&level->block);
  fg__exchange_destroy(level->exchange);
  fg__partition_clear(&level->partition);
  free(level->memory);
  free(level->sent);
  *level = (fg__distributed){0};
}
