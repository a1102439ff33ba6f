#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "evolution/tensor.h"
#include "solver/cells/field_boxes.h"

static fg__tensor_recipe recipe_of(const fg_evolution *e, const fg_field *field)
{
  fg__tensor_recipe r = {.field = field,
                         .law = e->options.law,
                         .anisotropy = e->options.anisotropy,
                         .dimension = e->mesh.dimension,
                         .cells = {1, 1, 1}};
  /* An interface across the stream is sqrt(gamma) wide on the first mesh. A coarser mesh
   * keeps that width: its A is then that of the finer mesh, and the energy too. */
  if (e->options.law->axes)
    r.width =
        sqrt(fg__evolution_interface_energy(e)) * e->mesh.length / fg__evolution_unit(e);
  for (int k = 0; k < r.dimension; ++k) {
    r.cells[k] = e->mesh.cells[k];
    r.periodic[k] = e->mesh.periodic[k];
    r.origin[k] = e->mesh.origin[k];
    r.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
  }
  return r;
}

fg_status fg__evolution_cells_create(fg_evolution *e, const fg_field *field)
{
  const fg__partition *partition = &e->mesh.partition;
  const fg__box *block = fg__own_block(partition);
  const fg__tensor_recipe recipe = recipe_of(e, field);
  fg__wide_tensor wide;
  fg_status status = fg__wide_of_block(&wide, e->context, &recipe, partition);
  if (status)
    return status;
  status =
      fg__cells_for_box(&e->finest_cells, e->context, &recipe, block, &wide, e->threads);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  if (status)
    return status;
  const fg__box own = fg__block_cells(partition, block);
  uint64_t active = 0;
  for (int k = 0; k < own.nodes[2]; ++k)
    for (int j = 0; j < own.nodes[1]; ++j)
      for (int i = 0; i < own.nodes[0]; ++i)
        active += e->finest_cells.weight[fg__cell_at(&e->finest_cells, i, j, k)] > 0.0F;
  fg__ranks_add(e->mesh.ranks, &active, 1);
  e->active_cells = (int64_t)active;
  if (active == 0)
    return fg__fail(e->context, FG_STATUS_ARGUMENT, "the field is missing everywhere");
  return FG_STATUS_OK;
}

fg_status fg__evolution_multigrid_create(fg__multigrid *out, fg_evolution *e,
                                         double gamma)
{
  return fg__multigrid_create(out, e->context, &e->mesh, &e->finest_cells,
                              e->active_cells < (int64_t)e->cells, gamma, e->threads);
}
