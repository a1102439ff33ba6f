#include "cluster/raster.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "evolve/components.h"

/* Two nodes beyond the cluster: one for the zero set, one more so that gradients next to
 * it can be taken. */
enum { RIM = 2 };

/* Of a masked place: the well outside the clusters. */
static const float outside_level = -1.0F;

static int wrap(int index, int period)
{
  int rest = index % period;
  return rest < 0 ? rest + period : rest;
}

fg__patch fg__patch_of(const fg_density_arrays *density, const fg__labels *labels)
{
  int depth = density->dimension == 3 ? density->nodes[2] : 1;
  return (fg__patch){.nodes = {density->nodes[0], density->nodes[1], depth},
                     .u = density->u,
                     .label = labels->label,
                     .active = density->active};
}

void fg__patch_place(fg__patch *patch, const fg_density_arrays *density,
                     const int bounds[6], const bool closed[3])
{
  patch->first[2] = 0;
  patch->nodes[2] = 1;
  for (int k = 0; k < density->dimension; ++k) {
    int first = bounds[2 * k] - RIM, last = bounds[2 * k + 1] + RIM;
    int most = density->nodes[k];
    if (!density->periodic[k]) {
      first = first < 0 ? 0 : first;
      last = last > most - 1 ? most - 1 : last;
    } else if (closed[k] || last - first + 1 >= most) {
      first = 0;
      last = most - 1;
    }
    patch->first[k] = first;
    patch->nodes[k] = last - first + 1;
  }
}

/* Sets the window's place on the density's grid; corner is its lower left node there. */
static void place(fg__window *window, int corner[2], const fg_density_arrays *density,
                  const fg__labels *labels)
{
  const int *bounds = labels->bounds[window->cluster - 1];
  const bool *closed = labels->closed[window->cluster - 1];
  for (int k = 0; k < 2; ++k) {
    int first = closed[k] ? bounds[2 * k] : bounds[2 * k] - RIM;
    int last = closed[k] ? bounds[2 * k + 1] : bounds[2 * k + 1] + RIM;
    window->at_border[2 * k] = closed[k];
    window->at_border[2 * k + 1] = closed[k];
    if (!density->periodic[k]) {
      window->at_border[2 * k] = first <= 0;
      window->at_border[2 * k + 1] = last >= density->nodes[k] - 1;
      first = first < 0 ? 0 : first;
      last = last > density->nodes[k] - 1 ? density->nodes[k] - 1 : last;
    }
    corner[k] = first;
    window->nodes[k] = last - first + 1;
    window->spacing[k] = density->spacing[k];
    window->origin[k] = density->origin[k] + first * density->spacing[k];
  }
}

static void copy_active(fg__window *window, const int corner[2],
                        const fg_density_arrays *density, const fg__patch *patch)
{
  size_t row = 0;
  bool round = density->periodic[0] && patch->nodes[0] == density->nodes[0];
  int cells_x = round ? patch->nodes[0] : patch->nodes[0] - 1;
  for (int y = 0; y < window->nodes[1] - 1; ++y) {
    int from_y = wrap(corner[1] + y - patch->first[1], density->nodes[1]);
    for (int x = 0; x < window->nodes[0] - 1; ++x) {
      int from_x = wrap(corner[0] + x - patch->first[0], density->nodes[0]);
      size_t cell = (size_t)from_y * (size_t)cells_x + (size_t)from_x;
      window->active[row + (size_t)x] = !patch->active || patch->active[cell];
    }
    row += (size_t)window->nodes[0] - 1;
  }
}

/* Where something else than the cluster is positive: as near to zero as still is outside,
 * so that the zero set moves least in a cell which two clusters touch from two corners.
 * On the edges of the cells it does not move at all. */
static float turned_off(float u)
{
  return fminf(-u / 1024.0F, -0x1p-100F);
}

static void copy_level(fg__window *window, const int corner[2],
                       const fg_density_arrays *density, const fg__labels *labels,
                       const fg__patch *patch)
{
  const int *bounds = labels->bounds[window->cluster - 1];
  float *level = window->level;
  for (int y = 0; y < window->nodes[1]; ++y) {
    int unwrapped_y = corner[1] + y;
    size_t from_row = (size_t)wrap(unwrapped_y - patch->first[1], density->nodes[1]) *
                      (size_t)patch->nodes[0];
    for (int x = 0; x < window->nodes[0]; ++x, ++level) {
      int unwrapped_x = corner[0] + x;
      size_t node =
          from_row + (size_t)wrap(unwrapped_x - patch->first[0], density->nodes[0]);
      bool in_bounds = unwrapped_x >= bounds[0] && unwrapped_x <= bounds[1] &&
                       unwrapped_y >= bounds[2] && unwrapped_y <= bounds[3];
      float u = patch->u[node];
      if (patch->label[node] == 0)
        *level = u <= 0.0F ? u : outside_level;
      else if (patch->label[node] == window->cluster && in_bounds)
        *level = u;
      else
        *level = turned_off(u);
    }
  }
}

