#include "cluster/window.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "component/components.h"

/* Two nodes beyond the cluster: one for the zero set, one more so that gradients next to
 * it can be taken. */
enum { RIM = 2 };

/* Level of a masked place: the minimum of the double well outside the clusters. */
static const float OUTSIDE = -1.0F;

static int wrap(int index, int period)
{
  int rest = index % period;
  return rest < 0 ? rest + period : rest;
}

/* Level where something else than the cluster has u > 0: as near to zero as still is
 * outside, so that the zero set moves least in a cell which two clusters touch from two
 * corners. On the edges of the cells it does not move at all. */
static float turned_off(float u)
{
  return fminf(-u / 1024.0F, -0x1p-100F);
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

/* A window that is being cut out of a patch. */
typedef struct cutting {
  fg__window *window;
  const fg_density_arrays *density;
  const fg__patch *patch;
  int corner[3]; /* the window's first node on the density's grid */
} cutting;

/* Sets the window's place along one axis. */
static void place_along(cutting *c, const fg__labels *labels, int axis)
{
  fg__window *window = c->window;
  const int *bounds = labels->bounds[window->cluster - 1] + 2 * axis;
  bool closed = labels->closed[window->cluster - 1][axis];
  int rim = closed ? 0 : RIM, most = c->density->nodes[axis] - 1;
  int first = bounds[0] - rim, last = bounds[1] + rim;
  bool *at_boundary = &window->at_boundary[2 * axis];
  at_boundary[0] = at_boundary[1] = closed;
  if (!c->density->periodic[axis]) {
    at_boundary[0] = first <= 0;
    at_boundary[1] = last >= most;
    first = first < 0 ? 0 : first;
    last = last > most ? most : last;
  }
  window->nodes[axis] = last - first + 1;
  window->spacing[axis] = c->density->spacing[axis];
  window->origin[axis] = c->density->origin[axis] + first * c->density->spacing[axis];
  c->corner[axis] = first;
}

/* Where the window's node or cell `at` lies along an axis of the patch. */
static size_t place_in_patch(const cutting *c, int at, int axis)
{
  if (axis >= c->window->dimension)
    return 0;
  return (size_t)wrap(c->corner[axis] + at - c->patch->first[axis],
                      c->density->nodes[axis]);
}

static void copy_active(const cutting *c)
{
  const fg__window *window = c->window;
  const fg__patch *patch = c->patch;
  size_t width[2];
  for (int k = 0; k < 2; ++k) {
    bool round = c->density->periodic[k] && patch->nodes[k] == c->density->nodes[k];
    width[k] = (size_t)(round ? patch->nodes[k] : patch->nodes[k] - 1);
  }
  int layers = window->dimension == 3 ? window->nodes[2] - 1 : 1;
  unsigned char *active = window->active;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < window->nodes[1] - 1; ++y) {
      size_t row = place_in_patch(c, z, 2) * width[1] + place_in_patch(c, y, 1);
      for (int x = 0; x < window->nodes[0] - 1; ++x)
        *active++ =
            !patch->active || patch->active[row * width[0] + place_in_patch(c, x, 0)];
    }
}

/* Levels of a row of nodes; `from` is where it begins in the patch. */
static void copy_row(const cutting *c, float *level, size_t from, const int *bounds_x,
                     bool in_bounds)
{
  for (int x = 0; x < c->window->nodes[0]; ++x) {
    size_t node = from + place_in_patch(c, x, 0);
    int at = c->corner[0] + x;
    float u = c->patch->u[node];
    if (c->patch->label[node] == 0)
      level[x] = u <= 0.0F ? u : OUTSIDE;
    else if (c->patch->label[node] == c->window->cluster && in_bounds &&
             at >= bounds_x[0] && at <= bounds_x[1])
      level[x] = u;
    else
      level[x] = turned_off(u);
  }
}

static void copy_level(const cutting *c, const fg__labels *labels)
{
  const fg__window *window = c->window;
  const int *bounds = labels->bounds[window->cluster - 1], *nodes = c->patch->nodes;
  float *level = window->level;
  for (int z = 0; z < window->nodes[2]; ++z)
    for (int y = 0; y < window->nodes[1]; ++y, level += window->nodes[0]) {
      size_t row = place_in_patch(c, z, 2) * (size_t)nodes[1] + place_in_patch(c, y, 1);
      int at_y = c->corner[1] + y, at_z = c->corner[2] + z;
      bool in_bounds =
          at_y >= bounds[2] && at_y <= bounds[3] &&
          (window->dimension == 2 || (at_z >= bounds[4] && at_z <= bounds[5]));
      copy_row(c, level, row * (size_t)nodes[0], bounds, in_bounds);
    }
}

