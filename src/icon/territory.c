#include "icon/territory.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "cluster/cut.h"
#include "skeleton/heap.h"

/* First order fast marching from all clusters at once (Sethian, "A fast marching level
 * set method for monotonically advancing fronts", PNAS 93, 1996). At a border two fronts
 * of the same error meet: their difference is better than either. */

/* A zero set nearer to a node than this share of an edge counts as that far away. */
static const double NEAREST = 1e-3;

/* Nodes of a window beyond the territory, so that the border lies inside. */
enum { RIM = 1, DIRECTIONS = 4 };

static const int STEP[DIRECTIONS][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

/* The node next to (x, y) in a direction, or -1 at the border of the domain or where no
 * active cell leads there. */
static int neighbour(const fg__component_grid *grid, int x, int y, int direction)
{
  int place[2] = {x + STEP[direction][0], y + STEP[direction][1]};
  int axis = direction / 2;
  int nodes = grid->nodes[axis];
  if (place[axis] < 0 || place[axis] >= nodes) {
    if (!grid->periodic[axis])
      return -1;
    place[axis] = (place[axis] + nodes) % nodes;
  }
  bool forward = direction % 2 == 1;
  if (!fg__components_edge_active(grid, forward ? x : place[0], forward ? y : place[1],
                                  axis))
    return -1;
  return place[1] * grid->nodes[0] + place[0];
}

/* Arrival time where the front comes at time t[k] from a way h[k] along axis k; infinite
 * times are no arrival. */
static double arrival(const double t[2], const double h[2])
{
  int first = t[0] <= t[1] ? 0 : 1, second = 1 - first;
  double alone = t[first] + h[first];
  if (!(t[second] < alone))
    return alone;
  double a = 1 / (h[0] * h[0]), b = 1 / (h[1] * h[1]);
  double mean = (a * t[0] + b * t[1]) / (a + b), gap = t[0] - t[1];
  double rest = (1 - a * b / (a + b) * gap * gap) / (a + b);
  return rest > 0 ? mean + sqrt(rest) : alone;
}

/* Time at which the front of a cluster arrives at a node from its neighbours that are
 * already that cluster's, or infinity. Towards a node in the cluster the way ends at the
 * zero set. */
static double front_at(const fg__territories *land, int x, int y, int cluster)
{
  const fg__component_grid *grid = &land->grid;
  int node = y * grid->nodes[0] + x;
  double t[2] = {HUGE_VAL, HUGE_VAL}, h[2] = {land->spacing[0], land->spacing[1]};
  for (int k = 0; k < DIRECTIONS; k++) {
    int next = neighbour(grid, x, y, k), axis = k / 2;
    if (next < 0 || land->owner[next] != cluster)
      continue;
    double way = land->spacing[axis], start = land->distance[next];
    if (land->label[next] == cluster && grid->u[node] <= 0) {
      double u = (double)grid->u[node], v = (double)grid->u[next];
      way *= fmax(u / (u - v), NEAREST);
    }
    if (start + way < t[axis] + h[axis] || t[axis] == HUGE_VAL) {
      t[axis] = start;
      h[axis] = way;
    }
  }
  return t[0] < HUGE_VAL || t[1] < HUGE_VAL ? arrival(t, h) : HUGE_VAL;
}

/* Offers the front at a node to its neighbours. */
static bool spread(fg__territories *land, fg__heap *heap, int node)
{
  const fg__component_grid *grid = &land->grid;
  int x = node % grid->nodes[0], y = node / grid->nodes[0], cluster = land->owner[node];
  for (int k = 0; k < DIRECTIONS; k++) {
    int next = neighbour(grid, x, y, k);
    if (next < 0 || land->label[next] > 0 || land->distance[next] <= land->distance[node])
      continue;
    double time = front_at(land, next % grid->nodes[0], next / grid->nodes[0], cluster);
    if (!(time < land->distance[next]))
      continue;
    land->distance[next] = time;
    land->owner[next] = cluster;
    if (!fg__heap_push(heap, time, next))
      return false;
  }
  return true;
}

static double domain_area(const fg__component_grid *grid)
{
  double cells = 0;
  int last[2];
  for (int k = 0; k < 2; k++)
    last[k] = grid->periodic[k] ? grid->nodes[k] : grid->nodes[k] - 1;
  for (int y = 0; y < last[1]; y++)
    for (int x = 0; x < last[0]; x++)
      cells += fg__components_cell_active(grid, x, y);
  return cells;
}

fg_status fg__territories_create(fg__territories *out, fg_context *context,
                                 const fg_density_arrays *density,
                                 const fg__labels *labels)
{
  *out =
      (fg__territories){.grid = {.nodes = {density->nodes[0], density->nodes[1]},
                                 .periodic = {density->periodic[0], density->periodic[1]},
                                 .u = density->u,
                                 .active = density->active},
                        .label = labels->label,
                        .origin = {density->origin[0], density->origin[1]},
                        .spacing = {density->spacing[0], density->spacing[1]}};
  size_t nodes = (size_t)density->nodes[0] * (size_t)density->nodes[1];
  fg__heap heap = {0};
  fg_status status = FG_STATUS_OK;
  out->owner = fg__allocate(nodes, sizeof *out->owner);
  out->distance = fg__allocate(nodes, sizeof *out->distance);
  bool room = out->owner && out->distance;
  if (room)
    for (size_t k = 0; k < nodes; k++) {
      out->owner[k] = labels->label[k] > 0 ? labels->label[k] : 0;
      out->distance[k] = labels->label[k] > 0 ? 0 : HUGE_VAL;
    }
  for (size_t k = 0; k < nodes && room; k++)
    if (labels->label[k] > 0)
      room = spread(out, &heap, (int)k);
  while (room && heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&heap);
    if (next.key <= out->distance[next.index])
      room = spread(out, &heap, next.index);
  }
  if (!room) {
    status = fg__fail_memory(context, "the territories of clusters",
                             nodes * (sizeof *out->owner + sizeof *out->distance));
    fg__territories_clear(out);
  } else {
    double cells = domain_area(&out->grid);
    out->fair_share = sqrt(cells * out->spacing[0] * out->spacing[1] /
                           (labels->count > 0 ? labels->count : 1));
  }
  fg__heap_clear(&heap);
  return status;
}