fg_status fg__window_keep_largest(fg__window *window, fg_context *context)
{
  fg__component_grid grid = {
      .nodes = {window->nodes[0], window->nodes[1]},
      .u = window->level,
      .active = window->active,
  };
  fg__components pieces = {0};
  fg_status status = fg__components_find(&pieces, context, &grid);
  if (status) {
    fg__components_clear(&pieces);
    return status;
  }
  int largest = 1;
  for (int k = 1; k < pieces.count; ++k) {
    if (pieces.area[k] > pieces.area[largest - 1])
      largest = k + 1;
  }
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  for (size_t k = 0; k < nodes; ++k) {
    if (window->level[k] > 0.0F && pieces.label[k] != largest)
      window->level[k] = turned_off(window->level[k]);
  }
  fg__components_clear(&pieces);
  return FG_STATUS_OK;
}

fg_status fg__window_create(fg__window *out, fg_context *context,
                            const fg_density_arrays *density, const fg__labels *labels,
                            int cluster)
{
  fg__patch whole = fg__patch_of(density, labels);
  return fg__window_cut(out, context, density, labels, &whole, cluster);
}

fg_status fg__window_cut(fg__window *out, fg_context *context,
                         const fg_density_arrays *density, const fg__labels *labels,
                         const fg__patch *patch, int cluster)
{
  *out = (fg__window){.cluster = cluster};
  if (cluster < 1 || cluster > labels->count)
    return fg__fail(context, FG_STATUS_ARGUMENT, "window: cluster %d of %d", cluster,
                    labels->count);
  int corner[2];
  place(out, corner, density, labels);
  size_t nodes = (size_t)out->nodes[0] * (size_t)out->nodes[1];
  size_t cells = (size_t)(out->nodes[0] - 1) * (size_t)(out->nodes[1] - 1);
  out->level = fg__allocate(nodes, sizeof *out->level);
  out->active = fg__allocate(cells, 1);
  if (!out->level || !out->active) {
    fg__window_clear(out);
    return fg__fail_memory(context, "a cluster's window", nodes * sizeof(float) + cells);
  }
  copy_active(out, corner, density, patch);
  copy_level(out, corner, density, labels, patch);
  const int *bounds = labels->bounds[cluster - 1];
  fg_status status = FG_STATUS_OK;
  /* in coordinates that go on across a periodic border a window can show parts of the
   * cluster a second time, and a cut can part it */
  if (bounds[1] >= density->nodes[0] || bounds[3] >= density->nodes[1])
    status = fg__window_keep_largest(out, context);
  if (status)
    fg__window_clear(out);
  return status;
}

void fg__window_clear(fg__window *window)
{
  free(window->level);
  free(window->active);
  *window = (fg__window){0};
}

bool fg__window_edge_active(const fg__window *window, int x, int y, int axis)
{
  int cells_x = window->nodes[0] - 1;
  int cells_y = window->nodes[1] - 1;
  int before_x = axis == 0 ? x : x - 1; /* the cell on the other side */
  int before_y = axis == 0 ? y - 1 : y;
  if (x < cells_x && y < cells_y && window->active[y * cells_x + x])
    return true;
  return before_x >= 0 && before_x < cells_x && before_y >= 0 && before_y < cells_y &&
         window->active[before_y * cells_x + before_x];
}

double fg__window_level(const fg__window *window, const double position[2])
{
  int cell[2];
  double share[2];
  for (int k = 0; k < 2; ++k) {
    double place = (position[k] - window->origin[k]) / window->spacing[k];
    if (!(place >= 0.0) || !(place <= window->nodes[k] - 1))
      return (double)outside_level;
    cell[k] = (int)place;
    if (cell[k] == window->nodes[k] - 1)
      --cell[k];
    share[k] = place - cell[k];
  }
  if (!window->active[cell[1] * (window->nodes[0] - 1) + cell[0]])
    return (double)outside_level;
  const float *low = window->level + cell[1] * window->nodes[0] + cell[0];
  const float *high = low + window->nodes[0];
  double bottom = (1.0 - share[0]) * (double)low[0] + share[0] * (double)low[1];
  double top = (1.0 - share[0]) * (double)high[0] + share[0] * (double)high[1];
  return (1.0 - share[1]) * bottom + share[1] * top;
}