fg_status fg__window_keep_largest(fg__window *window, fg_context *context)
{
  fg__component_grid grid = {
      .nodes = {window->nodes[0], window->nodes[1], window->nodes[2]},
      .u = window->level,
      .active = window->active};
  fg__components pieces = {0};
  fg_status status = fg__components_find(&pieces, context, &grid);
  int largest = 1;
  for (int k = 1; k < pieces.count && !status; ++k)
    if (pieces.area[k] > pieces.area[largest - 1])
      largest = k + 1;
  float *level = window->level;
  for (size_t k = 0; k < fg__window_count(window) && !status; ++k)
    if (level[k] > 0.0F && pieces.label[k] != largest)
      level[k] = turned_off(level[k]);
  fg__components_clear(&pieces);
  return status;
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
  *out = (fg__window){
      .cluster = cluster, .dimension = density->dimension, .nodes = {1, 1, 1}};
  if (cluster < 1 || cluster > labels->count)
    return fg__fail(context, FG_STATUS_ARGUMENT, "window: cluster %d of %d", cluster,
                    labels->count);
  cutting c = {.window = out, .density = density, .patch = patch};
  bool unwrapped = false;
  for (int k = 0; k < density->dimension; ++k) {
    place_along(&c, labels, k);
    unwrapped = unwrapped || labels->bounds[cluster - 1][2 * k + 1] >= density->nodes[k];
  }
  fg_status status = fg__window_allocate(out, context);
  if (status)
    return status;
  copy_active(&c);
  copy_level(&c, labels);
  /* in coordinates that go on across a periodic boundary a window can show parts of the
   * cluster a second time, and a cut can part it */
  if (unwrapped)
    status = fg__window_keep_largest(out, context);
  if (status)
    fg__window_clear(out);
  return status;
}

fg_status fg__window_allocate(fg__window *window, fg_context *context)
{
  size_t nodes = fg__window_count(window), cells = 1;
  for (int k = 0; k < window->dimension; ++k)
    cells *= (size_t)window->nodes[k] - 1;
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

double fg__window_spacing(const fg__window *window)
{
  double least = fmin(window->spacing[0], window->spacing[1]);
  return window->dimension == 3 ? fmin(least, window->spacing[2]) : least;
}

bool fg__window_edge_active(const fg__window *window, const int place[3], int axis)
{
  int one = axis == 0 ? 1 : 0, other = axis == 2 ? 1 : 2;
  int cell[3] = {place[0], place[1], place[2]};
  for (int m = 0; m < (window->dimension == 3 ? 2 : 1); ++m) {
    cell[other] = place[other] - m;
    if (window->dimension == 3 &&
        (cell[other] < 0 || cell[other] >= window->nodes[other] - 1))
      continue;
    for (int n = 0; n < 2; ++n) {
      cell[one] = place[one] - n;
      if (cell[one] >= 0 && cell[one] < window->nodes[one] - 1 &&
          window->active[fg__window_cell(window, cell[0], cell[1], cell[2])])
        return true;
    }
  }
  return false;
}

bool fg__window_find(const fg__window *window, const double position[], int corner[3],
                     double share[3])
{
  bool inside = true;
  corner[2] = 0;
  share[2] = 0.0;
  for (int k = 0; k < window->dimension; ++k) {
    double place = (position[k] - window->origin[k]) / window->spacing[k];
    double last = window->nodes[k] - 1;
    bool within = place >= 0.0 && place <= last;
    if (!within) {
      inside = false;
      place = place > 0.0 ? last : 0.0;
    }
    corner[k] = (int)place;
    if (corner[k] == window->nodes[k] - 1)
      --corner[k];
    share[k] = place - corner[k];
  }
  return inside;
}

/* Bilinear in a cell's face of constant z: its four corners, and the place there. */
static double mean_of(double a, double b, double c, double d, const double share[3])
{
  double low = (1.0 - share[0]) * a + share[0] * b;
  double high = (1.0 - share[0]) * c + share[0] * d;
  return (1.0 - share[1]) * low + share[1] * high;
}

static double level_in_face(const float *low, int width, const double share[3])
{
  const float *high = low + width;
  return mean_of((double)low[0], (double)low[1], (double)high[0], (double)high[1], share);
}

double fg__window_level(const fg__window *window, const double position[])
{
  int at[3] = {0}, width = window->nodes[0];
  double share[3] = {0};
  if (!fg__window_find(window, position, at, share) ||
      !window->active[fg__window_cell(window, at[0], at[1], at[2])])
    return (double)OUTSIDE;
  const float *level = window->level + fg__window_node(window, at[0], at[1], at[2]);
  double low = level_in_face(level, width, share);
  if (window->dimension == 2)
    return low;
  double high = level_in_face(level + width * window->nodes[1], width, share);
  return (1.0 - share[2]) * low + share[2] * high;
}

static double value_in_face(const double *low, int width, const double share[3])
{
  return mean_of(low[0], low[1], low[width], low[width + 1], share);
}

double fg__window_value(const fg__window *window, const double *value,
                        const double position[])
{
  int at[3] = {0}, width = window->nodes[0];
  double share[3] = {0};
  fg__window_find(window, position, at, share);
  value += fg__window_node(window, at[0], at[1], at[2]);
  double low = value_in_face(value, width, share);
  if (window->dimension == 2)
    return low;
  double high = value_in_face(value + width * window->nodes[1], width, share);
  return (1.0 - share[2]) * low + share[2] * high;
}
