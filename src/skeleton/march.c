#include "skeleton/spine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/border.h"
#include "skeleton/heap.h"
#include "skeleton/upwind.h"

/* Fast marching: J. A. Sethian, "A fast marching level set method for monotonically
 * advancing fronts", PNAS 93 (1996); the stencil with second order one-sided differences:
 * Sethian, "Fast marching methods", SIAM Review 41 (1999). */

enum state { OUTSIDE, FAR, KNOWN };

typedef struct march {
  const fg__window *window;
  double *distance;
  unsigned char *state; /* of the nodes */
  fg__heap heap;
} march;

/* The node `step` nodes on along an axis, or -1 when no active cell leads there or the
 * front has not arrived. */
static int known_neighbour(const march *front, int x, int y, int axis, int step)
{
  const fg__window *window = front->window;
  int place[2] = {x, y};
  place[axis] += step;
  if (place[axis] < 0 || place[axis] >= window->nodes[axis])
    return -1;
  int node = place[1] * window->nodes[0] + place[0];
  if (front->state[node] != KNOWN)
    return -1;
  bool joined = fg__window_edge_active(window, step > 0 ? x : place[0],
                                       step > 0 ? y : place[1], axis);
  return joined ? node : -1;
}

/* Returns false when the front has not reached the node along this axis. */
static bool look_upwind(const march *front, int x, int y, int axis, bool second_order,
                        fg__upwind *out)
{
  int best = -1;
  int side = 0;
  for (int step = -1; step <= 1; step += 2) {
    int node = known_neighbour(front, x, y, axis, step);
    if (node >= 0 && (best < 0 || front->distance[node] < front->distance[best])) {
      best = node;
      side = step;
    }
  }
  if (best < 0)
    return false;
  double h = front->window->spacing[axis];
  double near = front->distance[best];
  *out = (fg__upwind){1.0 / (h * h), near, near};
  if (!second_order)
    return true;
  int behind = known_neighbour(front, axis == 0 ? x + side : x, axis == 1 ? y + side : y,
                               axis, side);
  if (behind >= 0 && front->distance[behind] <= near) {
    out->weight *= 2.25;
    out->value = (4.0 * near - front->distance[behind]) / 3.0;
  }
  return true;
}

static double arrival(const march *front, int x, int y)
{
  for (int order = 2; order >= 1; --order) {
    fg__upwind term[2];
    int terms = 0;
    for (int axis = 0; axis < 2; ++axis)
      terms += look_upwind(front, x, y, axis, order == 2, &term[terms]);
    double value;
    if (terms > 0 && fg__upwind_solve(term, terms, &value))
      return value;
    double best = HUGE_VAL;
    for (int k = 0; order == 1 && k < terms; ++k) {
      if (fg__upwind_solve(&term[k], 1, &value))
        best = fmin(best, value);
    }
    if (order == 1)
      return best;
  }
  return HUGE_VAL;
}

/* Renews the four neighbours of a node that has just become known. */
static bool renew_neighbours(march *front, int node)
{
  const fg__window *window = front->window;
  int x = node % window->nodes[0];
  int y = node / window->nodes[0];
  static const int step_x[4] = {-1, 1, 0, 0};
  static const int step_y[4] = {0, 0, -1, 1};
  for (int k = 0; k < 4; ++k) {
    int next_x = x + step_x[k];
    int next_y = y + step_y[k];
    if (next_x < 0 || next_x >= window->nodes[0] || next_y < 0 ||
        next_y >= window->nodes[1])
      continue;
    int next = next_y * window->nodes[0] + next_x;
    if (front->state[next] != FAR)
      continue;
    double value = arrival(front, next_x, next_y);
    if (value < front->distance[next]) {
      front->distance[next] = value;
      if (!fg__heap_push(&front->heap, value, next))
        return false;
    }
  }
  return true;
}

/* The nodes inside start with their distance from the border next to them, which is final
 * up to one spacing. */
static bool start(march *front, double exact)
{
  int nodes = front->window->nodes[0] * front->window->nodes[1];
  for (int k = 0; k < nodes; ++k) {
    if (!(front->window->level[k] > 0.0F)) {
      front->distance[k] = 0.0;
      continue;
    }
    front->state[k] = front->distance[k] <= exact ? KNOWN : FAR;
    if (isfinite(front->distance[k]) &&
        !fg__heap_push(&front->heap, front->distance[k], k))
      return false;
  }
  return true;
}

fg_status fg__march(double *distance, fg_context *context, const fg__window *window,
                    bool domain_border_counts)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  march front = {.window = window, .distance = distance};
  front.state = fg__allocate(nodes, 1);
  if (!front.state)
    return fg__fail_memory(context, "fast marching", nodes);
  fg__border_distance(distance, window, domain_border_counts);
  double exact = fmin(window->spacing[0], window->spacing[1]);
  bool room = start(&front, exact);
  if (room && front.heap.count == 0) { /* the cluster is the whole domain */
    fg__border_distance(distance, window, true);
    room = start(&front, exact);
  }
  while (room && front.heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&front.heap);
    if (next.key > distance[next.index])
      continue;
    front.state[next.index] = KNOWN;
    room = renew_neighbours(&front, next.index);
  }
  fg_status status = FG_STATUS_OK;
  if (!room)
    status = fg__fail_memory(context, "fast marching", front.heap.capacity);
  free(front.state);
  fg__heap_clear(&front.heap);
  return status;
}
