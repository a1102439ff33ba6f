#include "cluster/raster.h"

#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "cluster/unwrap.h"
#include "component/components.h"

/* Bounds inside the grid, and each cluster's first node. */
static void find_bounds(fg__labels *labels, const int nodes[3], int *first)
{
  for (int k = 0; k < labels->count; ++k)
    first[k] = -1;
  int node = 0;
  for (int z = 0; z < nodes[2]; ++z)
    for (int y = 0; y < nodes[1]; ++y)
      for (int x = 0; x < nodes[0]; ++x, ++node) {
        if (labels->label[node] <= 0)
          continue;
        int cluster = labels->label[node] - 1;
        const int place[3] = {x, y, z};
        int *bounds = labels->bounds[cluster];
        for (int k = 0; k < 3 && first[cluster] < 0; ++k)
          bounds[2 * k] = bounds[2 * k + 1] = place[k];
        if (first[cluster] < 0)
          first[cluster] = node;
        for (int k = 0; k < 3; ++k) {
          bounds[2 * k] = place[k] < bounds[2 * k] ? place[k] : bounds[2 * k];
          bounds[2 * k + 1] = place[k] > bounds[2 * k + 1] ? place[k] : bounds[2 * k + 1];
        }
      }
}

/* Follows the clusters that lie on both sides of a periodic border across it. */
static fg_status unwrap_bounds(fg__labels *labels, fg_context *context,
                               const fg__component_grid *grid, const int *first)
{
  if (!grid->periodic[0] && !grid->periodic[1] && !grid->periodic[2])
    return FG_STATUS_OK;
  fg__unwrap unwrap;
  fg_status status = fg__unwrap_create(&unwrap, context, grid, labels->label);
  if (status)
    return status;
  for (int k = 0; k < labels->count; ++k) {
    const int *bounds = labels->bounds[k];
    bool on_both_sides = false;
    for (int axis = 0; axis < 3; ++axis)
      on_both_sides = on_both_sides || (grid->periodic[axis] && bounds[2 * axis] == 0 &&
                                        bounds[2 * axis + 1] == grid->nodes[axis] - 1);
    if (on_both_sides)
      fg__unwrap_bounds(&unwrap, first[k], labels->bounds[k], labels->closed[k]);
  }
  fg__unwrap_clear(&unwrap);
  return FG_STATUS_OK;
}

fg_status fg__labels_create(fg__labels *out, fg_context *context,
                            const fg_density_arrays *density)
{
  *out = (fg__labels){0};
  double cell_area = 1.0;
  fg__component_grid grid = {
      .nodes = {1, 1, 1}, .u = density->u, .active = density->active};
  for (int k = 0; k < density->dimension; ++k) {
    grid.nodes[k] = density->nodes[k];
    grid.periodic[k] = density->periodic[k];
    cell_area *= density->spacing[k];
  }
  grid.debris_area = density->debris_area / cell_area;
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
