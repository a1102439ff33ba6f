#include "sample/points/nearest.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"

/* Among random points 150 are looked at for the nearest 17. */
enum { LEAF = 8, MOST_VISITS = 4096 };

static void swap(int *a, int *b)
{
  const int kept = *a;
  *a = *b;
  *b = kept;
}

/* The point that belongs at `middle` by its coordinate gets there, with none larger
 * before it and none smaller behind (Hoare's selection; Dijkstra's partition). Random
 * pivots make any order alike. */
static void select_middle(int *order, const double *x, size_t first, size_t end,
                          size_t middle)
{
  while (end - first > 1) {
    const double pivot = x[order[first + fg__mix(first + 31 * end) % (end - first)]];
    size_t low = first, high = end;
    for (size_t i = first; i < high;) {
      const double value = x[order[i]];
      if (value < pivot)
        swap(&order[low++], &order[i++]);
      else if (value > pivot)
        swap(&order[i], &order[--high]);
      else
        ++i;
    }
    if (middle < low)
      end = low;
    else if (middle >= high)
      first = high;
    else
      return;
  }
}

static int widest_side(const fg__point_tree *tree, size_t first, size_t end)
{
  double widest = -1.0;
  int axis = 0;
  for (int k = 0; k < 3; ++k) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = first; i < end; ++i) {
      low = fmin(low, tree->position[k][tree->order[i]]);
      high = fmax(high, tree->position[k][tree->order[i]]);
    }
    if (high - low > widest) {
      widest = high - low;
      axis = k;
    }
  }
  return axis;
}

static void build(fg__point_tree *tree, size_t first, size_t end)
{
  if (end - first <= LEAF)
    return;
  const size_t middle = first + (end - first) / 2;
  const int axis = widest_side(tree, first, end);
  select_middle(tree->order, tree->position[axis], first, end, middle);
  tree->axis[middle] = (unsigned char)axis;
  build(tree, first, middle);
  build(tree, middle + 1, end);
}

fg_status fg__point_tree_create(fg__point_tree *out, fg_context *context,
                                const double *const position[3], size_t count)
{
  *out = (fg__point_tree){.position = position, .count = count};
  out->order = fg__allocate(count, sizeof *out->order);
  out->axis = fg__allocate(count, sizeof *out->axis);
  if (!out->order || !out->axis)
    return fg__fail_memory(context, "an order of points", count * sizeof *out->order);
  for (size_t i = 0; i < count; ++i)
    out->order[i] = (int)i;
  build(out, 0, count);
  return FG_STATUS_OK;
}

void fg__point_tree_clear(fg__point_tree *tree)
{
  free(tree->order);
  free(tree->axis);
  *tree = (fg__point_tree){0};
}

typedef struct search {
  const fg__point_tree *tree;
  const double *at;
  fg__nearest_points *found;
  int visits;
} search;

static void take(search *s, int point)
{
  fg__nearest_points *found = s->found;
  double distance = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = s->tree->position[k][point] - s->at[k];
    distance += d * d;
  }
  ++s->visits;
  if (found->count == found->wanted && distance >= found->distance[found->count - 1])
    return;
  int n = found->count < found->wanted ? found->count++ : found->count - 1;
  for (; n > 0 && found->distance[n - 1] > distance; --n) {
    found->distance[n] = found->distance[n - 1];
    found->point[n] = found->point[n - 1];
  }
  found->distance[n] = distance;
  found->point[n] = point;
}

static void look(search *s, size_t first, size_t end)
{
  const fg__nearest_points *found = s->found;
  if (s->visits > MOST_VISITS)
    return;
  if (end - first <= LEAF) {
    for (size_t i = first; i < end; ++i)
      take(s, s->tree->order[i]);
    return;
  }
  const size_t middle = first + (end - first) / 2;
  const int point = s->tree->order[middle], axis = s->tree->axis[middle];
  const double side = s->at[axis] - s->tree->position[axis][point];
  look(s, side < 0.0 ? first : middle + 1, side < 0.0 ? middle : end);
  take(s, point);
  if (found->count < found->wanted || side * side < found->distance[found->count - 1])
    look(s, side < 0.0 ? middle + 1 : first, side < 0.0 ? end : middle);
}

bool fg__point_tree_find(fg__nearest_points *out, const fg__point_tree *tree,
                         const double at[3], int wanted)
{
  search s = {.tree = tree, .at = at, .found = out};
  out->wanted = wanted;
  out->count = 0;
  look(&s, 0, tree->count);
  return s.visits <= MOST_VISITS && out->count == wanted;
}
