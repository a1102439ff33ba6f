#include "cluster/unwrap.h"

#include <stdlib.h>

#include "base/memory.h"

static int depth_of(const fg__component_grid *grid)
{
  return grid->nodes[2] > 1 ? grid->nodes[2] : 1;
}

fg_status fg__unwrap_create(fg__unwrap *out, fg_context *context,
                            const fg__component_grid *grid, const int *label)
{
  size_t nodes = (size_t)grid->nodes[0] * (size_t)grid->nodes[1] * (size_t)depth_of(grid);
  *out = (fg__unwrap){.grid = grid, .label = label};
  out->place = fg__allocate(nodes, sizeof *out->place);
  out->seen = fg__allocate(nodes, 1);
  out->queue = fg__allocate(nodes, sizeof *out->queue);
  if (out->place && out->seen && out->queue)
    return FG_STATUS_OK;
  fg__unwrap_clear(out);
  return fg__fail_memory(context, "clusters across a periodic boundary",
                         nodes * (sizeof *out->place + sizeof *out->queue + 1));
}

void fg__unwrap_clear(fg__unwrap *unwrap)
{
  free(unwrap->place);
  free(unwrap->seen);
  free(unwrap->queue);
  *unwrap = (fg__unwrap){0};
}

static int wrap(int index, int period)
{
  return index < 0 ? index + period : index >= period ? index - period : index;
}

/* The node at `place`, which may lie a step beyond a periodic boundary; -1: there is
 * none.
 */
static int node_at(const fg__component_grid *grid, const int place[3])
{
  int at[3];
  for (int k = 0; k < 3; ++k) {
    int count = k == 2 ? depth_of(grid) : grid->nodes[k];
    if (!grid->periodic[k] && (place[k] < 0 || place[k] >= count))
      return -1;
    at[k] = wrap(place[k], count);
  }
  return (at[2] * grid->nodes[1] + at[1]) * grid->nodes[0] + at[0];
}

/* Whether the cell whose lowest corner is `place` is part of the domain. */
static bool cell_active(const fg__component_grid *grid, const int place[3])
{
  if (depth_of(grid) == 1)
    return place[2] == 0 && fg__components_cell_active(grid, place[0], place[1]);
  size_t at[3], cells[3];
  for (int k = 0; k < 3; ++k) {
    int count = grid->periodic[k] ? grid->nodes[k] : grid->nodes[k] - 1;
    if (!grid->periodic[k] && (place[k] < 0 || place[k] >= count))
      return false;
    at[k] = (size_t)wrap(place[k], count);
    cells[k] = (size_t)count;
  }
  return !grid->active || grid->active[(at[2] * cells[1] + at[1]) * cells[0] + at[0]];
}

/* Whether an active cell holds both nodes, a step apart along one or two axes. */
static bool share_cell(const fg__component_grid *grid, const int from[3],
                       const int step[3])
{
  int low[3], high[3], at[3];
  for (int k = 0; k < 3; ++k) {
    high[k] = step[k] < 0 ? from[k] - 1 : from[k];
    low[k] = step[k] == 0 ? from[k] - 1 : high[k];
  }
  for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
    for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
      for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
        if (cell_active(grid, at))
          return true;
  return false;
}

/* The node a step away, or -1 when the two are not joined directly: along an edge, or
 * across a face (component/components.h). */
static int joined_node(const fg__unwrap *unwrap, const int from[3], const int step[3])
{
  const fg__component_grid *grid = unwrap->grid;
  const int to[3] = {from[0] + step[0], from[1] + step[1], from[2] + step[2]};
  int node = node_at(grid, from), next = node_at(grid, to);
  if (next < 0 || unwrap->label[node] != unwrap->label[next] ||
      !share_cell(grid, from, step))
    return -1;
  int axis = step[0] ? 0 : 1; /* of two, the first */
  if ((step[0] != 0) + (step[1] != 0) + (step[2] != 0) == 1)
    return next;
  int one[3] = {from[0], from[1], from[2]}, other[3] = {to[0], to[1], to[2]};
  one[axis] = to[axis];
  other[axis] = from[axis];
  bool joined = fg__components_saddle_joins(grid->u[node], grid->u[node_at(grid, one)],
                                            grid->u[node_at(grid, other)], grid->u[next]);
  return joined ? next : -1;
}

