#include "mesh/mesh.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* Cells longer than twice their width resolve an interface in one direction only: a thin
 * domain gets more nodes along it than asked for. */
static const double most_cell_ratio = 2.0;

/* 4097 nodes a side need 1.7 GB in 2D; a typing error should not ask for more. */
enum { LEAST_NODES = 9, MOST_NODES_2D = 16385, MOST_NODES_3D = 2049 };

enum { COARSENING = 16, SHORT_SIDE_COARSENING = 8 };

static int round_up(int value, int multiple)
{
  return (value + multiple - 1) / multiple * multiple;
}

static int greatest_power_of_two_in(int dimension, const int counts[])
{
  for (int power = 1;; power *= 2)
    for (int k = 0; k < dimension; ++k)
      if (counts[k] % (2 * power) != 0)
        return power;
}

static int step_of_cells(const fg__mesh_description *description, int axis)
{
  return description->periodic[axis] ? COARSENING : SHORT_SIDE_COARSENING;
}

static fg_status check_description(fg_context *context,
                                   const fg__mesh_description *description)
{
  int most = description->dimension == 3 ? MOST_NODES_3D : MOST_NODES_2D;
  if (description->nodes < LEAST_NODES || description->nodes > most)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%d nodes a side; from %d to %d are possible", description->nodes,
                    LEAST_NODES, most);
  for (int k = 0; k < description->dimension; ++k)
    if (!(description->side[k] > 0.0) || !isfinite(description->side[k]))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "the domain's side along axis %d is %g", k, description->side[k]);
  return FG_STATUS_OK;
}

static fg_status choose_cells(fg__mesh *mesh, fg_context *context,
                              const fg__mesh_description *description)
{
  int longest = 0, wanted = description->nodes - 1;
  for (int k = 1; k < mesh->dimension; ++k)
    if (description->side[k] > description->side[longest])
      longest = k;
  mesh->length = description->side[longest];
  int most = mesh->dimension == 3 ? MOST_NODES_3D : MOST_NODES_2D;
  for (int k = 0; k < mesh->dimension; ++k) {
    if (k == longest)
      continue;
    double ratio = description->side[k] / mesh->length;
    double least_cells = step_of_cells(description, k) / ratio / most_cell_ratio;
    if (least_cells > most - 1)
      return fg__fail(
          context, FG_STATUS_ARGUMENT,
          "the domain is %g times as long as wide: it would take %.0f nodes along it, "
          "at most %d are possible",
          1.0 / ratio, least_cells + 1.0, most);
    if (least_cells > wanted)
      wanted = (int)ceil(least_cells);
  }
  mesh->cells[longest] = round_up(wanted, COARSENING);
  for (int k = 0; k < mesh->dimension; ++k) {
    if (k != longest) {
      int step = step_of_cells(description, k);
      double ratio = description->side[k] / mesh->length;
      int parts = (int)lround(ratio * mesh->cells[longest] / step);
      mesh->cells[k] = step * (parts > 0 ? parts : 1);
    }
    mesh->periodic[k] = description->periodic[k];
    mesh->origin[k] = description->origin[k];
    mesh->spacing[k] = description->side[k] / mesh->length / mesh->cells[k];
  }
  return FG_STATUS_OK;
}

static fg_status grow_forest(fg__mesh *mesh, fg_context *context)
{
  fg_status status = fg__ranks_all(&mesh->ranks, context);
  if (status)
    return status;
  if (mesh->ranks->count != 1)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "started on %d ranks; this version runs on one", mesh->ranks->count);
  mesh->patch_cells = greatest_power_of_two_in(mesh->dimension, mesh->cells);
  int trees[3] = {1, 1, 1};
  for (int k = 0; k < mesh->dimension; ++k)
    trees[k] = mesh->cells[k] / mesh->patch_cells;
  return mesh->kind->create(&mesh->forest, context, mesh->ranks, trees, mesh->periodic, 0,
                            0);
}

/* The leaves of a uniform forest on one rank fill the box: one tile. The cell range comes
 * from the leaves themselves, so that a hole would show. */
static fg_status merge_leaves(fg__mesh *mesh, fg_context *context)
{
  int count = mesh->kind->leaf_count(mesh->forest), dimension = mesh->dimension;
  fg__leaf *leaf = fg__allocate((size_t)count, sizeof *leaf);
  mesh->tile = fg__allocate(1, sizeof *mesh->tile);
  if (!leaf || !mesh->tile) {
    free(leaf);
    return fg__fail_memory(context, "the tiles", (size_t)count * sizeof *leaf);
  }
  mesh->kind->leaves(mesh->forest, leaf);
  int low[3] = {leaf[0].first[0], leaf[0].first[1], leaf[0].first[2]};
  int high[3] = {low[0] + 1, low[1] + 1, low[2] + 1};
  double covered = 0.0;
  for (int n = 0; n < count; ++n) {
    for (int k = 0; k < dimension; ++k) {
      int first = leaf[n].first[k], end = first + leaf[n].side;
      low[k] = first < low[k] ? first : low[k];
      high[k] = end > high[k] ? end : high[k];
    }
    covered += pow(leaf[n].side, dimension);
  }
  free(leaf);
  double wanted = 1.0;
  for (int k = 0; k < 3; ++k) {
    int scale = k < dimension ? mesh->patch_cells : 1;
    mesh->tile[0].first[k] = low[k] * scale;
    mesh->tile[0].cells[k] = (high[k] - low[k]) * scale;
    wanted *= high[k] - low[k];
  }
  mesh->tile_count = 1;
  if (covered != wanted)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "the leaves do not fill a brick");
  return FG_STATUS_OK;
}

fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description)
{
  int dimension = description->dimension;
  *out =
      (fg__mesh){.dimension = dimension, .cells = {1, 1, 1}, .spacing = {1.0, 1.0, 1.0}};
  if (dimension != 2 && dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "a mesh of %d dimensions", dimension);
  out->kind = dimension == 3 ? &fg__forest_3d : &fg__forest_2d;
  fg_status status = check_description(context, description);
  if (!status)
    status = choose_cells(out, context, description);
  if (!status)
    status = grow_forest(out, context);
  if (!status)
    status = merge_leaves(out, context);
  if (status)
    fg__mesh_clear(out);
  return status;
}

void fg__mesh_clear(fg__mesh *mesh)
{
  if (mesh->kind)
    mesh->kind->destroy(mesh->forest);
  free(mesh->tile);
  *mesh = (fg__mesh){0};
}