void fg__territories_clear(fg__territories *territories)
{
  free(territories->owner);
  free(territories->distance);
  *territories = (fg__territories){0};
}

/* Level of a node: how much later the nearest other front arrives than the cluster's own,
 * or the other way round, in a band of one spacing to either side of the border. */
static double level_at(const fg__territories *land, int x, int y, int cluster)
{
  const fg__component_grid *grid = &land->grid;
  int node = y * grid->nodes[0] + x, owner = land->owner[node];
  double band = fmin(land->spacing[0], land->spacing[1]), least = NEAREST * band;
  double level = band;
  for (int k = 0; k < DIRECTIONS; k++) {
    int next = neighbour(grid, x, y, k);
    int other = next < 0 ? 0 : land->owner[next];
    if (other == 0 || other == owner || (owner != cluster && other != cluster))
      continue;
    double later = front_at(land, x, y, other) - land->distance[node];
    level = fmin(level, fmax(later, least));
  }
  return owner == cluster ? level : -level;
}

/* The nodes to look at: first and last. They stay in the domain: a map ends at a periodic
 * border, whose node is both the first and the one after the last. */
static void find_reach(const fg__territories *land, const double center[2], double reach,
                       int bounds[4])
{
  for (int k = 0; k < 2; k++) {
    int nodes = land->grid.nodes[k];
    double middle = (center[k] - land->origin[k]) / land->spacing[k];
    double half = fmin(reach / land->spacing[k], nodes);
    int last = land->grid.periodic[k] ? nodes : nodes - 1;
    bounds[2 * k] = (int)ceil(fmax(middle - half, 0));
    bounds[2 * k + 1] = (int)floor(fmin(middle + half, last));
  }
}

/* Narrows the bounds to the territory and a rim. */
static void find_land(const fg__territories *land, int cluster, int bounds[4])
{
  const int *nodes = land->grid.nodes;
  int found[4] = {bounds[1], bounds[0], bounds[3], bounds[2]};
  for (int y = bounds[2]; y <= bounds[3]; y++)
    for (int x = bounds[0]; x <= bounds[1]; x++)
      if (land->owner[fg__cut_wrap(y, nodes[1]) * nodes[0] + fg__cut_wrap(x, nodes[0])] ==
          cluster) {
        found[0] = x < found[0] ? x : found[0];
        found[1] = x > found[1] ? x : found[1];
        found[2] = y < found[2] ? y : found[2];
        found[3] = y > found[3] ? y : found[3];
      }
  for (int k = 0; k < 2; k++) {
    int first = found[2 * k] - RIM, last = found[2 * k + 1] + RIM;
    bounds[2 * k] = first > bounds[2 * k] ? first : bounds[2 * k];
    bounds[2 * k + 1] = last < bounds[2 * k + 1] ? last : bounds[2 * k + 1];
  }
}

fg_status fg__territory_window(fg__window *out, fg_context *context,
                               const fg__territories *land, int cluster,
                               const double center[2], double reach)
{
  *out = (fg__window){.cluster = cluster, .at_border = {true, true, true, true}};
  int bounds[4];
  find_reach(land, center, reach, bounds);
  find_land(land, cluster, bounds);
  for (int k = 0; k < 2; k++) {
    int count = bounds[2 * k + 1] - bounds[2 * k] + 1;
    out->nodes[k] = count > 2 ? count : 2;
    out->spacing[k] = land->spacing[k];
    out->origin[k] = land->origin[k] + bounds[2 * k] * land->spacing[k];
  }
  fg_status status = fg__window_allocate(out, context);
  if (status)
    return status;
  const int *size = land->grid.nodes;
  float *level = out->level;
  unsigned char *active = out->active;
  for (int j = 0; j < out->nodes[1]; j++)
    for (int i = 0; i < out->nodes[0]; i++) {
      int x = fg__cut_wrap(bounds[0] + i, size[0]),
          y = fg__cut_wrap(bounds[2] + j, size[1]);
      *level++ = (float)level_at(land, x, y, cluster);
      if (i < out->nodes[0] - 1 && j < out->nodes[1] - 1)
        *active++ = fg__components_cell_active(&land->grid, x, y);
    }
  return FG_STATUS_OK;
}
