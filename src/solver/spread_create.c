#include <stdlib.h>

#include "base/memory.h"
#include "solver/cells/field_boxes.h"
#include "solver/interpolation.h"
#include "solver/spread.h"

/* Room for a slice as restriction gathers it: for the rank above, and of the one below.
 */
static bool take_gathered(fg__spread *spread)
{
  fg__level *block = &spread->block;
  size_t floats = FG__RESTRICTED * (size_t)fg__gathered_floats(block);
  spread->handed = fg__allocate_aligned(2 * floats, sizeof *spread->handed);
  if (!spread->handed)
    return false;
  spread->taken = spread->handed + floats;
  block->handed = spread->slabs.above == FG__NOBODY ? NULL : spread->handed;
  block->taken = spread->slabs.below == FG__NOBODY ? NULL : spread->taken;
  return true;
}

static fg_status take_arrays(fg__spread *spread, fg_context *context, bool finest)
{
  fg__level *block = &spread->block;
  size_t residuals = spread->in_slabs ? 1 : FG__RESTRICTED;
  size_t arrays = (finest ? 3 : 10) + residuals;
  size_t apart = block->layout.array_size + FG__LANES;
  float *memory = fg__allocate_aligned(arrays * apart, sizeof *memory);
  spread->memory = memory;
  if (!memory)
    return fg__fail_memory(context, "a multigrid level", arrays * apart * sizeof *memory);
  float **own[] = {&block->u,         &block->w,
                   &block->p,         &block->q,
                   &block->coupling,  &block->shape_curvature,
                   &block->scale,     &block->scale_inverse,
                   &block->curvature, &block->relaxation};
  memory += block->layout.first;
  for (size_t n = 0; n < arrays; ++n, memory += apart)
    if (n < residuals)
      spread->residual[n] = memory;
    else
      *own[n - residuals] = memory;
  if (spread->in_slabs && !take_gathered(spread))
    return fg__fail_memory(context, "a multigrid level",
                           (size_t)fg__slice_floats(block) * sizeof *memory);
  return FG_STATUS_OK;
}

/* What the cells of a block are: the tensor, or element matrices. */
typedef struct block_cells {
  fg__cells_of_box tensor;
  fg__elements elements;
  bool by_elements; /* with a mask, on coarse levels */
} block_cells;

static fg_status create_level(fg__spread *spread, fg_context *context,
                              const fg__mesh *mesh,
                              const fg__spread_description *description,
                              block_cells *cells)
{
  fg__level_description level = {.dimension = mesh->dimension,
                                 .gamma = description->gamma,
                                 .finest = !description->finer,
                                 .masked = spread->masked,
                                 .box = fg__own_block(&spread->partition)};
  for (int k = 0; k < 3; ++k) {
    level.cells[k] = spread->partition.cells[k];
    level.periodic[k] = mesh->periodic[k];
    level.spacing[k] =
        mesh->spacing[k] * (k < mesh->dimension ? 1 << description->halvings : 1);
  }
  return fg__level_create(&spread->block, context, &level, &cells->tensor,
                          cells->by_elements ? &cells->elements : NULL);
}

/* A value of the cells below the block: each travels as its lowest corner does. node: an
 * array of the block; c: how the cells lie there, with the value as their weight. */
static void exchange_cells(const fg__spread *spread, const fg__cells_of_box *c,
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
      fg__exchange_fill(spread->exchange, 1, &node, FG__ALL_COLOURS);
  }
}

