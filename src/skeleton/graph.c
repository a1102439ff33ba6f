#include "skeleton/graph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "component/components.h"

/* Searches try directions in this order, which decides between paths of the same cost. */
static const int flat_step[8][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                    {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

static void set_directions(fg__graph *graph)
{
  const fg__window *window = graph->window;
  const double *h = window->spacing;
  int count = 0;
  for (int n = 0; n < 8 && window->dimension == 2; ++n, ++count)
    memcpy(graph->step[n], flat_step[n], sizeof flat_step[n]);
  for (int n = 0; n < 27 && window->dimension == 3; ++n) {
    const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    if (n != 13) /* the node itself */
      memcpy(graph->step[count++], step, sizeof step);
  }
  graph->directions = count;
  for (int n = 0; n < count; ++n) {
    const int *step = graph->step[n];
    graph->offset[n] =
        (step[2] * window->nodes[1] + step[1]) * window->nodes[0] + step[0];
    double square = 0.0;
    for (int k = 0; k < 3; ++k)
      square += step[k] * step[k] * h[k] * h[k];
    graph->length[n] = sqrt(square);
  }
}

static bool positive(const fg__graph *graph, int x, int y)
{
  const fg__window *window = graph->window;
  return x >= 0 && y >= 0 && x < window->nodes[0] && y < window->nodes[1] &&
         window->level[y * window->nodes[0] + x] > 0.0F;
}

static bool is_joined(const fg__graph *graph, int x, int y, const int step[3])
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
    return fg__window_edge_active(window, (const int[3]){low_x, low_y, 0}, step[0] == 0);
  if (!window->active[low_y * (width - 1) + low_x])
    return false;
  float b = window->level[y * width + next_x];
  float c = window->level[next_y * width + x];
  return b > 0.0F || c > 0.0F ||
         fg__components_saddle_joins(window->level[y * width + x], b, c,
                                     window->level[next_y * width + next_x]);
}

static bool is_inside(const fg__graph *graph, const int place[3], const int step[3])
{
  const fg__window *window = graph->window;
  int at[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = place[k] + step[k];
    if (at[k] < 0 || at[k] >= window->nodes[k])
      return false;
  }
  return window->level[fg__window_node(window, at[0], at[1], at[2])] > 0.0F;
}

static void set_joined(fg__graph *graph)
{
  const fg__window *window = graph->window;
  for (int node = 0; node < graph->nodes; ++node) {
    int place[3];
    if (!(window->level[node] > 0.0F))
      continue;
    fg__window_place(window, (size_t)node, place);
    for (int n = 0; n < graph->directions; ++n)
      if (window->dimension == 2 ? is_joined(graph, place[0], place[1], graph->step[n])
                                 : is_inside(graph, place, graph->step[n]))
        graph->joined[node] |= 1U << n;
  }
}

/* A path beside the ridge of a bend is shorter in proportion to 1/radius and meets
 * smaller distances T in proportion to 1/T; since T is at most the radius, a cost of T^-p
 * holds it on the ridge for any p > 1. In 2D the fourth power also holds it where the
 * ridge is blunt, and a tenth of a cell keeps the cost finite on the boundary; in 3D the
 * square and a quarter of a cell. (Penalised distance: Sato, Bitter, Bender, Kaufman and
 * Nakajima, "TEASAR", Pacific Graphics 2000.) */
static void set_cost(fg__graph *graph, const double *distance)
{
  bool flat = graph->window->dimension == 2;
  double largest = 0.0, least = (flat ? 0.1 : 0.25) * fg__window_spacing(graph->window);
  for (int k = 0; k < graph->nodes; ++k)
    largest = fmax(largest, distance[k]);
  for (int k = 0; k < graph->nodes; ++k) {
    double ratio = flat ? (largest + least) / (distance[k] + least)
                        : fmax(largest, least) / fmax(distance[k], least);
    graph->cost[k] = flat ? ratio * ratio * ratio * ratio : ratio * ratio;
  }
}

fg_status fg__graph_create(fg__graph *out, fg_context *context, const fg__window *window,
                           const double *distance)
{
  size_t nodes = fg__window_count(window),
         states = window->dimension == 2 ? 2 * nodes : nodes;
  *out = (fg__graph){.window = window, .nodes = (int)nodes, .cut_x = -1, .cut_y = -1};
  out->joined = fg__allocate(nodes, sizeof *out->joined);
  out->cost = fg__allocate(nodes, sizeof *out->cost);
  out->total = fg__allocate(states, sizeof *out->total);
  out->from = fg__allocate(states, sizeof *out->from);
  if (!out->joined || !out->cost || !out->total || !out->from) {
    fg__graph_clear(out);
    return fg__fail_memory(context, "the ridge of a cluster", nodes * sizeof(double));
  }
  set_directions(out);
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
static bool crosses(const fg__graph *graph, int node, const int step[3])
{
  if (graph->cut_y < 0 || step[1] == 0)
    return false;
  int x = node % graph->window->nodes[0], y = node / graph->window->nodes[0];
  if ((step[1] < 0 ? y - 1 : y) != graph->cut_y)
    return false;
  if (step[0] == 0)
    return x > graph->cut_x;
  int cell = step[0] < 0 ? x - 1 : x;
  if (cell != graph->cut_x)
    return cell > graph->cut_x;
  return positive(graph, cell + 1, graph->cut_y) &&
         positive(graph, cell + 1, graph->cut_y + 1);
}

static bool settle(fg__graph *graph, int state, bool by_cost)
{
  int side = state >= graph->nodes;
  int node = state - side * graph->nodes;
  for (int k = 0; k < graph->directions; ++k) {
    if (!(graph->joined[node] >> k & 1))
      continue;
    int next = node + graph->offset[k];
    double weight = by_cost ? 0.5 * (graph->cost[node] + graph->cost[next]) : 1.0;
    double total = graph->total[state] + weight * graph->length[k];
    int next_state =
        next + (side != crosses(graph, node, graph->step[k]) ? graph->nodes : 0);
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
  int states = graph->cut_y < 0 ? graph->nodes : 2 * graph->nodes;
  for (int k = 0; k < states; ++k)
    graph->total[k] = HUGE_VAL;
  graph->heap.count = 0;
  graph->total[source] = 0.0;
  graph->from[source] = -1;
  *last = source;
  bool enough = fg__heap_push(&graph->heap, 0.0, source);
  while (enough && graph->heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&graph->heap);
    if (next.key > graph->total[next.index])
      continue;
    *last = next.index;
    if (next.index == target)
      break;
    enough = settle(graph, next.index, by_cost);
  }
  return enough ? FG_STATUS_OK
                : fg__fail_memory(context, "the ridge of a cluster",
                                  graph->heap.capacity * sizeof *graph->heap.entry);
}

double fg__graph_length(const fg__graph *graph, int state)
{
  const double *h = graph->window->spacing;
  double length = 0.0;
  for (; graph->from[state] >= 0; state = graph->from[state]) {
    int a[3], b[3];
    fg__window_place(graph->window, (size_t)(state % graph->nodes), a);
    fg__window_place(graph->window, (size_t)(graph->from[state] % graph->nodes), b);
    length +=
        hypot(hypot((a[0] - b[0]) * h[0], (a[1] - b[1]) * h[1]), (a[2] - b[2]) * h[2]);
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
        result -= (int)(graph->joined[y * width + x] >> 4 & 1);
      else if (b && c && !a && !d)
        result -= (int)(graph->joined[y * width + x + 1] >> 5 & 1);
    }
  }
  return result;
}

int fg__graph_holes(const fg__graph *graph)
{
  int nodes_minus_edges = 0;
  for (int k = 0; k < graph->nodes; ++k) {
    if (graph->window->level[k] > 0.0F)
      nodes_minus_edges +=
          1 - (int)(graph->joined[k] & 1) - (int)(graph->joined[k] >> 1 & 1);
  }
  return 1 - (nodes_minus_edges + filled_minus_saddles(graph));
}
