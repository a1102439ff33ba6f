#include "mesh/merge.h"

#include <stdlib.h>

#include "base/memory.h"

/* The nodes that a patch owns. */
static fg__box nodes_of(const fg__mesh *mesh, const fg__leaf *leaf)
{
  fg__box box = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < mesh->dimension; ++k) {
    box.first[k] = leaf->first[k] * mesh->patch_cells;
    box.nodes[k] = mesh->patch_cells;
    box.nodes[k] += !mesh->periodic[k] && box.first[k] + box.nodes[k] == mesh->cells[k];
  }
  return box;
}

static fg_status set_tiles(fg__mesh *mesh, fg_context *context)
{
  const fg__box *own = fg__own_boxes(&mesh->partition, &mesh->tile_count);
  mesh->tile = fg__allocate((size_t)mesh->tile_count, sizeof *mesh->tile);
  if (!mesh->tile)
    return fg__fail_memory(context, "the tiles",
                           (size_t)mesh->tile_count * sizeof *mesh->tile);
  for (int n = 0; n < mesh->tile_count; ++n) {
    fg__box cells = fg__box_cells(&mesh->partition, &own[n]);
    for (int k = 0; k < 3; ++k) {
      mesh->tile[n].first[k] = cells.first[k];
      mesh->tile[n].cells[k] = cells.nodes[k];
    }
  }
  return FG_STATUS_OK;
}

static fg_status take_boxes(fg__mesh *mesh, fg_context *context, const fg__box box[],
                            int count)
{
  fg_status status =
      fg__partition_create(&mesh->partition, context, mesh->ranks, mesh->dimension,
                           mesh->cells, mesh->periodic, box, count);
  if (status)
    return status;
  return fg__ranks_agree(mesh->ranks, context, set_tiles(mesh, context));
}

fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context,
                                const fg__leaf leaf[], int count)
{
  fg_status status = FG_STATUS_OK;
  fg__box *box = fg__allocate((size_t)count, sizeof *box);
  if (!box)
    status = fg__fail_memory(context, "the boxes", (size_t)count * sizeof *box);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status) {
    for (int n = 0; n < count; ++n)
      box[n] = nodes_of(mesh, &leaf[n]);
    status = take_boxes(mesh, context, box, fg__boxes_merge(box, count));
  }
  free(box);
  return status;
}

/* In the time that a node of the finest level takes on one box, a cycle: the same on
 * boxes that are no slabs, and a node of the first whole level
 * (docs/design/distribution.md). */
static const double box_cost = 1.7, whole_cost_2d = 0.8, whole_cost_3d = 1.7;

enum { LEAST_UNIT = 8 /* three halvings */ };

static bool can_be_halved_again(const fg__mesh *mesh, int unit, int thickness,
                                int halvings)
{
  for (int k = 0; k < mesh->dimension; ++k) {
    int cells = mesh->cells[k] >> halvings;
    if (cells % 2 != 0 || cells < FG__LEAST_BOX_NODES)
      return false;
  }
  return (unit >> halvings) % 2 == 0 && thickness >> halvings >= FG__LEAST_BOX_NODES;
}

/* Nodes of the first level that is not shared. */
static double whole_nodes(const fg__mesh *mesh, int unit, int thickness)
{
  int halvings = 0;
  while (can_be_halved_again(mesh, unit, thickness, halvings))
    ++halvings;
  double nodes = 1.0;
  for (int k = 0; k < mesh->dimension; ++k)
    nodes *= (mesh->cells[k] >> halvings) + 1;
  return nodes;
}

/* Of the rank with most to do, in nodes of one box. */
static double slab_cost(const fg__mesh *mesh, int unit)
{
  int axis = mesh->dimension - 1, ranks = mesh->ranks->count;
  int units = mesh->cells[axis] / unit;
  double slice = 1.0;
  for (int k = 0; k < axis; ++k)
    slice *= mesh->cells[k];
  double whole = whole_nodes(mesh, unit, units / ranks * unit);
  return slice * unit * ((units + ranks - 1) / ranks) +
         (mesh->dimension == 3 ? whole_cost_3d : whole_cost_2d) * whole;
}

int fg__mesh_slab_unit(const fg__mesh *mesh)
{
  int axis = mesh->dimension - 1, ranks = mesh->ranks->count, best = 0;
  double least = box_cost / ranks;
  for (int k = 0; k < mesh->dimension; ++k)
    least *= mesh->cells[k];
  for (int unit = LEAST_UNIT; ranks > 1 && mesh->cells[axis] % unit == 0; unit *= 2) {
    if (mesh->cells[axis] / unit < ranks)
      break;
    double cost = slab_cost(mesh, unit);
    if (cost < least) {
      least = cost;
      best = unit;
    }
  }
  return best;
}

fg_status fg__mesh_cut_slabs(fg__mesh *mesh, fg_context *context, int unit)
{
  int axis = mesh->dimension - 1, ranks = mesh->ranks->count, rank = mesh->ranks->rank;
  int units = mesh->cells[axis] / unit;
  fg__box box = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < mesh->dimension; ++k)
    box.nodes[k] = mesh->cells[k] + !mesh->periodic[k];
  int end = units * (rank + 1) / ranks * unit;
  box.first[axis] = units * rank / ranks * unit;
  if (rank + 1 < ranks)
    box.nodes[axis] = end;
  box.nodes[axis] -= box.first[axis];
  mesh->patch_cells = unit;
  return take_boxes(mesh, context, &box, 1);
}
