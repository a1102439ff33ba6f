#include "cluster/raster.h"

#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "cluster/unwrap.h"
#include "evolve/components.h"

/* Bounds inside the grid, and each cluster's first node. */
static void find_bounds(fg__labels *labels, const int nodes[2], int *first)
{
  for (int k = 0; k < labels->count; ++k)
    first[k] = -1;
  for (int y = 0; y < nodes[1]; ++y) {
    for (int x = 0; x < nodes[0]; ++x) {
      int node = y * nodes[0] + x;
      if (labels->label[node] <= 0)
        continue;
      int cluster = labels->label[node] - 1;
      int *bounds = labels->bounds[cluster];
      if (first[cluster] < 0) {
        first[cluster] = node;
        bounds[0] = bounds[1] = x;
        bounds[2] = y;
      }
      bounds[0] = x < bounds[0] ? x : bounds[0];
      bounds[1] = x > bounds[1] ? x : bounds[1];
      bounds[3] = y;
    }
  }
}

/* Follows the clusters that lie on both sides of a periodic border across it. */
static fg_status unwrap_bounds(fg__labels *labels, fg_context *context,
                               const fg__component_grid *grid, const int *first)
{
  if (!grid->periodic[0] && !grid->periodic[1])
    return FG_STATUS_OK;
  fg__unwrap unwrap;
  fg_status status = fg__unwrap_create(&unwrap, context, grid, labels->label);
  if (status)
    return status;
  for (int k = 0; k < labels->count; ++k) {
    const int *bounds = labels->bounds[k];
    bool on_both_sides[2];
    for (int axis = 0; axis < 2; ++axis)
      on_both_sides[axis] = grid->periodic[axis] && bounds[2 * axis] == 0 &&
                            bounds[2 * axis + 1] == grid->nodes[axis] - 1;
    if (on_both_sides[0] || on_both_sides[1])
      fg__unwrap_bounds(&unwrap, first[k], labels->bounds[k], labels->closed[k]);
  }
  fg__unwrap_clear(&unwrap);
  return FG_STATUS_OK;
}

fg_status fg__labels_create(fg__labels *out, fg_context *context,
                            const fg_density_arrays *density)
{
  *out = (fg__labels){0};
  double cell_area = density->spacing[0] * density->spacing[1];
  fg__component_grid grid = {
      .nodes = {density->nodes[0], density->nodes[1]},
      .periodic = {density->periodic[0], density->periodic[1]},
      .u = density->u,
      .active = density->active,
      .debris_area = density->debris_area / cell_area,
  };
  fg__components components = {0};
  int *first = NULL;
  fg_status status = fg__components_find(&components, context, &grid);
  if (status)
    goto cleanup;
  out->count = components.count;
  out->debris = components.debris;
  size_t count = (size_t)components.count;
  out->area = fg__allocate(count, sizeof *out->area);
  out->bounds = fg__allocate(count, sizeof *out->bounds);
  out->closed = fg__allocate(count, sizeof *out->closed);
  first = fg__allocate(count, sizeof *first);
  if (!out->area || !out->bounds || !out->closed || !first) {
    status = fg__fail_memory(context, "a list of clusters", count * sizeof *out->bounds);
    goto cleanup;
  }
  for (size_t k = 0; k < count; ++k)
    out->area[k] = components.area[k] * cell_area;
  out->label = components.label;
  components.label = NULL;
  find_bounds(out, grid.nodes, first);
  status = unwrap_bounds(out, context, &grid, first);

cleanup:
  free(first);
  fg__components_clear(&components);
  if (status)
    fg__labels_clear(out);
  return status;
}

void fg__labels_clear(fg__labels *labels)
{
  free(labels->label);
  free(labels->area);
  free(labels->bounds);
  free(labels->closed);
  *labels = (fg__labels){0};
}
