#include <stdlib.h>

#include "base/memory.h"
#include "evolve/field_boxes.h"
#include "evolve/interpolation.h"
#include "evolve/spread.h"

/* Room for a slice as restriction gathers it: for the rank above, and of the one below.
 */
static bool take_gathered(fg__spread *spread)
{
  fg__level *box = &spread->box[0];
  size_t floats = FG__RESTRICTED * (size_t)fg__gathered_floats(box);
  spread->handed = fg__allocate_aligned(2 * floats, sizeof *spread->handed);
  if (!spread->handed)
    return false;
  spread->taken = spread->handed + floats;
  box->handed = spread->slabs.above == FG__NOBODY ? NULL : spread->handed;
  box->taken = spread->slabs.below == FG__NOBODY ? NULL : spread->taken;
  return true;
}

static fg_status take_arrays(fg__spread *spread, fg_context *context, bool finest)
{
  size_t count = (size_t)spread->count;
  size_t residuals = spread->in_slabs ? 1 : FG__RESTRICTED;
  size_t arrays = (finest ? 3 : 10) + residuals;
  float *memory = fg__allocate_aligned(arrays * spread->size, sizeof *memory);
  spread->pointer = fg__allocate(FG__MOST_EXCHANGED * count, sizeof *spread->pointer);
  spread->memory = memory;
  if (!memory || !spread->pointer)
    return fg__fail_memory(context, "a multigrid level",
                           arrays * spread->size * sizeof *memory);
  float **own[] = {&spread->u,         &spread->w,
                   &spread->p,         &spread->q,
                   &spread->coupling,  &spread->shape_curvature,
                   &spread->scale,     &spread->scale_inverse,
                   &spread->curvature, &spread->relaxation};
  for (size_t n = 0; n < arrays; ++n, memory += spread->size)
    if (n < residuals)
      spread->residual[n] = memory;
    else
      *own[n - residuals] = memory;
  fg__spread_use(spread, spread->u, spread->w, spread->p);
  if (spread->in_slabs && !take_gathered(spread))
    return fg__fail_memory(context, "a multigrid level",
                           (size_t)fg__slice_floats(&spread->box[0]) * sizeof *memory);
  for (int b = 0; b < spread->count && !finest; ++b) {
    fg__level *box = &spread->box[b];
    ptrdiff_t offset = spread->offset[b];
    box->q = spread->q + offset;
    box->coupling = spread->coupling + offset;
    box->shape_curvature = spread->shape_curvature + offset;
    box->scale = spread->scale + offset;
    box->scale_inverse = spread->scale_inverse + offset;
    box->curvature = spread->curvature + offset;
    box->relaxation = spread->relaxation + offset;
  }
  return FG_STATUS_OK;
}

static fg_status create_box(fg__spread *spread, fg_context *context, const fg__mesh *mesh,
                            const fg__spread_description *description, int b,
                            fg__cells_of_box *cells, fg__elements *elements)
{
  fg__level_description level = {.dimension = mesh->dimension,
                                 .gamma = description->gamma,
                                 .finest = !description->finer,
                                 .masked = spread->masked,
                                 .box = &fg__own_boxes(&spread->partition, &(int){0})[b]};
  for (int k = 0; k < 3; ++k) {
    level.cells[k] = spread->partition.cells[k];
    level.periodic[k] = mesh->periodic[k];
    level.spacing[k] =
        mesh->spacing[k] * (k < mesh->dimension ? 1 << description->halvings : 1);
  }
  return fg__level_create(&spread->box[b], context, &level, cells, elements);
}

/* A value of the cells below the boxes: each travels as its lowest corner does. node[b]:
 * an array of box b; shape: how the cells lie there, with the value as their weight. */
static void exchange_cells(const fg__spread *spread, const fg__cells_of_box *shape,
                           float *node[])
{
  for (int pass = 0; pass < 2; ++pass) {
    for (int b = 0; b < spread->count; ++b) {
      const fg__cells_of_box *c = &shape[b];
      fg__layout layout = fg__layout_of(c->dimension, c->nodes);
      int first = pass == 0 ? 0 : -1, solid = c->dimension == 3;
      for (int k = solid ? first : 0; k < c->nodes[2]; ++k)
        for (int j = first; j < c->nodes[1]; ++j)
          for (int i = first; i < c->nodes[0]; ++i) {
            ptrdiff_t at = fg__cell_at(c, i, j, k);
            ptrdiff_t corner = fg__node_at(&layout, i, j, k);
            if (pass == 0)
              node[b][corner] = c->weight[at];
            else if (i < 0 || j < 0 || k < 0)
              c->weight[at] = node[b][corner];
          }
    }
    float *const *const array = node;
    if (pass == 0)
      fg__exchange_fill(spread->exchange, 1, &array, FG__ALL_COLOURS);
  }
}

