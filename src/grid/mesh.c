#include "grid/mesh.h"

#include "grid/blocks.h"
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

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
  double coarsest = description->coarsest > 0 ? description->coarsest : INT_MAX;
  for (int k = 1; k < mesh->dimension; ++k)
    if (description->side[k] > description->side[longest])
      longest = k;
  mesh->length = description->side[longest];
  mesh->coarsest = description->coarsest;
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
    coarsest = fmax(coarsest, least_cells);
  }
  int halvings = 0;
  while (round_up(wanted, COARSENING << halvings) >> (halvings + 1) >= coarsest)
    ++halvings;
  mesh->cells[longest] = round_up(wanted, COARSENING << halvings);
  for (int k = 0; k < mesh->dimension; ++k) {
    if (k != longest) {
      int step = step_of_cells(description, k) << halvings;
      double ratio = description->side[k] / mesh->length;
      int parts = (int)lround(ratio * mesh->cells[longest] / step);
      mesh->cells[k] = step * (parts > 0 ? parts : 1);
    }
    mesh->periodic[k] = description->periodic[k];
    mesh->origin[k] = description->origin[k];
    mesh->spacing[k] = description->side[k] / mesh->length / mesh->cells[k];
  }
  double bytes = sizeof(float);
  for (int k = 0; k < mesh->dimension; ++k)
    bytes *= mesh->cells[k] + 1.0;
  if (bytes > (double)PTRDIFF_MAX) /* where addresses have 32 bits */
    return fg__fail(context, FG_STATUS_MEMORY, "out of memory: %.0f bytes for a mesh",
                    bytes);
  return FG_STATUS_OK;
}

static fg_status share_nodes(fg__mesh *mesh, fg_context *context, bool may_idle)
{
  fg__blocks blocks;
  fg_status status = fg__blocks_choose(&blocks, context, mesh->ranks, mesh->dimension,
                                       mesh->cells, may_idle);
  if (!status)
    status = fg__partition_create(&mesh->partition, context, mesh->ranks, mesh->dimension,
                                  mesh->cells, mesh->periodic, blocks.count, blocks.unit);
  return fg__ranks_agree(mesh->ranks, context, status);
}

fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description)
{
  int dimension = description->dimension;
  *out =
      (fg__mesh){.dimension = dimension, .cells = {1, 1, 1}, .spacing = {1.0, 1.0, 1.0}};
  if (dimension != 2 && dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "a mesh of %d dimensions", dimension);
  fg_status status = check_description(context, description);
  if (!status)
    status = choose_cells(out, context, description);
  out->ranks = description->ranks ? description->ranks : fg__ranks_of(context);
  if (!status)
    status = share_nodes(out, context, description->may_idle);
  if (status)
    fg__mesh_clear(out);
  return status;
}

void fg__mesh_clear(fg__mesh *mesh)
{
  fg__partition_clear(&mesh->partition);
  *mesh = (fg__mesh){0};
}

int fg__mesh_most_cells(const fg__mesh *mesh)
{
  int most = 0;
  for (int k = 0; k < mesh->dimension; ++k)
    if (mesh->spacing[k] * mesh->cells[k] > 1.0 - 1e-9)
      most = mesh->cells[k] > most ? mesh->cells[k] : most;
  return most;
}

bool fg__mesh_can_coarsen(const fg__mesh *mesh)
{
  fg__mesh half = {.dimension = mesh->dimension};
  fg__mesh_description description = {.dimension = mesh->dimension,
                                      .nodes = fg__mesh_most_cells(mesh) / 2 + 1,
                                      .coarsest = mesh->coarsest};
  for (int k = 0; k < mesh->dimension; ++k) {
    description.side[k] = mesh->spacing[k] * mesh->cells[k];
    description.periodic[k] = mesh->periodic[k];
  }
  if (check_description(NULL, &description) || choose_cells(&half, NULL, &description))
    return false;
  for (int k = 0; k < mesh->dimension; ++k)
    if (2 * half.cells[k] != mesh->cells[k])
      return false;
  return true;
}
