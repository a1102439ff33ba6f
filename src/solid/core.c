#include "solid/core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/heap.h"
#include "solid/vector.h"

/* Each point becomes the mean of its neighbours and itself this often: a staircase of
 * unit steps then stays within a third of a step of a straight line. */
enum { SMOOTHINGS = 6 };

/* Nodes nearer to the border than this share of the spacing cost no more than there. */
static const double NEAREST = 0.25;

typedef struct search {
  const fg__volume *volume;
  const double *distance;
  double greatest; /* of the distances */
  double least;
  double *cost; /* [nodes] of the way there so far */
  int *from;    /* [nodes] the node before on it; -1: none */
  fg__heap heap;
} search;

static double price(const search *s, int node)
{
  double ratio = s->greatest / fmax(s->distance[node], s->least);
  return ratio * ratio;
}

/* Goes on from a node to its 26 neighbours. */
static bool spread(search *s, int node, bool priced)
{
  const int *nodes = s->volume->nodes;
  const double *h = s->volume->spacing;
  int x = node % nodes[0], y = node / nodes[0] % nodes[1], z = node / nodes[0] / nodes[1];
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx < 0 || y + dy < 0 || z + dz < 0 || x + dx >= nodes[0] ||
            y + dy >= nodes[1] || z + dz >= nodes[2])
          continue;
        int next = node + (dz * nodes[1] + dy) * nodes[0] + dx;
        if (!(s->volume->level[next] > 0.0F))
          continue;
        double length =
            sqrt(dx * dx * h[0] * h[0] + dy * dy * h[1] * h[1] + dz * dz * h[2] * h[2]);
        double rate = priced ? (price(s, node) + price(s, next)) / 2.0 : 1.0;
        double cost = s->cost[node] + length * rate;
        if (cost < s->cost[next]) {
          s->cost[next] = cost;
          s->from[next] = node;
          if (!fg__heap_push(&s->heap, cost, next))
            return false;
        }
      }
  return true;
}

/* Dijkstra's ways from a node to all others; *farthest is the last that is reached. */
static bool walk(search *s, int start, bool priced, int *farthest)
{
  size_t nodes = fg__volume_count(s->volume);
  for (size_t n = 0; n < nodes; ++n) {
    s->cost[n] = HUGE_VAL;
    s->from[n] = -1;
  }
  s->cost[start] = 0.0;
  *farthest = start;
  bool room = fg__heap_push(&s->heap, 0.0, start);
  while (room && s->heap.count > 0) {
    fg__heap_entry next = fg__heap_pop(&s->heap);
    if (next.key > s->cost[next.index])
      continue;
    *farthest = next.index;
    room = spread(s, next.index, priced);
  }
  return room;
}

static fg_status collect(fg__core *out, fg_context *context, const search *s, int last)
{
  int count = 0;
  for (int node = last; node >= 0; node = s->from[node])
    ++count;
  out->point = fg__allocate((size_t)count, sizeof *out->point);
  if (!out->point)
    return fg__fail_memory(context, "a spine", (size_t)count * sizeof *out->point);
  const int *nodes = s->volume->nodes;
  for (int node = last; node >= 0; node = s->from[node]) {
    const int place[3] = {node % nodes[0], node / nodes[0] % nodes[1],
                          node / nodes[0] / nodes[1]};
    for (int k = 0; k < 3; ++k)
      out->point[out->count][k] = s->volume->origin[k] + place[k] * s->volume->spacing[k];
    ++out->count;
  }
  return FG_STATUS_OK;
}

/* A point moves only where it stays in the cluster. */
static void smooth(fg__core *core, const fg__volume *volume)
{
  for (int turn = 0; turn < SMOOTHINGS; ++turn) {
    double before[3];
    for (int n = 1; n + 1 < core->count; ++n) {
      double mean[3];
      const double *left = n == 1 ? core->point[0] : before;
      for (int k = 0; k < 3; ++k)
        mean[k] = (left[k] + core->point[n][k] + core->point[n + 1][k]) / 3.0;
      memcpy(before, core->point[n], sizeof before);
      if (fg__volume_level(volume, mean) > 0.0)
        memcpy(core->point[n], mean, sizeof mean);
    }
  }
}

static void find_center(fg__core *core, const fg__volume *volume, const double *distance)
{
  core->length = 0.0;
  for (int n = 1; n < core->count; ++n)
    core->length += fg__apart(core->point[n], core->point[n - 1]);
  memcpy(core->center, core->point[0], sizeof core->center);
  double left = core->length / 2.0;
  for (int n = 1; n < core->count; ++n) {
    const double *a = core->point[n - 1], *b = core->point[n];
    double piece = fg__apart(a, b);
    if (piece >= left && piece > 0.0) {
      for (int k = 0; k < 3; ++k)
        core->center[k] = a[k] + left / piece * (b[k] - a[k]);
      break;
    }
    left -= piece;
  }
  core->radius = fg__volume_value(volume, distance, core->center);
}

fg_status fg__core_create(fg__core *out, fg_context *context, const fg__volume *volume,
                          const double *distance)
{
  *out = (fg__core){0};
  size_t nodes = fg__volume_count(volume);
  search s = {.volume = volume, .distance = distance};
  s.cost = fg__allocate(nodes, sizeof *s.cost);
  s.from = fg__allocate(nodes, sizeof *s.from);
  double spacing = fmin(fmin(volume->spacing[0], volume->spacing[1]), volume->spacing[2]);
  s.least = NEAREST * spacing;
  int deepest = -1, one = 0, other = 0;
  for (size_t n = 0; n < nodes; ++n)
    if (volume->level[n] > 0.0F && (deepest < 0 || distance[n] > distance[deepest]))
      deepest = (int)n;
  fg_status status = FG_STATUS_OK;
  if (!s.cost || !s.from)
    status = fg__fail_memory(context, "a spine", nodes * sizeof *s.cost);
  else if (deepest < 0)
    status = fg__fail(context, FG_STATUS_ARGUMENT, "spine: an empty window");
  if (status)
    goto cleanup;
  s.greatest = fmax(distance[deepest], s.least);
  int unused;
  if (!walk(&s, deepest, false, &one) || !walk(&s, one, false, &other) ||
      !walk(&s, one, true, &unused))
    status = fg__fail_memory(context, "a spine", s.heap.capacity);
  else
    status = collect(out, context, &s, other);
  if (!status) {
    smooth(out, volume);
    find_center(out, volume, distance);
  }
cleanup:
  free(s.cost);
  free(s.from);
  fg__heap_clear(&s.heap);
  if (status)
    fg__core_clear(out);
  return status;
}

void fg__core_clear(fg__core *core)
{
  free(core->point);
  *core = (fg__core){0};
}
