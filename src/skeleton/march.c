#include "skeleton/march.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/boundary.h"
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
  ptrdiff_t stride[3]; /* from a node to its next one along each axis */
  bool masked;         /* the window has masked cells */
} march;

/* The neighbour of a node along an axis; -1 when no active cell leads there or the front
 * has not arrived. */
static ptrdiff_t known_neighbour(const march *front, ptrdiff_t node, const int place[3],
                                 int axis, int step)
{
  int at = place[axis] + step;
  if (at < 0 || at >= front->window->nodes[axis])
    return -1;
  ptrdiff_t next = node + step * front->stride[axis];
  if (front->state[next] != KNOWN)
    return -1;
  if (front->masked) {
    int low[3] = {place[0], place[1], place[2]};
    low[axis] = step > 0 ? place[axis] : at;
    if (!fg__window_edge_active(front->window, low, axis))
      return -1;
  }
  return next;
}

/* Returns false when the front has not reached the node along this axis. */
static bool look_upwind(const march *front, ptrdiff_t node, const int place[3], int axis,
                        bool second_order, fg__upwind *out)
{
  ptrdiff_t best = -1;
  int side = 0;
  for (int step = -1; step <= 1; step += 2) {
    ptrdiff_t next = known_neighbour(front, node, place, axis, step);
    if (next >= 0 && (best < 0 || front->distance[next] < front->distance[best])) {
      best = next;
      side = step;
    }
  }
  if (best < 0)
    return false;
  double h = front->window->spacing[axis], near = front->distance[best];
  *out = (fg__upwind){1.0 / (h * h), near, near};
  if (!second_order)
    return true;
  int beside[3] = {place[0], place[1], place[2]};
  beside[axis] += side;
  ptrdiff_t behind = known_neighbour(front, best, beside, axis, side);
  if (behind >= 0 && front->distance[behind] < near) { /* equal: no slope */
    out->weight *= 2.25;
    out->value = (4.0 * near - front->distance[behind]) / 3.0;
  }
  return true;
}

/* Moves the term with the latest neighbour behind the others. */
static void put_latest_last(fg__upwind *term, int terms)
{
  int latest = 0;
  for (int k = 1; k < terms; ++k)
    if (term[k].nearest >= term[latest].nearest)
      latest = k;
  fg__upwind swap = term[terms - 1];
  term[terms - 1] = term[latest];
  term[latest] = swap;
}

/* In second order with all axes that the front has come along, else in first order with
 * as many of them as admit a solution, the earliest neighbours first. */
static double arrival(const march *front, ptrdiff_t node, const int place[3])
{
  for (int order = 2; order >= 1; --order) {
    fg__upwind term[3];
    int terms = 0;
    for (int axis = 0; axis < 3 && axis < front->window->dimension; ++axis)
      terms += look_upwind(front, node, place, axis, order == 2, &term[terms]);
    double value;
    if (terms > 0 && fg__upwind_solve(term, terms, &value))
      return value;
    while (order == 1 && terms > 1) {
      put_latest_last(term, terms--);
      if (fg__upwind_solve(term, terms, &value))
        return value;
    }
  }
  return HUGE_VAL;
}

/* Renews the neighbours of a node that has just become known. */
static bool renew_neighbours(march *front, ptrdiff_t node)
{
  int place[3] = {0};
  fg__window_place(front->window, (size_t)node, place);
  for (int axis = 0; axis < 3 && axis < front->window->dimension; ++axis)
    for (int step = -1; step <= 1; step += 2) {
      int at = place[axis] + step;
      if (at < 0 || at >= front->window->nodes[axis])
        continue;
      ptrdiff_t next = node + step * front->stride[axis];
      if (front->state[next] != FAR)
        continue;
      int beside[3] = {place[0], place[1], place[2]};
      beside[axis] = at;
      double value = arrival(front, next, beside);
      if (value < front->distance[next]) {
        front->distance[next] = value;
        if (!fg__heap_push(&front->heap, value, (int)next))
          return false;
      }
    }
  return true;
}

/* The nodes inside start with their distance from the boundary next to them, which is
 * final up to one spacing. */
static bool start(march *front, bool domain_boundary_counts)
{
  fg__boundary_distance(front->distance, front->window, domain_boundary_counts);
  double exact = fg__window_spacing(front->window);
  size_t nodes = fg__window_count(front->window);
  for (size_t k = 0; k < nodes; ++k) {
    if (!(front->window->level[k] > 0.0F)) {
      front->distance[k] = 0.0;
      continue;
    }
    front->state[k] = front->distance[k] <= exact ? KNOWN : FAR;
    if (isfinite(front->distance[k]) &&
        !fg__heap_push(&front->heap, front->distance[k], (int)k))
      return false;
  }
  return true;
}

/* Where there is no boundary anywhere, as in all of a periodic domain, its longest side
 * stands for the distance. */
static void fill_unreached(const march *front)
{
  const fg__window *window = front->window;
  double longest = 0.0;
  for (int k = 0; k < window->dimension; ++k)
    longest = fmax(longest, window->nodes[k] * window->spacing[k]);
  for (size_t k = 0; k < fg__window_count(window); ++k)
    if (!isfinite(front->distance[k]))
      front->distance[k] = longest;
}

fg_status fg__march(double *distance, fg_context *context, const fg__window *window,
                    bool domain_boundary_counts)
{
  size_t nodes = fg__window_count(window), cells = 1;
  for (int k = 0; k < window->dimension; ++k)
    cells *= (size_t)window->nodes[k] - 1;
  march front = {
      .window = window,
      .distance = distance,
      .stride = {1, window->nodes[0], (ptrdiff_t)window->nodes[0] * window->nodes[1]},
      .masked = memchr(window->active, 0, cells) != NULL};
  front.state = fg__allocate(nodes, 1);
  if (!front.state)
    return fg__fail_memory(context, "fast marching", nodes);
  bool enough = start(&front, domain_boundary_counts);
  if (enough && front.heap.count == 0) /* the cluster is the whole domain */
    enough = start(&front, true);
  while (enough && front.heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&front.heap);
    if (next.key > distance[next.index])
      continue;
    front.state[next.index] = KNOWN;
    enough = renew_neighbours(&front, next.index);
  }
  fill_unreached(&front);
  fg_status status = FG_STATUS_OK;
  if (!enough)
    status = fg__fail_memory(context, "fast marching", front.heap.capacity);
  free(front.state);
  fg__heap_clear(&front.heap);
  return status;
}