static fg_status halve_block(const fg__spread *spread, fg_context *context,
                             const fg__spread_description *description,
                             block_cells *cells)
{
  const fg__partition *partition = &spread->partition;
  const fg__box *own = fg__own_block(partition);
  const fg__level *fine = &description->finer->block;
  if (!cells->by_elements)
    return fg__cells_halve_box(&cells->tensor, context, &fine->tensor, own,
                               partition->cells);
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
static fg_status halve_cells(const fg__spread *spread, fg_context *context,
                             const fg__spread_description *description,
                             block_cells *cells)
{
  const fg__partition *partition = &spread->partition;
  const fg__box *own = fg__own_block(partition);
  int dimension = partition->dimension;
  fg__layout layout = fg__layout_of(dimension, own->nodes);
  float *node = fg__allocate(layout.array_size, sizeof *node);
  fg_status status = node ? halve_block(spread, context, description, cells)
                          : fg__fail_memory(context, "the coarse tensor",
                                            layout.array_size * sizeof *node);
  status = fg__ranks_agree(partition->ranks, context, status);
  int values = cells->by_elements ? fg__element_values(dimension)
               : dimension == 3   ? 7
                                  : 4;
  for (int n = 0; n < values && !status; ++n) {
    fg__cells_of_box value = view_cells(cells, n);
    exchange_cells(spread, &value, node + layout.first);
  }
  if (!status && cells->by_elements)
    fg__elements_mirror_box(&cells->elements, own, partition->cells, partition->periodic);
  else if (!status)
    fg__cells_mirror_box(&cells->tensor, own, partition->cells, partition->periodic);
  free(node);
  return status;
}

/* The cells of the finest level. Collective. */
static fg_status ask_for_cells(const fg__spread *spread, fg_context *context,
                               const fg__tensor_recipe *recipe, fg__cells_of_box *cells)
{
  const fg__partition *partition = &spread->partition;
  fg__wide_tensor wide;
  fg_status status = fg__wide_of_block(&wide, context, recipe, partition);
  if (status)
    return status;
  status = fg__cells_for_box(cells, context, recipe, fg__own_block(partition), &wide);
  return fg__ranks_agree(partition->ranks, context, status);
}

static fg_status create_block(fg__spread *spread, fg_context *context,
                              const fg__mesh *mesh, const fg__tensor_recipe *recipe,
                              const fg__spread_description *description)
{
  block_cells cells = {.by_elements = spread->masked && description->finer};
  fg_status status = description->finer
                         ? halve_cells(spread, context, description, &cells)
                         : ask_for_cells(spread, context, recipe, &cells.tensor);
  if (!status)
    status = create_level(spread, context, mesh, description, &cells);
  /* unless the level has taken them over */
  fg__cells_clear(&cells.tensor);
  fg__elements_clear(&cells.elements);
  return status;
}

/* Relative masses beyond the block come from their owners. */
static void exchange_masses(const fg__spread *spread)
{
  float *const both[] = {spread->block.mass, spread->block.mass_inverse};
  fg__exchange_fill(spread->exchange, 2, both, FG__ALL_COLOURS);
}

/* So does what the nodes there follow, between the stages in which it is found. */
static void find_interpolation(fg__spread *spread)
{
  int dimension = spread->partition.dimension;
  for (int stage = 0; stage <= dimension; ++stage) {
    fg__interpolation_find(&spread->block, stage);
    for (int side = 0; side < 1 << dimension; ++side)
      fg__exchange_fill(spread->exchange, 1, &spread->block.interpolation[side],
                        FG__ALL_COLOURS);
    fg__interpolation_mirror(&spread->block);
  }
}

fg_status fg__spread_create(fg__spread *out, fg_context *context, const fg__mesh *mesh,
                            const fg__tensor_recipe *recipe, fg__partition *partition,
                            const fg__spread_description *description)
{
  *out = (fg__spread){.partition = *partition, .masked = recipe->masked};
  *partition = (fg__partition){0};
  out->in_slabs = fg__slabs_find(&out->slabs, &out->partition);
  fg_status status =
      fg__exchange_create(&out->exchange, context, &out->partition, FG__MOST_EXCHANGED);
  if (!status)
    status = create_block(out, context, mesh, recipe, description);
  if (!status)
    status = take_arrays(out, context, !description->finer);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status && recipe->masked) {
    exchange_masses(out);
    find_interpolation(out);
  }
  return status;
}

void fg__spread_clear(fg__spread *spread)
{
  fg__level_clear(&spread->block);
  fg__exchange_destroy(spread->exchange);
  fg__partition_clear(&spread->partition);
  free(spread->memory);
  free(spread->handed);
  *spread = (fg__spread){0};
}