static void place_of(const fg__component_grid *grid, int node, int place[3])
{
  place[0] = node % grid->nodes[0];
  place[1] = node / grid->nodes[0] % grid->nodes[1];
  place[2] = node / grid->nodes[0] / grid->nodes[1];
}

/* Breadth first from `first`; returns how many nodes were met. */
static int flood(fg__unwrap *unwrap, int first, int bounds[6], bool closed[3])
{
  const fg__component_grid *grid = unwrap->grid;
  int tail = 0, reach = depth_of(grid) > 1;
  unwrap->seen[first] = 1;
  place_of(grid, first, unwrap->place[first]);
  unwrap->queue[tail++] = first;
  for (int head = 0; head < tail; ++head) {
    int from[3], step[3];
    const int *place = unwrap->place[unwrap->queue[head]];
    place_of(grid, unwrap->queue[head], from);
    for (int k = 0; k < 3; ++k) {
      bounds[2 * k] = place[k] < bounds[2 * k] ? place[k] : bounds[2 * k];
      bounds[2 * k + 1] = place[k] > bounds[2 * k + 1] ? place[k] : bounds[2 * k + 1];
    }
    for (step[2] = -reach; step[2] <= reach; ++step[2])
      for (step[1] = -1; step[1] <= 1; ++step[1])
        for (step[0] = -1; step[0] <= 1; ++step[0]) {
          int apart = (step[0] != 0) + (step[1] != 0) + (step[2] != 0);
          int next = apart == 0 || apart == 3 ? -1 : joined_node(unwrap, from, step);
          if (next < 0)
            continue;
          int *of_next = unwrap->place[next];
          if (!unwrap->seen[next]) {
            unwrap->seen[next] = 1;
            for (int k = 0; k < 3; ++k)
              of_next[k] = place[k] + step[k];
            unwrap->queue[tail++] = next;
          }
          for (int k = 0; k < 3; ++k)
            closed[k] = closed[k] || of_next[k] != place[k] + step[k];
        }
  }
  return tail;
}

/* The column, row or plane across an axis where the cluster has fewest nodes. */
static int thinnest(const fg__unwrap *unwrap, int cluster, int axis)
{
  const fg__component_grid *grid = unwrap->grid;
  size_t stride[3] = {1, (size_t)grid->nodes[0],
                      (size_t)grid->nodes[0] * (size_t)grid->nodes[1]};
  int count[3] = {grid->nodes[0], grid->nodes[1], depth_of(grid)};
  int one = axis == 0 ? 1 : 0, other = axis == 2 ? 1 : 2;
  int best = 0, fewest = -1;
  for (int k = 0; k < count[axis]; ++k) {
    int nodes = 0;
    for (int m = 0; m < count[other]; ++m)
      for (int n = 0; n < count[one]; ++n)
        nodes += unwrap->label[(size_t)k * stride[axis] + (size_t)m * stride[other] +
                               (size_t)n * stride[one]] == cluster;
    if (fewest < 0 || nodes < fewest) {
      fewest = nodes;
      best = k;
    }
  }
  return best;
}

void fg__unwrap_bounds(fg__unwrap *unwrap, int first, int bounds[6], bool closed[3])
{
  const fg__component_grid *grid = unwrap->grid;
  int place[3];
  place_of(grid, first, place);
  for (int k = 0; k < 3; ++k) {
    bounds[2 * k] = bounds[2 * k + 1] = place[k];
    closed[k] = false;
  }
  int met = flood(unwrap, first, bounds, closed);
  for (int k = 0; k < met; ++k)
    unwrap->seen[unwrap->queue[k]] = 0;
  for (int k = 0; k < 3; ++k) {
    int period = grid->nodes[k];
    if (closed[k]) {
      bounds[2 * k] = thinnest(unwrap, unwrap->label[first], k);
      bounds[2 * k + 1] = bounds[2 * k] + period;
    }
    while (bounds[2 * k] < 0) {
      bounds[2 * k] += period;
      bounds[2 * k + 1] += period;
    }
  }
}
