#include "mesh/mesh.h"

#include <math.h>
#include <p4est_bits.h>
#include <p4est_extended.h>
#include <stdlib.h>

#include "base/memory.h"
#include "mesh/message_passing.h"

/* Cells longer than twice their width resolve an interface in one direction only: a thin
 * domain gets more nodes along it than asked for. */
static const double most_cell_ratio = 2.0;

/* 4097 nodes a side need 1.7 GB; a typing error should not ask for more. */
enum { LEAST_NODES = 9, MOST_NODES = 16385, COARSENING = 16, SHORT_SIDE_COARSENING = 8 };

struct fg__forest {
  p4est_connectivity_t *connectivity;
  p4est_t *p4est;
};

static int round_up(int value, int multiple)
{
  return (value + multiple - 1) / multiple * multiple;
}

static int greatest_power_of_two_in(int a, int b)
{
  int power = 1;
  while (a % (2 * power) == 0 && b % (2 * power) == 0)
    power *= 2;
  return power;
}

static fg_status choose_cells(fg__mesh *mesh, fg_context *context,
                              const fg__mesh_description *description)
{
  if (description->nodes < LEAST_NODES || description->nodes > MOST_NODES)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%d nodes a side; from %d to %d are possible", description->nodes,
                    LEAST_NODES, MOST_NODES);
  for (int k = 0; k < 2; ++k)
    if (!(description->side[k] > 0.0) || !isfinite(description->side[k]))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "the domain's side along axis %d is %g", k, description->side[k]);
  int longest = description->side[1] > description->side[0];
  mesh->length = description->side[longest];
  double ratio = description->side[!longest] / mesh->length;
  int multiple = description->periodic[!longest] ? COARSENING : SHORT_SIDE_COARSENING;
  double least_cells = multiple / ratio / most_cell_ratio;
  if (least_cells > MOST_NODES - 1)
    return fg__fail(
        context, FG_STATUS_ARGUMENT,
        "the domain is %g times as long as wide: it would take %.0f nodes along it, "
        "at most %d are possible",
        1.0 / ratio, least_cells + 1.0, MOST_NODES);
  int wanted = description->nodes - 1;
  if (least_cells > wanted)
    wanted = (int)ceil(least_cells);
  mesh->cells[longest] = round_up(wanted, COARSENING);
  int parts = (int)lround(ratio * mesh->cells[longest] / multiple);
  mesh->cells[!longest] = multiple * (parts > 0 ? parts : 1);
  for (int k = 0; k < 2; ++k) {
    mesh->periodic[k] = description->periodic[k];
    mesh->origin[k] = description->origin[k];
    mesh->spacing[k] = description->side[k] / mesh->length / mesh->cells[k];
  }
  return FG_STATUS_OK;
}

static fg_status grow_forest(fg__mesh *mesh, fg_context *context)
{
  fg_status status = fg__message_passing_start(context);
  if (status)
    return status;
  mesh->forest = fg__allocate(1, sizeof *mesh->forest);
  if (!mesh->forest)
    return fg__fail_memory(context, "the forest", sizeof *mesh->forest);
  mesh->patch_cells = greatest_power_of_two_in(mesh->cells[0], mesh->cells[1]);
  mesh->forest->connectivity = p4est_connectivity_new_brick(
      mesh->cells[0] / mesh->patch_cells, mesh->cells[1] / mesh->patch_cells,
      mesh->periodic[0], mesh->periodic[1]);
  mesh->forest->p4est = p4est_new_ext(sc_MPI_COMM_WORLD, mesh->forest->connectivity, 0, 0,
                                      1, 0, NULL, NULL);
  if (mesh->forest->p4est->mpisize != 1)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "started on %d ranks; this version runs on one",
                    mesh->forest->p4est->mpisize);
  return FG_STATUS_OK;
}

/* The leaves of a uniform forest on one rank fill the box: one tile. The cell range comes
 * from the leaves themselves, so that a hole would show. */
static fg_status merge_leaves(fg__mesh *mesh, fg_context *context)
{
  p4est_t *p4est = mesh->forest->p4est;
  int low[2] = {mesh->cells[0], mesh->cells[1]}, high[2] = {0, 0};
  long covered = 0;
  for (p4est_topidx_t t = p4est->first_local_tree; t <= p4est->last_local_tree; ++t) {
    p4est_tree_t *tree = p4est_tree_array_index(p4est->trees, t);
    for (size_t q = 0; q < tree->quadrants.elem_count; ++q) {
      p4est_quadrant_t *leaf = p4est_quadrant_array_index(&tree->quadrants, q);
      double corner[3];
      p4est_qcoord_to_vertex(mesh->forest->connectivity, t, leaf->x, leaf->y, corner);
      int side = mesh->patch_cells >> leaf->level;
      for (int k = 0; k < 2; ++k) {
        int first = (int)lround(corner[k] * mesh->patch_cells);
        low[k] = first < low[k] ? first : low[k];
        high[k] = first + side > high[k] ? first + side : high[k];
      }
      covered += (long)side * side;
    }
  }
  if (covered != (long)(high[0] - low[0]) * (high[1] - low[1]))
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "the leaves do not fill a rectangle");
  mesh->tile = fg__allocate(1, sizeof *mesh->tile);
  if (!mesh->tile)
    return fg__fail_memory(context, "the tiles", sizeof *mesh->tile);
  mesh->tile_count = 1;
  for (int k = 0; k < 2; ++k) {
    mesh->tile[0].first[k] = low[k];
    mesh->tile[0].cells[k] = high[k] - low[k];
  }
  return FG_STATUS_OK;
}

fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description)
{
  *out = (fg__mesh){.dimension = 2};
  fg_status status = choose_cells(out, context, description);
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
  if (mesh->forest) {
    if (mesh->forest->p4est)
      p4est_destroy(mesh->forest->p4est);
    if (mesh->forest->connectivity)
      p4est_connectivity_destroy(mesh->forest->connectivity);
    free(mesh->forest);
  }
  free(mesh->tile);
  *mesh = (fg__mesh){0};
}
