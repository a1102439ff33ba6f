#include "cluster/unwrap.h"

#include <stdlib.h>

#include "base/memory.h"

fg_status fg__unwrap_create(fg__unwrap *out, fg_context *context,
                            const fg__component_grid *grid, const int *label)
{
  size_t nodes = (size_t)grid->nodes[0] * (size_t)grid->nodes[1];
  *out = (fg__unwrap){.grid = grid, .label = label};
  out->place = fg__allocate(nodes, sizeof *out->place);
  out->seen = fg__allocate(nodes, 1);
  out->queue = fg__allocate(nodes, sizeof *out->queue);
  if (out->place && out->seen && out->queue)
    return FG_STATUS_OK;
  fg__unwrap_clear(out);
  return fg__fail_memory(context, "clusters across a periodic border",
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

/* The node one step away from node (x, y), or -1 when the two are not joined directly. */
static int joined_node(const fg__unwrap *unwrap, int x, int y, int dx, int dy)
{
  const fg__component_grid *grid = unwrap->grid;
  int width = grid->nodes[0];
  int height = grid->nodes[1];
  if (!grid->periodic[0] && (x + dx < 0 || x + dx >= width))
    return -1;
  if (!grid->periodic[1] && (y + dy < 0 || y + dy >= height))
    return -1;
  int next_x = wrap(x + dx, width);
  int next_y = wrap(y + dy, height);
  int node = y * width + x;
  int next = next_y * width + next_x;
  if (unwrap->label[node] != unwrap->label[next])
    return -1;
  int edge_x = dx < 0 ? next_x : x; /* lower left end of the edge, or of the cell */
  int edge_y = dy < 0 ? next_y : y;
  if (dx == 0 || dy == 0)
    return fg__components_edge_active(grid, edge_x, edge_y, dx == 0) ? next : -1;
  bool joined = fg__components_cell_active(grid, edge_x, edge_y) &&
                fg__components_saddle_joins(grid->u[node], grid->u[y * width + next_x],
                                            grid->u[next_y * width + x], grid->u[next]);
  return joined ? next : -1;
}

/* Breadth first from `first`; returns how many nodes were met. */
static int flood(fg__unwrap *unwrap, int first, int bounds[4], bool closed[2])
{
  int width = unwrap->grid->nodes[0];
  int tail = 0;
  unwrap->seen[first] = 1;
  unwrap->place[first][0] = first % width;
  unwrap->place[first][1] = first / width;
  unwrap->queue[tail++] = first;
  for (int head = 0; head < tail; ++head) {
    int node = unwrap->queue[head];
    const int *place = unwrap->place[node];
    for (int k = 0; k < 2; ++k) {
      if (place[k] < bounds[2 * k])
        bounds[2 * k] = place[k];
      if (place[k] > bounds[2 * k + 1])
        bounds[2 * k + 1] = place[k];
    }
    for (int step = 0; step < 9; ++step) {
      int dx = step % 3 - 1;
      int dy = step / 3 - 1;
      int next = step == 4 ? -1 : joined_node(unwrap, node % width, node / width, dx, dy);
      if (next < 0)
        continue;
      if (!unwrap->seen[next]) {
        unwrap->seen[next] = 1;
        unwrap->place[next][0] = place[0] + dx;
        unwrap->place[next][1] = place[1] + dy;
        unwrap->queue[tail++] = next;
      }
      closed[0] = closed[0] || unwrap->place[next][0] != place[0] + dx;
      closed[1] = closed[1] || unwrap->place[next][1] != place[1] + dy;
    }
  }
  return tail;
}

/* The column (axis 0) or row (axis 1) where the cluster has fewest nodes. */
static int thinnest(const fg__unwrap *unwrap, int cluster, int axis)
{
  size_t width = (size_t)unwrap->grid->nodes[0];
  size_t along = axis == 0 ? width : 1;
  size_t stride = axis == 0 ? 1 : width;
  int best = 0;
  int fewest = -1;
  for (int k = 0; k < unwrap->grid->nodes[axis]; ++k) {
    int nodes = 0;
    for (int m = 0; m < unwrap->grid->nodes[1 - axis]; ++m)
      nodes += unwrap->label[(size_t)k * stride + (size_t)m * along] == cluster;
    if (fewest < 0 || nodes < fewest) {
      fewest = nodes;
      best = k;
    }
  }
  return best;
}

void fg__unwrap_bounds(fg__unwrap *unwrap, int first, int bounds[4], bool closed[2])
{
  int width = unwrap->grid->nodes[0];
  bounds[0] = bounds[1] = first % width;
  bounds[2] = bounds[3] = first / width;
  closed[0] = closed[1] = false;
  int met = flood(unwrap, first, bounds, closed);
  for (int k = 0; k < met; ++k)
    unwrap->seen[unwrap->queue[k]] = 0;
  for (int k = 0; k < 2; ++k) {
    int period = unwrap->grid->nodes[k];
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
