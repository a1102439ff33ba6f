#include "cluster/volume.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "cluster/cut.h"

/* Where the window's node (cell) `at` lies in a patch that is `width` wide along an axis.
 */
static size_t in_patch(const int at[3], const int corner[3],
                       const fg_density_arrays *density, const fg__patch *patch,
                       const int width[3])
{
  size_t index = 0;
  for (int k = 2; k >= 0; --k) {
    int place = fg__cut_wrap(corner[k] + at[k] - patch->first[k], density->nodes[k]);
    index = index * (size_t)width[k] + (size_t)place;
  }
  return index;
}

static void copy_active(fg__volume *volume, const int corner[3],
                        const fg_density_arrays *density, const fg__patch *patch)
{
  int width[3], at[3];
  for (int k = 0; k < 3; ++k) {
    bool round = density->periodic[k] && patch->nodes[k] == density->nodes[k];
    width[k] = round ? patch->nodes[k] : patch->nodes[k] - 1;
  }
  unsigned char *active = volume->active;
  for (at[2] = 0; at[2] < volume->nodes[2] - 1; ++at[2])
    for (at[1] = 0; at[1] < volume->nodes[1] - 1; ++at[1])
      for (at[0] = 0; at[0] < volume->nodes[0] - 1; ++at[0])
        *active++ =
            !patch->active || patch->active[in_patch(at, corner, density, patch, width)];
}

static void copy_level(fg__volume *volume, const int corner[3],
                       const fg_density_arrays *density, const fg__labels *labels,
                       const fg__patch *patch)
{
  const int *bounds = labels->bounds[volume->cluster - 1];
  float *level = volume->level;
  int at[3];
  for (at[2] = 0; at[2] < volume->nodes[2]; ++at[2])
    for (at[1] = 0; at[1] < volume->nodes[1]; ++at[1])
      for (at[0] = 0; at[0] < volume->nodes[0]; ++at[0], ++level) {
        size_t node = in_patch(at, corner, density, patch, patch->nodes);
        bool in_bounds = true;
        for (int k = 0; k < 3; ++k)
          in_bounds = in_bounds && corner[k] + at[k] >= bounds[2 * k] &&
                      corner[k] + at[k] <= bounds[2 * k + 1];
        float u = patch->u[node];
        if (patch->label[node] == 0)
          *level = u <= 0.0F ? u : FG__CUT_OUTSIDE;
        else
          *level = patch->label[node] == volume->cluster && in_bounds
                       ? u
                       : fg__cut_turned_off(u);
      }
}

fg_status fg__volume_keep_largest(fg__volume *volume, fg_context *context)
{
  return fg__cut_keep_largest(volume->level, volume->active, volume->nodes, context);
}

fg_status fg__volume_cut(fg__volume *out, fg_context *context,
                         const fg_density_arrays *density, const fg__labels *labels,
                         const fg__patch *patch, int cluster)
{
  *out = (fg__volume){.cluster = cluster};
  if (cluster < 1 || cluster > labels->count)
    return fg__fail(context, FG_STATUS_ARGUMENT, "window: cluster %d of %d", cluster,
                    labels->count);
  int corner[3];
  bool unwrapped = false;
  for (int k = 0; k < 3; ++k) {
    out->spacing[k] = density->spacing[k];
    corner[k] = fg__cut_place(&out->nodes[k], &out->origin[k], &out->at_border[2 * k],
                              density, labels, cluster, k);
    unwrapped = unwrapped || labels->bounds[cluster - 1][2 * k + 1] >= density->nodes[k];
  }
  fg_status status = fg__volume_allocate(out, context);
  if (status)
    return status;
  copy_active(out, corner, density, patch);
  copy_level(out, corner, density, labels, patch);
  /* unwrapped, or cut, a cluster can show parts of itself a second time */
  if (unwrapped)
    status = fg__volume_keep_largest(out, context);
  if (status)
    fg__volume_clear(out);
  return status;
}

fg_status fg__volume_allocate(fg__volume *volume, fg_context *context)
{
  size_t nodes = fg__volume_count(volume), cells = 1;
  for (int k = 0; k < 3; ++k)
    cells *= (size_t)volume->nodes[k] - 1;
  volume->level = fg__allocate(nodes, sizeof *volume->level);
  volume->active = fg__allocate(cells, 1);
  if (volume->level && volume->active)
    return FG_STATUS_OK;
  fg__volume_clear(volume);
  return fg__fail_memory(context, "a cluster's window", nodes * sizeof(float) + cells);
}

void fg__volume_clear(fg__volume *volume)
{
  free(volume->level);
  free(volume->active);
  *volume = (fg__volume){0};
}

/* The cell of a point, clamped to the window, and its place there; false outside. */
static bool find_cell(const fg__volume *volume, const double position[3], int cell[3],
                      double share[3])
{
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    double place = (position[k] - volume->origin[k]) / volume->spacing[k];
    inside = inside && place >= 0.0 && place <= volume->nodes[k] - 1;
    place = fmin(fmax(place, 0.0), volume->nodes[k] - 1);
    cell[k] = (int)place;
    if (cell[k] == volume->nodes[k] - 1)
      --cell[k];
    share[k] = place - cell[k];
  }
  return inside;
}

/* Weights of the eight corners, and the nodes they belong to. */
static void weigh(const fg__volume *volume, const int cell[3], const double share[3],
                  size_t node[8], double weight[8])
{
  for (int c = 0; c < 8; ++c) {
    int dx = c & 1, dy = c >> 1 & 1, dz = c >> 2;
    node[c] = fg__volume_node(volume, cell[0] + dx, cell[1] + dy, cell[2] + dz);
    weight[c] = (dx ? share[0] : 1.0 - share[0]) * (dy ? share[1] : 1.0 - share[1]) *
                (dz ? share[2] : 1.0 - share[2]);
  }
}

double fg__volume_level(const fg__volume *volume, const double position[3])
{
  int cell[3];
  double share[3], weight[8], sum = 0.0;
  size_t node[8];
  if (!find_cell(volume, position, cell, share) ||
      !volume->active[fg__volume_cell(volume, cell[0], cell[1], cell[2])])
    return (double)FG__CUT_OUTSIDE;
  weigh(volume, cell, share, node, weight);
  for (int c = 0; c < 8; ++c)
    sum += weight[c] * (double)volume->level[node[c]];
  return sum;
}

double fg__volume_value(const fg__volume *volume, const double *value,
                        const double position[3])
{
  int cell[3];
  double share[3], weight[8], sum = 0.0;
  size_t node[8];
  find_cell(volume, position, cell, share);
  weigh(volume, cell, share, node, weight);
  for (int c = 0; c < 8; ++c)
    sum += weight[c] * value[node[c]];
  return sum;
}
