#include "critical/points.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { MOST_BUCKETS_A_SIDE = 1024 };

typedef struct pair {
  double distance;
  size_t a, b;
} pair;

/* A heap: none of a pair's two successors comes before it. */
typedef struct pairs {
  pair *pair;
  size_t count, capacity;
} pairs;

fg_status fg__points_create(fg__points *out, fg_context *context, const double low[2],
                            const double high[2], double reach)
{
  *out = (fg__points){.reach = reach, .low = {low[0], low[1]}};
  for (int k = 0; k < 2; ++k) {
    const double count = floor((high[k] - low[k]) / reach);
    out->size[k] = 1 + (int)fmin(count, MOST_BUCKETS_A_SIDE - 1);
  }
  const size_t buckets = (size_t)out->size[0] * (size_t)out->size[1];
  out->bucket = fg__allocate(buckets, sizeof *out->bucket);
  if (!out->bucket)
    return fg__fail_memory(context, "critical points", buckets * sizeof *out->bucket);
  for (size_t n = 0; n < buckets; ++n)
    out->bucket[n] = SIZE_MAX;
  return FG_STATUS_OK;
}

void fg__points_clear(fg__points *points)
{
  free(points->point);
  free(points->bucket);
  *points = (fg__points){0};
}

/* The bucket along an axis; what lies outside or beyond the last is in the outermost. */
static int bucket_of(const fg__points *points, int axis, double at)
{
  const double number = floor((at - points->low[axis]) / points->reach);
  const int last = points->size[axis] - 1;
  return number < 0.0 ? 0 : number > last ? last : (int)number;
}

fg_status fg__points_add(fg__points *points, fg_context *context, const fg__point *point)
{
  if (!fg__grow((void **)&points->point, &points->capacity, points->count + 1,
                sizeof *points->point))
    return fg__fail_memory(context, "critical points",
                           (points->count + 1) * sizeof *points->point);
  size_t *last = &points->bucket[bucket_of(points, 1, point->at[1]) * points->size[0] +
                                 bucket_of(points, 0, point->at[0])];
  points->point[points->count] = *point;
  points->point[points->count].next = *last;
  *last = points->count++;
  return FG_STATUS_OK;
}

static bool comes_before(const pair *a, const pair *b)
{
  if (a->distance != b->distance)
    return a->distance < b->distance;
  return a->a != b->a ? a->a < b->a : a->b < b->b;
}

static bool push(pairs *heap, pair added)
{
  if (!fg__grow((void **)&heap->pair, &heap->capacity, heap->count + 1, sizeof added))
    return false;
  size_t n = heap->count++;
  for (; n > 0 && comes_before(&added, &heap->pair[(n - 1) / 2]); n = (n - 1) / 2)
    heap->pair[n] = heap->pair[(n - 1) / 2];
  heap->pair[n] = added;
  return true;
}

static pair pop(pairs *heap)
{
  const pair first = heap->pair[0], last = heap->pair[--heap->count];
  size_t n = 0;
  for (;;) {
    size_t next = 2 * n + 1;
    if (next + 1 < heap->count && comes_before(&heap->pair[next + 1], &heap->pair[next]))
      ++next;
    if (next >= heap->count || !comes_before(&heap->pair[next], &last))
      break;
    heap->pair[n] = heap->pair[next];
    n = next;
  }
  heap->pair[n] = last;
  return first;
}

/* Adds the pairs of a point with those of `others` before `end` that are within reach;
 * `alike`: only of its index. */
static fg_status push_pairs(pairs *heap, fg_context *context, const fg__point *point,
                            size_t place, const fg__points *others, size_t end,
                            bool alike)
{
  const int column = bucket_of(others, 0, point->at[0]);
  const int row = bucket_of(others, 1, point->at[1]);
  for (int j = row - 1; j <= row + 1; ++j)
    for (int i = column - 1; i <= column + 1; ++i) {
      if (i < 0 || j < 0 || i >= others->size[0] || j >= others->size[1])
        continue;
      for (size_t n = others->bucket[j * others->size[0] + i]; n != SIZE_MAX;
           n = others->point[n].next) {
        const fg__point *other = &others->point[n];
        const double distance =
            hypot(other->at[0] - point->at[0], other->at[1] - point->at[1]);
        if (n >= end || other->gone || !(distance < others->reach) ||
            (alike && other->index != point->index))
          continue;
        if (!push(heap, (pair){distance, place, n}))
          return fg__fail_memory(context, "pairs of critical points",
                                 heap->count * sizeof(pair));
      }
    }
  return FG_STATUS_OK;
}

/* The sums of gradients of points that turn or flow alike. */
static void add_gradients(fg__point *sum, const fg__point *a, const fg__point *b)
{
  const double(*g)[2] = a->gradient, (*h)[2] = b->gradient;
  const double alike = (g[0][0] + g[1][1]) * (h[0][0] + h[1][1]) +
                       (g[1][0] - g[0][1]) * (h[1][0] - h[0][1]);
  for (int k = 0; k < 4 && (alike > 0.0 || sum->index < 0); ++k)
    sum->gradient[k / 2][k % 2] = g[k / 2][k % 2] + h[k / 2][k % 2];
}

static fg_status merge_pair(fg__points *points, pairs *heap, fg_context *context,
                            const pair *closest)
{
  fg__point *a = &points->point[closest->a], *b = &points->point[closest->b];
  fg__point both = {.index = a->index};
  a->gone = b->gone = true;
  if (a->index != b->index)
    return FG_STATUS_OK;
  for (int k = 0; k < 2; ++k)
    both.at[k] = 0.5 * (a->at[k] + b->at[k]);
  add_gradients(&both, a, b);
  const size_t place = points->count;
  fg_status status = fg__points_add(points, context, &both);
  return status != FG_STATUS_OK ? status
                                : push_pairs(heap, context, &points->point[place], place,
                                             points, place, false);
}

fg_status fg__points_merge(fg__points *points, fg_context *context)
{
  pairs heap = {0};
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < points->count && status == FG_STATUS_OK; ++n)
    status = push_pairs(&heap, context, &points->point[n], n, points, n, false);
  while (heap.count > 0 && status == FG_STATUS_OK) {
    const pair closest = pop(&heap);
    if (!points->point[closest.a].gone && !points->point[closest.b].gone)
      status = merge_pair(points, &heap, context, &closest);
  }
  free(heap.pair);
  return status;
}

size_t fg__points_left(const fg__points *points)
{
  size_t count = 0;
  for (size_t n = 0; n < points->count; ++n)
    count += !points->point[n].gone;
  return count;
}

fg_status fg__points_match(size_t *matched, fg_context *context, const fg__points *a,
                           const fg__points *b)
{
  pairs heap = {0};
  unsigned char *taken[2] = {fg__allocate(a->count, 1), fg__allocate(b->count, 1)};
  fg_status status = FG_STATUS_OK;
  *matched = 0;
  if (!taken[0] || !taken[1])
    status = fg__fail_memory(context, "critical points", a->count + b->count);
  for (size_t n = 0; n < a->count && status == FG_STATUS_OK; ++n)
    if (!a->point[n].gone)
      status = push_pairs(&heap, context, &a->point[n], n, b, b->count, true);
  while (heap.count > 0 && status == FG_STATUS_OK) {
    const pair closest = pop(&heap);
    if (taken[0][closest.a] || taken[1][closest.b])
      continue;
    taken[0][closest.a] = taken[1][closest.b] = 1;
    ++*matched;
  }
  free(heap.pair);
  free(taken[0]);
  free(taken[1]);
  return status;
}