/* What the cells of boxes are: the tensor, or element matrices. */
typedef struct cells_of_boxes {
  fg__cells_of_box *tensor;
  fg__elements *element; /* NULL: there is no mask */
} cells_of_boxes;

static fg_status halve_box(const fg__spread *spread, fg_context *context,
                           const fg__spread_description *description,
                           const cells_of_boxes *cells, int b)
{
  const fg__partition *partition = &spread->partition;
  const fg__box *own = &fg__own_boxes(partition, &(int){0})[b];
  const fg__level *fine = &description->finer->box[b];
  if (!cells->element)
    return fg__cells_halve_box(&cells->tensor[b], context, &fine->tensor, own,
                               partition->cells);
  int count[3] = {1, 1, 1};
  for (int k = 0; k < partition->dimension; ++k) {
    int left = partition->cells[k] - own->first[k]; /* the last node begins no cell */
    count[k] = own->nodes[k] < left ? own->nodes[k] : left;
  }
  return fg__level_coarsen_cells(&cells->element[b], context, fine, description->gamma,
                                 own->nodes, count, NULL);
}

/* Value n of the cells of all boxes, as exchange_cells takes it. */
static void view_cells(const fg__spread *spread, const cells_of_boxes *cells, int n,
                       fg__cells_of_box *out)
{
  for (int b = 0; b < spread->count; ++b) {
    out[b] = cells->tensor[b];
    if (cells->element) {
      const fg__elements *e = &cells->element[b];
      out[b] = (fg__cells_of_box){.dimension = e->dimension,
                                  .nodes = {e->nodes[0], e->nodes[1], e->nodes[2]},
                                  .row = e->row,
                                  .plane = e->plane,
                                  .weight = e->value[n]};
    } else if (n > 0) {
      out[b].weight = out[b].component[n - 1];
    }
  }
}

/* Cells of a coarser level from those of the finer one, which the same ranks' boxes
 * share. Collective. */
static fg_status halve_cells(const fg__spread *spread, fg_context *context,
                             const fg__spread_description *description,
                             const cells_of_boxes *cells)
{
  const fg__partition *partition = &spread->partition;
  const fg__box *own = fg__own_boxes(partition, &(int){0});
  size_t count = (size_t)spread->count;
  float **memory = fg__allocate(count, sizeof *memory);
  float **node = fg__allocate(count, sizeof *node);
  fg__cells_of_box *shape = fg__allocate(count, sizeof *shape);
  fg_status status = FG_STATUS_OK;
  if (!memory || !node || !shape)
    status = fg__fail_memory(context, "the coarse tensor", count * sizeof *node);
  for (int b = 0; b < spread->count && !status; ++b) {
    fg__layout layout = fg__layout_of(partition->dimension, own[b].nodes);
    memory[b] = fg__allocate(layout.array_size, sizeof **memory);
    if (memory[b]) {
      node[b] = memory[b] + layout.first;
      status = halve_box(spread, context, description, cells, b);
    } else {
      status = fg__fail_memory(context, "the coarse tensor",
                               layout.array_size * sizeof **node);
    }
  }
  status = fg__ranks_agree(partition->ranks, context, status);
  int dimension = partition->dimension;
  int values = cells->element ? fg__element_values(dimension) : dimension == 3 ? 7 : 4;
  for (int n = 0; n < values && !status; ++n) {
    view_cells(spread, cells, n, shape);
    exchange_cells(spread, shape, node);
  }
  for (int b = 0; b < spread->count && !status; ++b)
    if (cells->element)
      fg__elements_mirror_box(&cells->element[b], &own[b], partition->cells,
                              partition->periodic);
    else
      fg__cells_mirror_box(&cells->tensor[b], &own[b], partition->cells,
                           partition->periodic);
  for (int b = 0; b < spread->count && memory; ++b)
    free(memory[b]);
  free(memory);
  free(node);
  free(shape);
  return status;
}

/* The cells of the finest level. Collective. */
static fg_status ask_for_cells(const fg__spread *spread, fg_context *context,
                               const fg__tensor_recipe *recipe, fg__cells_of_box *cells)
{
  const fg__partition *partition = &spread->partition;
  const fg__box *own = fg__own_boxes(partition, &(int){0});
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg__most_boxes(partition) && !status; ++n) {
    fg__wide_tensor wide;
    status = fg__wide_of_box(&wide, context, recipe, partition, n);
    if (status)
      return status;
    if (n < spread->count)
      status = fg__cells_for_box(&cells[n], context, recipe, &own[n], &wide);
    status = fg__ranks_agree(partition->ranks, context, status);
  }
  return status;
}

