#include "skeleton/graph.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "component/components.h"

const int fg__graph_step[FG__GRAPH_DIRECTIONS][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                                     {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

static bool positive(const fg__graph *graph, int x, int y)
{
  const fg__window *window = graph->window;
  return x >= 0 && y >= 0 && x < window->nodes[0] && y < window->nodes[1] &&
         window->level[y * window->nodes[0] + x] > 0.0F;
}

static bool is_joined(const fg__graph *graph, int x, int y, const int step[2])
{
  const fg__window *window = graph->window;
  int width = window->nodes[0];
  int next_x = x + step[0];
  int next_y = y + step[1];
  if (!positive(graph, next_x, next_y))
    return false;
  int low_x = step[0] < 0 ? next_x : x;
  int low_y = step[1] < 0 ? next_y : y;
  if (step[0] == 0 || step[1] == 0)
    return fg__window_edge_active(window, low_x, low_y, step[0] == 0);
  if (!window->active[low_y * (width - 1) + low_x])
    return false;
  float b = window->level[y * width + next_x];
  float c = window->level[next_y * width + x];
  return b > 0.0F || c > 0.0F ||
         fg__components_saddle_joins(window->level[y * width + x], b, c,
                                     window->level[next_y * width + next_x]);
}

static void set_joined(fg__graph *graph)
{
  int width = graph->window->nodes[0];
  for (int node = 0; node < graph->nodes; ++node) {
    int x = node % width;
    int y = node / width;
    if (!positive(graph, x, y))
      continue;
    for (int k = 0; k < FG__GRAPH_DIRECTIONS; ++k) {
      if (is_joined(graph, x, y, fg__graph_step[k]))
        graph->joined[node] |= (unsigned char)(1U << k);
    }
  }
}

/* A path beside the ridge of a bend is shorter in proportion to 1/radius and meets
 * smaller distances T in proportion to 1/T; since T is at most the radius, a cost of T^-p
 * holds it on the ridge for any p > 1. The fourth power also holds it where the ridge is
 * blunt. A tenth of a cell keeps the cost finite on the border. */
static void set_cost(fg__graph *graph, const double *distance)
{
  const fg__window *window = graph->window;
  double largest = 0.0;
  for (int k = 0; k < graph->nodes; ++k)
    largest = fmax(largest, distance[k]);
  double least = 0.1 * fmin(window->spacing[0], window->spacing[1]);
  for (int k = 0; k < graph->nodes; ++k) {
    double ratio = (largest + least) / (distance[k] + least);
    graph->cost[k] = ratio * ratio * ratio * ratio;
  }
}

fg_status fg__graph_create(fg__graph *out, fg_context *context, const fg__window *window,
                           const double *distance)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  *out = (fg__graph){.window = window, .nodes = (int)nodes, .cut_x = -1, .cut_y = -1};
  out->joined = fg__allocate(nodes, 1);
  out->cost = fg__allocate(nodes, sizeof *out->cost);
  out->total = fg__allocate(2 * nodes, sizeof *out->total);
  out->from = fg__allocate(2 * nodes, sizeof *out->from);
  if (!out->joined || !out->cost || !out->total || !out->from) {
    fg__graph_clear(out);
    return fg__fail_memory(context, "the ridge of a cluster", nodes * sizeof(double));
  }
  set_joined(out);
  set_cost(out, distance);
  return FG_STATUS_OK;
}

void fg__graph_clear(fg__graph *graph)
{
  free(graph->joined);
  free(graph->cost);
  free(graph->total);
  free(graph->from);
  fg__heap_clear(&graph->heap);
  *graph = (fg__graph){0};
}

/* Whether the step from node (x, y) crosses the ray. Beside the hole's own cell the
 * diagonal stands for the way round by the corner that is inside. */
static bool crosses(const fg__graph *graph, int x, int y, const int step[2])
{
  if (graph->cut_y < 0 || step[1] == 0 || (step[1] < 0 ? y - 1 : y) != graph->cut_y)
    return false;
  if (step[0] == 0)
    return x > graph->cut_x;
  int cell = step[0] < 0 ? x - 1 : x;
  if (cell != graph->cut_x)
    return cell > graph->cut_x;
  return positive(graph, cell + 1, graph->cut_y) &&
         positive(graph, cell + 1, graph->cut_y + 1);
}

static double step_length(const fg__graph *graph, int direction)
{
  double h_x = graph->window->spacing[0];
  double h_y = graph->window->spacing[1];
  if (direction >= 4)
    return sqrt(h_x * h_x + h_y * h_y);
  return direction % 2 == 0 ? h_x : h_y;
}

static bool settle(fg__graph *graph, int state, const double *lengths, bool by_cost)
{
  int side = state >= graph->nodes;
  int node = state - side * graph->nodes;
  int width = graph->window->nodes[0];
  int x = node % width;
  int y = node / width;
  for (int k = 0; k < FG__GRAPH_DIRECTIONS; ++k) {
    if (!(graph->joined[node] >> k & 1))
      continue;
    const int *step = fg__graph_step[k];
    int next = node + step[1] * width + step[0];
    double weight = by_cost ? 0.5 * (graph->cost[node] + graph->cost[next]) : 1.0;
    double total = graph->total[state] + weight * lengths[k];
    int next_state = next + (side != crosses(graph, x, y, step) ? graph->nodes : 0);
    if (!(total < graph->total[next_state]))
      continue;
    graph->total[next_state] = total;
    graph->from[next_state] = state;
    if (!fg__heap_push(&graph->heap, total, next_state))
      return false;
  }
  return true;
}

fg_status fg__graph_search(fg__graph *graph, fg_context *context, int source, int target,
                           bool by_cost, int *last)
{
  double lengths[FG__GRAPH_DIRECTIONS];
  for (int k = 0; k < FG__GRAPH_DIRECTIONS; ++k)
    lengths[k] = step_length(graph, k);
  int states = graph->cut_y < 0 ? graph->nodes : 2 * graph->nodes;
  for (int k = 0; k < states; ++k)
    graph->total[k] = HUGE_VAL;
  graph->heap.count = 0;
  graph->total[source] = 0.0;
  graph->from[source] = -1;
  *last = source;
  bool room = fg__heap_push(&graph->heap, 0.0, source);
  while (room && graph->heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&graph->heap);
    if (next.key > graph->total[next.index])
      continue;
    *last = next.index;
    if (next.index == target)
      break;
    room = settle(graph, next.index, lengths, by_cost);
  }
  return room ? FG_STATUS_OK
              : fg__fail_memory(context, "the ridge of a cluster",
                                graph->heap.capacity * sizeof *graph->heap.entry);
}

