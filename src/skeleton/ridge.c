#include "skeleton/ridge.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/graph.h"
#include "skeleton/hole.h"

void fg__ridge_clear(fg__ridge *ridge)
{
  free(ridge->node);
  *ridge = (fg__ridge){0};
}

/* Copies the path that the last search found to a state, from its end to its start. */
static fg_status copy_path(fg__ridge *ridge, fg_context *context, const fg__graph *graph,
                           int state)
{
  size_t count = 0;
  for (int k = state; k >= 0; k = graph->from[k])
    ++count;
  free(ridge->node);
  ridge->node = fg__allocate(count, sizeof *ridge->node);
  if (!ridge->node)
    return fg__fail_memory(context, "the ridge of a cluster", count * sizeof(int));
  ridge->count = 0;
  for (int k = state; k >= 0; k = graph->from[k])
    ridge->node[ridge->count++] = k % graph->nodes;
  return FG_STATUS_OK;
}

static int farthest_inside(const fg__graph *graph, const double *distance)
{
  int best = -1;
  for (int k = 0; k < graph->nodes; ++k) {
    if (graph->window->level[k] > 0.0F && (best < 0 || distance[k] > distance[best]))
      best = k;
  }
  return best;
}

/* The ends are found as in a tree: what is farthest from anywhere is an end of a longest
 * path, what is farthest from there the other. */
static fg_status find_open_path(fg__ridge *ridge, fg_context *context, fg__graph *graph,
                                int middle, double *length)
{
  int ends[2];
  fg_status status = fg__graph_search(graph, context, middle, -1, false, &ends[0]);
  if (!status)
    status = fg__graph_search(graph, context, ends[0], -1, false, &ends[1]);
  int reached;
  if (!status)
    status = fg__graph_search(graph, context, ends[0], ends[1], true, &reached);
  if (status)
    return status;
  *length = fg__graph_length(graph, reached);
  return copy_path(ridge, context, graph, reached);
}

/* Among the edges that the ray crosses before it leaves the cluster again, a node of the
 * one farthest from the boundary: every way round the hole comes by there. */
static int first_on_ray(const fg__graph *graph, const double *distance)
{
  int width = graph->window->nodes[0];
  int best = -1;
  double most = -1.0;
  for (int x = graph->cut_x + 1; x < width; ++x) {
    int node = graph->cut_y * width + x;
    if (!(graph->joined[node] >> 1 & 1)) {
      if (best >= 0)
        break;
      continue;
    }
    double least = fmin(distance[node], distance[node + width]);
    if (least > most) {
      most = least;
      best = node;
    }
  }
  return best;
}

/* The node in the middle of the path that the last search found to a state. */
static int half_way(const fg__graph *graph, int state)
{
  int count = 0;
  for (int k = state; k >= 0; k = graph->from[k])
    ++count;
  int k = state;
  for (int left = count / 2; left > 0 && graph->from[k] >= 0; --left)
    k = graph->from[k];
  return k % graph->nodes;
}

/* Replaces the path by a closed one round the largest hole, where there is one at least
 * `length` long. */
static fg_status find_closed_path(fg__ridge *ridge, fg_context *context, fg__graph *graph,
                                  const double *distance, double length)
{
  int cell[2];
  fg_status status = fg__hole_find(cell, context, graph);
  if (status || cell[0] < 0)
    return status;
  graph->cut_x = cell[0];
  graph->cut_y = cell[1];
  int node = first_on_ray(graph, distance);
  if (node < 0)
    return FG_STATUS_OK;
  /* the first node may lie off the ridge; one half way round lies on it */
  int target = node;
  for (int round = 0; round < 2; ++round) {
    int reached;
    status = fg__graph_search(graph, context, node, node + graph->nodes, true, &reached);
    if (status || reached != node + graph->nodes)
      return status;
    target = reached;
    if (round == 0)
      node = half_way(graph, target);
  }
  if (fg__graph_length(graph, target) < length)
    return FG_STATUS_OK;
  status = copy_path(ridge, context, graph, target);
  if (status)
    return status;
  ridge->closed = true;
  --ridge->count; /* the first node again */
  return FG_STATUS_OK;
}

fg_status fg__ridge_create(fg__ridge *out, fg_context *context, const fg__window *window,
                           const double *distance)
{
  *out = (fg__ridge){0};
  fg__graph graph;
  fg_status status = fg__graph_create(&graph, context, window, distance);
  if (status)
    return status;
  int middle = farthest_inside(&graph, distance);
  double length = 0.0;
  if (middle < 0)
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "ridge: the window of cluster %d is empty", window->cluster);
  if (!status)
    status = find_open_path(out, context, &graph, middle, &length);
  if (!status && window->dimension == 2 && fg__graph_holes(&graph) > 0)
    status = find_closed_path(out, context, &graph, distance, length);
  if (status)
    fg__ridge_clear(out);
  fg__graph_clear(&graph);
  return status;
}