static fg_status create_boxes(fg__spread *spread, fg_context *context,
                              const fg__mesh *mesh, const fg__tensor_recipe *recipe,
                              const fg__spread_description *description)
{
  size_t count = (size_t)spread->count;
  bool elements = spread->masked && description->finer;
  cells_of_boxes cells = {.tensor = fg__allocate(count, sizeof *cells.tensor)};
  if (elements)
    cells.element = fg__allocate(count, sizeof *cells.element);
  fg_status status = FG_STATUS_OK;
  if (!cells.tensor || (elements && !cells.element))
    status = fg__fail_memory(context, "the tensor", count * sizeof *cells.element);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status && description->finer)
    status = halve_cells(spread, context, description, &cells);
  if (!status && !description->finer)
    status = ask_for_cells(spread, context, recipe, cells.tensor);
  for (int b = 0; b < spread->count && !status; ++b) {
    status = create_box(spread, context, mesh, description, b, &cells.tensor[b],
                        elements ? &cells.element[b] : NULL);
    spread->offset[b] = (ptrdiff_t)spread->size + spread->box[b].layout.first;
    spread->size += spread->box[b].layout.array_size + FG__LANES;
  }
  /* unless a level has taken them over */
  for (int b = 0; b < spread->count && cells.tensor; ++b)
    fg__cells_clear(&cells.tensor[b]);
  for (int b = 0; b < spread->count && cells.element; ++b)
    fg__elements_clear(&cells.element[b]);
  free(cells.tensor);
  free(cells.element);
  return status;
}

/* Relative masses beyond a box come from their owners. */
static void exchange_masses(const fg__spread *spread)
{
  float *const *arrays[2];
  for (int b = 0; b < spread->count; ++b) {
    spread->pointer[b] = spread->box[b].mass;
    spread->pointer[spread->count + b] = spread->box[b].mass_inverse;
  }
  arrays[0] = spread->pointer;
  arrays[1] = spread->pointer + spread->count;
  fg__exchange_fill(spread->exchange, 2, arrays, FG__ALL_COLOURS);
}

/* So does what the nodes there follow, between the stages in which it is found. */
static void find_interpolation(const fg__spread *spread)
{
  int dimension = spread->partition.dimension;
  for (int stage = 0; stage <= dimension; ++stage) {
    for (int b = 0; b < spread->count; ++b)
      fg__interpolation_find(&spread->box[b], stage);
    for (int side = 0; side < 1 << dimension; ++side) {
      for (int b = 0; b < spread->count; ++b)
        spread->pointer[b] = spread->box[b].interpolation[side];
      float *const *array = spread->pointer;
      fg__exchange_fill(spread->exchange, 1, &array, FG__ALL_COLOURS);
    }
    for (int b = 0; b < spread->count; ++b)
      fg__interpolation_mirror(&spread->box[b]);
  }
}

fg_status fg__spread_create(fg__spread *out, fg_context *context, const fg__mesh *mesh,
                            const fg__tensor_recipe *recipe, fg__partition *partition,
                            const fg__spread_description *description)
{
  *out = (fg__spread){.partition = *partition, .masked = recipe->masked};
  *partition = (fg__partition){0};
  fg__own_boxes(&out->partition, &out->count);
  out->in_slabs = fg__slabs_find(&out->slabs, &out->partition);
  size_t count = (size_t)out->count;
  out->box = fg__allocate(count, sizeof *out->box);
  out->offset = fg__allocate(count, sizeof *out->offset);
  fg_status status = FG_STATUS_OK;
  if (!out->box || !out->offset)
    status = fg__fail_memory(context, "a multigrid level", count * sizeof *out->box);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status)
    status =
        fg__exchange_create(&out->exchange, context, &out->partition, FG__MOST_EXCHANGED);
  if (!status)
    status = create_boxes(out, context, mesh, recipe, description);
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
  for (int b = 0; b < spread->count && spread->box; ++b)
    fg__level_clear(&spread->box[b]);
  fg__exchange_destroy(spread->exchange);
  fg__partition_clear(&spread->partition);
  free(spread->box);
  free(spread->offset);
  free(spread->pointer);
  free(spread->memory);
  free(spread->handed);
  *spread = (fg__spread){0};
}