double fg__graph_length(const fg__graph *graph, int state)
{
  int width = graph->window->nodes[0];
  double length = 0.0;
  for (; graph->from[state] >= 0; state = graph->from[state]) {
    int a = state % graph->nodes;
    int b = graph->from[state] % graph->nodes;
    length += hypot((a % width - b % width) * graph->window->spacing[0],
                    (a / width - b / width) * graph->window->spacing[1]);
  }
  return length;
}

/* A cell all of whose corners are inside fills the loop round it; one joined across its
 * saddle adds an edge. */
static int filled_minus_saddles(const fg__graph *graph)
{
  const fg__window *window = graph->window;
  int width = window->nodes[0];
  int result = 0;
  for (int y = 0; y < window->nodes[1] - 1; ++y) {
    for (int x = 0; x < width - 1; ++x) {
      if (!window->active[y * (width - 1) + x])
        continue;
      bool a = positive(graph, x, y);
      bool b = positive(graph, x + 1, y);
      bool c = positive(graph, x, y + 1);
      bool d = positive(graph, x + 1, y + 1);
      if (a && b && c && d)
        ++result;
      else if (a && d && !b && !c)
        result -= graph->joined[y * width + x] >> 4 & 1;
      else if (b && c && !a && !d)
        result -= graph->joined[y * width + x + 1] >> 5 & 1;
    }
  }
  return result;
}

int fg__graph_holes(const fg__graph *graph)
{
  int nodes_minus_edges = 0;
  for (int k = 0; k < graph->nodes; ++k) {
    if (graph->window->level[k] > 0.0F)
      nodes_minus_edges += 1 - (graph->joined[k] & 1) - (graph->joined[k] >> 1 & 1);
  }
  return 1 - (nodes_minus_edges + filled_minus_saddles(graph));
}
