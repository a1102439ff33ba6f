#include "skeleton/hole.h"

#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"

/* What is not cluster, on a raster of twice the resolution: nodes at even places, the
 * edges between them and the centres of cells at odd ones, and a rim that is always
 * outside. On it the rest of the plane is joined along the axes only. */
typedef struct complement {
  int width, height;
  unsigned char *open; /* 1: not cluster; 2: seen */
  int *queue;
} complement;

static bool inside(const fg__graph *graph, int x, int y)
{
  return graph->window->level[y * graph->window->nodes[0] + x] > 0.0F;
}

static bool joined(const fg__graph *graph, int x, int y, int direction)
{
  return graph->joined[y * graph->window->nodes[0] + x] >> direction & 1;
}

/* x and y count half nodes from the window's first node. */
static bool is_cluster(const fg__graph *graph, int x, int y)
{
  int node_x = x / 2;
  int node_y = y / 2;
  if (x % 2 == 0 && y % 2 == 0)
    return inside(graph, node_x, node_y);
  if (y % 2 == 0)
    return joined(graph, node_x, node_y, 0);
  if (x % 2 == 0)
    return joined(graph, node_x, node_y, 1);
  const fg__window *window = graph->window;
  if (!window->active[node_y * (window->nodes[0] - 1) + node_x])
    return false;
  int corners = inside(graph, node_x, node_y) + inside(graph, node_x + 1, node_y) +
                inside(graph, node_x, node_y + 1) + inside(graph, node_x + 1, node_y + 1);
  if (corners != 2)
    return corners == 4;
  return (inside(graph, node_x, node_y) && joined(graph, node_x, node_y, 4)) ||
         (inside(graph, node_x + 1, node_y) && joined(graph, node_x + 1, node_y, 5));
}

static void fill_rest(complement *rest, const fg__graph *graph)
{
  for (int y = 0; y < rest->height; ++y) {
    for (int x = 0; x < rest->width; ++x) {
      bool rim = x == 0 || y == 0 || x == rest->width - 1 || y == rest->height - 1;
      rest->open[y * rest->width + x] = rim || !is_cluster(graph, x - 1, y - 1);
    }
  }
}

/* Marks all that hangs together with a place; returns how much that is. */
static int flood(complement *rest, const fg__graph *graph, int start)
{
  int tail = 0;
  rest->open[start] = 2;
  rest->queue[tail++] = start;
  for (int head = 0; head < tail; ++head) {
    int x = rest->queue[head] % rest->width;
    int y = rest->queue[head] / rest->width;
    for (int k = 0; k < 4; ++k) {
      int next_x = x + graph->step[k][0];
      int next_y = y + graph->step[k][1];
      if (next_x < 0 || next_y < 0 || next_x >= rest->width || next_y >= rest->height)
        continue;
      int next = next_y * rest->width + next_x;
      if (rest->open[next] != 1)
        continue;
      rest->open[next] = 2;
      rest->queue[tail++] = next;
    }
  }
  return tail;
}

/* The rightmost centre of a cell among the places just flooded. */
static void rightmost_cell(const complement *rest, int places, int cell[2])
{
  cell[0] = cell[1] = -1;
  for (int k = 0; k < places; ++k) {
    int x = rest->queue[k] % rest->width - 1;
    int y = rest->queue[k] / rest->width - 1;
    if (x % 2 == 1 && y % 2 == 1 && x / 2 > cell[0]) {
      cell[0] = x / 2;
      cell[1] = y / 2;
    }
  }
}

fg_status fg__hole_find(int cell[2], fg_context *context, const fg__graph *graph)
{
  cell[0] = cell[1] = -1;
  complement rest = {.width = 2 * graph->window->nodes[0] + 1,
                     .height = 2 * graph->window->nodes[1] + 1};
  size_t places = (size_t)rest.width * (size_t)rest.height;
  rest.open = fg__allocate(places, 1);
  rest.queue = fg__allocate(places, sizeof *rest.queue);
  fg_status status = FG_STATUS_OK;
  if (!rest.open || !rest.queue) {
    status = fg__fail_memory(context, "holes of a cluster", places * sizeof(int));
    goto cleanup;
  }
  fill_rest(&rest, graph);
  flood(&rest, graph, 0);
  int largest = 0;
  for (int k = 0; k < (int)places; ++k) {
    if (rest.open[k] != 1)
      continue;
    int size = flood(&rest, graph, k);
    if (size > largest) {
      largest = size;
      rightmost_cell(&rest, size, cell);
    }
  }

cleanup:
  free(rest.open);
  free(rest.queue);
  return status;
}
