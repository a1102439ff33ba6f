#include "cluster/raster.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "cluster/cut.h"

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
    int first = bounds[2 * k] - FG__CUT_RIM, last = bounds[2 * k + 1] + FG__CUT_RIM;
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

static void copy_active(fg__window *window, const int corner[2],
                        const fg_density_arrays *density, const fg__patch *patch)
{
  size_t row = 0;
  bool round = density->periodic[0] && patch->nodes[0] == density->nodes[0];
  int cells_x = round ? patch->nodes[0] : patch->nodes[0] - 1;
  for (int y = 0; y < window->nodes[1] - 1; ++y) {
    int from_y = fg__cut_wrap(corner[1] + y - patch->first[1], density->nodes[1]);
    for (int x = 0; x < window->nodes[0] - 1; ++x) {
      int from_x = fg__cut_wrap(corner[0] + x - patch->first[0], density->nodes[0]);
      size_t cell = (size_t)from_y * (size_t)cells_x + (size_t)from_x;
      window->active[row + (size_t)x] = !patch->active || patch->active[cell];
    }
    row += (size_t)window->nodes[0] - 1;
  }
}

static void copy_level(fg__window *window, const int corner[2],
                       const fg_density_arrays *density, const fg__labels *labels,
                       const fg__patch *patch)
{
  const int *bounds = labels->bounds[window->cluster - 1];
  float *level = window->level;
  for (int y = 0; y < window->nodes[1]; ++y) {
    int unwrapped_y = corner[1] + y;
    size_t from_row =
        (size_t)fg__cut_wrap(unwrapped_y - patch->first[1], density->nodes[1]) *
        (size_t)patch->nodes[0];
    for (int x = 0; x < window->nodes[0]; ++x, ++level) {
      int unwrapped_x = corner[0] + x;
      size_t node = from_row + (size_t)fg__cut_wrap(unwrapped_x - patch->first[0],
                                                    density->nodes[0]);
      bool in_bounds = unwrapped_x >= bounds[0] && unwrapped_x <= bounds[1] &&
                       unwrapped_y >= bounds[2] && unwrapped_y <= bounds[3];
      float u = patch->u[node];
      if (patch->label[node] == 0)
        *level = u <= 0.0F ? u : FG__CUT_OUTSIDE;
      else if (patch->label[node] == window->cluster && in_bounds)
        *level = u;
      else
        *level = fg__cut_turned_off(u);
    }
  }
}

fg_status fg__window_keep_largest(fg__window *window, fg_context *context)
{
  const int nodes[3] = {window->nodes[0], window->nodes[1], 0};
  return fg__cut_keep_largest(window->level, window->active, nodes, context);
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
  for (int k = 0; k < 2; ++k) {
    out->spacing[k] = density->spacing[k];
    corner[k] = fg__cut_place(&out->nodes[k], &out->origin[k], &out->at_border[2 * k],
                              density, labels, cluster, k);
  }
  fg_status status = fg__window_allocate(out, context);
  if (status)
    return status;
  copy_active(out, corner, density, patch);
  copy_level(out, corner, density, labels, patch);
  const int *bounds = labels->bounds[cluster - 1];
  /* in coordinates that go on across a periodic border a window can show parts of the
   * cluster a second time, and a cut can part it */
  if (bounds[1] >= density->nodes[0] || bounds[3] >= density->nodes[1])
    status = fg__window_keep_largest(out, context);
  if (status)
    fg__window_clear(out);
  return status;
}

fg_status fg__window_allocate(fg__window *window, fg_context *context)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  size_t cells = (size_t)(window->nodes[0] - 1) * (size_t)(window->nodes[1] - 1);
  window->level = fg__allocate(nodes, sizeof *window->level);
  window->active = fg__allocate(cells, 1);
  if (window->level && window->active)
    return FG_STATUS_OK;
  fg__window_clear(window);
  return fg__fail_memory(context, "a cluster's window", nodes * sizeof(float) + cells);
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
      return (double)FG__CUT_OUTSIDE;
    cell[k] = (int)place;
    if (cell[k] == window->nodes[k] - 1)
      --cell[k];
    share[k] = place - cell[k];
  }
  if (!window->active[cell[1] * (window->nodes[0] - 1) + cell[0]])
    return (double)FG__CUT_OUTSIDE;
  const float *low = window->level + cell[1] * window->nodes[0] + cell[0];
  const float *high = low + window->nodes[0];
  double bottom = (1.0 - share[0]) * (double)low[0] + share[0] * (double)low[1];
  double top = (1.0 - share[0]) * (double)high[0] + share[0] * (double)high[1];
  return (1.0 - share[1]) * bottom + share[1] * top;
}
