#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "evolution/tensor.h"
#include "solver/cells/field_boxes.h"

static fg_status allocate_tensor(fg_evolution *e)
{
  float **arrays[] = {&e->tensor.xx, &e->tensor.xy, &e->tensor.yy,
                      &e->tensor.zz, &e->tensor.xz, &e->tensor.yz};
  int count = e->mesh.dimension == 3 ? 6 : 3;
  bool whole = true;
  for (int n = 0; n < count; ++n) {
    *arrays[n] = fg__allocate(e->cells, sizeof **arrays[n]);
    whole = whole && *arrays[n];
  }
  e->tensor.active = fg__allocate(e->cells, 1);
  if (whole && e->tensor.active)
    return FG_STATUS_OK;
  return fg__fail_memory(e->context, "the tensor",
                         e->cells * ((size_t)count * sizeof(float) + 1));
}

void fg__evolution_tensor_free(fg_evolution *e)
{
  float **arrays[] = {&e->tensor.xx, &e->tensor.xy, &e->tensor.yy,
                      &e->tensor.zz, &e->tensor.xz, &e->tensor.yz};
  for (int n = 0; n < 6; ++n) {
    free(*arrays[n]);
    *arrays[n] = NULL;
  }
}

static fg__tensor_recipe recipe_of(const fg_evolution *e, const fg_field *field)
{
  fg__tensor_recipe r = {.field = field,
                         .law = e->options.law,
                         .anisotropy = e->options.anisotropy,
                         .dimension = e->mesh.dimension,
                         .cells = {1, 1, 1},
                         .masked = e->active_cells < (int64_t)e->cells};
  /* an interface across the stream is sqrt(gamma) wide */
  if (e->options.law->axes)
    r.width = sqrt(fg__evolution_interface_energy(e)) * e->mesh.length;
  for (int k = 0; k < r.dimension; ++k) {
    r.cells[k] = e->mesh.cells[k];
    r.periodic[k] = e->mesh.periodic[k];
    r.origin[k] = e->mesh.origin[k];
    r.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
  }
  return r;
}

/* The active cells whose lowest corners a block owns. */
static fg_status count_block(const fg_evolution *e, const fg__tensor_recipe *recipe,
                             const fg__box *block, fg__wide_tensor *wide,
                             uint64_t *active)
{
  fg__cells_of_box cells;
  fg_status status = fg__cells_for_box(&cells, e->context, recipe, block, wide);
  const fg__box own = fg__block_cells(&e->mesh.partition, block);
  for (int k = 0; k < own.nodes[2] && !status; ++k)
    for (int j = 0; j < own.nodes[1]; ++j)
      for (int i = 0; i < own.nodes[0]; ++i)
        *active += cells.weight[fg__cell_at(&cells, i, j, k)] > 0.0F;
  fg__cells_clear(&cells);
  return status;
}

static fg_status count_active_cells(fg_evolution *e, const fg_field *field)
{
  const fg__partition *partition = &e->mesh.partition;
  fg__tensor_recipe recipe = recipe_of(e, field);
  recipe.width = 0.0; /* directions do not matter */
  recipe.law = &fg__law_isotropic;
  recipe.anisotropy = 1.0;
  uint64_t active = 0;
  fg__wide_tensor wide;
  fg_status status = fg__wide_of_block(&wide, e->context, &recipe, partition);
  if (status)
    return status;
  status = count_block(e, &recipe, fg__own_block(partition), &wide, &active);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  if (status)
    return status;
  fg__ranks_add(e->mesh.ranks, &active, 1);
  e->active_cells = (int64_t)active;
  if (active == 0)
    return fg__fail(e->context, FG_STATUS_ARGUMENT, "the field is missing everywhere");
  return FG_STATUS_OK;
}

fg_status fg__evolution_tensor_create(fg_evolution *e, const fg_field *field)
{
  if (e->spread)
    return count_active_cells(e, field);
  fg_status status = allocate_tensor(e);
  if (status)
    return status;
  fg__cells cells = {.dimension = e->mesh.dimension};
  for (int k = 0; k < e->mesh.dimension; ++k) {
    cells.count[k] = e->mesh.cells[k];
    cells.origin[k] = e->mesh.origin[k];
    cells.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
  }
  status = fg__tensor_fill(&e->tensor, e->context, field, e->options.law,
                           e->options.anisotropy, &cells, e->team);
  for (size_t n = 0; n < e->cells && !status; ++n)
    e->active_cells += e->tensor.active[n];
  double width = recipe_of(e, field).width;
  if (status || !(width > 0.0))
    return status;
  return fg__tensor_smooth(&e->tensor, e->context, e->options.anisotropy, &cells,
                           e->mesh.periodic, width, e->team);
}

fg_status fg__evolution_multigrid_create(fg__multigrid *out, fg_evolution *e,
                                         const fg_field *field, double gamma)
{
  if (e->spread) {
    fg__tensor_recipe recipe = recipe_of(e, field);
    return fg__multigrid_create_spread(out, e->context, &e->mesh, &recipe, gamma);
  }
  fg_status status =
      fg__multigrid_create(out, e->context, &e->mesh, &e->tensor, gamma, e->team);
  fg__evolution_tensor_free(e);
  return status;
}
