#include "solid/march.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/heap.h"
#include "skeleton/upwind.h"

enum state { OUTSIDE, FAR, KNOWN };

typedef struct march {
  const fg__volume *volume;
  double *distance;
  unsigned char *state;
  fg__heap heap;
  ptrdiff_t stride[3];
} march;

static void place_of(const fg__volume *volume, size_t node, int place[3])
{
  size_t width = (size_t)volume->nodes[0], height = (size_t)volume->nodes[1];
  place[0] = (int)(node % width);
  place[1] = (int)(node / width % height);
  place[2] = (int)(node / width / height);
}

/* A node that touches a masked cell, or lies on a side of the window where the cluster
 * ends by itself. */
static bool touches_border(const fg__volume *volume, const int place[3])
{
  for (int k = 0; k < 3; ++k)
    if ((place[k] == 0 && volume->at_border[2 * k]) ||
        (place[k] == volume->nodes[k] - 1 && volume->at_border[2 * k + 1]))
      return true;
  for (int c = 0; c < 8; ++c) {
    const int x = place[0] - (c & 1), y = place[1] - (c >> 1 & 1),
              z = place[2] - (c >> 2);
    if (x >= 0 && y >= 0 && z >= 0 && x < volume->nodes[0] - 1 &&
        y < volume->nodes[1] - 1 && z < volume->nodes[2] - 1 &&
        !volume->active[fg__volume_cell(volume, x, y, z)])
      return true;
  }
  return false;
}

/* Distance to the plane through the crossings of the zero set on the node's own edges;
 * HUGE_VAL when there is none. */
static double border_distance(const march *front, size_t node, const int place[3])
{
  const fg__volume *volume = front->volume;
  if (touches_border(volume, place))
    return 0.0;
  double inverse = 0.0, here = (double)volume->level[node];
  for (int k = 0; k < 3; ++k) {
    double nearest = HUGE_VAL;
    for (int step = -1; step <= 1; step += 2) {
      if (place[k] + step < 0 || place[k] + step >= volume->nodes[k])
        continue;
      double there = (double)volume->level[(ptrdiff_t)node + step * front->stride[k]];
      if (!(there > 0.0))
        nearest = fmin(nearest, volume->spacing[k] * here / (here - there));
    }
    if (!(nearest > 0.0))
      return 0.0;
    inverse += 1.0 / (nearest * nearest);
  }
  return inverse > 0.0 ? 1.0 / sqrt(inverse) : HUGE_VAL;
}

static bool is_known(const march *front, size_t node, int at, int axis, int step)
{
  if (at + step < 0 || at + step >= front->volume->nodes[axis])
    return false;
  return front->state[(ptrdiff_t)node + step * front->stride[axis]] == KNOWN;
}

/* False when the front has not reached the node along this axis. */
static bool look_upwind(const march *front, size_t node, const int place[3], int axis,
                        bool second_order, fg__upwind *out)
{
  int side = 0;
  double near = HUGE_VAL, h = front->volume->spacing[axis];
  for (int step = -1; step <= 1; step += 2)
    if (is_known(front, node, place[axis], axis, step)) {
      double there = front->distance[(ptrdiff_t)node + step * front->stride[axis]];
      side = there < near ? step : side;
      near = fmin(near, there);
    }
  if (!side)
    return false;
  *out = (fg__upwind){1.0 / (h * h), near, near};
  if (second_order && is_known(front, node, place[axis], axis, 2 * side)) {
    double behind = front->distance[(ptrdiff_t)node + 2 * side * front->stride[axis]];
    if (behind < near) { /* equal: both lie on a mask */
      out->weight *= 2.25;
      out->value = (4.0 * near - behind) / 3.0;
    }
  }
  return true;
}

static void sort(fg__upwind *term, int terms)
{
  for (int i = 1; i < terms; ++i)
    for (int j = i; j > 0 && term[j].nearest < term[j - 1].nearest; --j) {
      fg__upwind swap = term[j];
      term[j] = term[j - 1];
      term[j - 1] = swap;
    }
}

/* With as many axes as admit a solution, the earliest neighbours first. */
static double arrival(const march *front, size_t node)
{
  int place[3];
  place_of(front->volume, node, place);
  for (int order = 2; order >= 1; --order) {
    fg__upwind term[3];
    int terms = 0;
    for (int axis = 0; axis < 3; ++axis)
      terms += look_upwind(front, node, place, axis, order == 2, &term[terms]);
    sort(term, terms);
    double value;
    for (int used = terms; used > (order == 2 ? terms - 1 : 0) && used > 0; --used)
      if (fg__upwind_solve(term, used, &value))
        return value;
  }
  return HUGE_VAL;
}

static bool renew_neighbours(march *front, size_t node)
{
  int place[3];
  place_of(front->volume, node, place);
  for (int axis = 0; axis < 3; ++axis)
    for (int step = -1; step <= 1; step += 2) {
      if (place[axis] + step < 0 || place[axis] + step >= front->volume->nodes[axis])
        continue;
      size_t next = (size_t)((ptrdiff_t)node + step * front->stride[axis]);
      if (front->state[next] != FAR)
        continue;
      double value = arrival(front, next);
      if (value < front->distance[next]) {
        front->distance[next] = value;
        if (!fg__heap_push(&front->heap, value, (int)next))
          return false;
      }
    }
  return true;
}

fg_status fg__march_volume(double *distance, fg_context *context,
                           const fg__volume *volume)
{
  size_t nodes = fg__volume_count(volume);
  march front = {
      .volume = volume,
      .distance = distance,
      .stride = {1, volume->nodes[0], (ptrdiff_t)volume->nodes[0] * volume->nodes[1]}};
  front.state = fg__allocate(nodes, 1);
  bool room = front.state != NULL;
  double exact = fmin(fmin(volume->spacing[0], volume->spacing[1]), volume->spacing[2]);
  for (size_t node = 0; node < nodes && room; ++node) {
    distance[node] = 0.0;
    if (!(volume->level[node] > 0.0F))
      continue;
    int place[3];
    place_of(volume, node, place);
    distance[node] = border_distance(&front, node, place);
    front.state[node] = distance[node] <= exact ? KNOWN : FAR;
    if (isfinite(distance[node]))
      room = fg__heap_push(&front.heap, distance[node], (int)node);
  }
  while (room && front.heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&front.heap);
    size_t node = (size_t)next.index;
    if (next.key > distance[node])
      continue;
    front.state[node] = KNOWN;
    room = renew_neighbours(&front, node);
  }
  /* a cluster that is the whole of a periodic domain has no border anywhere */
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
    longest = fmax(longest, volume->nodes[k] * volume->spacing[k]);
  for (size_t node = 0; node < nodes && room; ++node)
    distance[node] = fmin(distance[node], longest);
  fg_status status = FG_STATUS_OK;
  if (!room)
    status = fg__fail_memory(context, "fast marching", nodes);
  free(front.state);
  fg__heap_clear(&front.heap);
  return status;
}
