/* On planes that are cut at a meridian: what is shown is a window of longitudes and
 * latitudes, in which parts may appear more than once. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/map/tracer.h"

static bool make_room(fg__tracer *t, size_t count)
{
  if (count <= t->capacity)
    return true;
  const size_t capacity = count + count / 2;
  free(t->clipped);
  free(t->next);
  t->clipped = fg__allocate(capacity, sizeof *t->clipped);
  t->next = fg__allocate(capacity, sizeof *t->next);
  t->capacity = t->clipped && t->next ? capacity : 0;
  return t->capacity > 0;
}

/* The part of the loop in `clipped` where sign * coordinate k <= sign * limit, after
 * Sutherland and Hodgman (1974). Returns its points. */
static size_t clip_loop(fg__tracer *t, size_t count, int k, double sign, double limit)
{
  size_t kept = 0;
  for (size_t n = 0; n < count; ++n) {
    const double *a = t->clipped[n ? n - 1 : count - 1], *b = t->clipped[n];
    const bool a_in = sign * a[k] <= sign * limit, b_in = sign * b[k] <= sign * limit;
    if (a_in != b_in) {
      const double share = (limit - a[k]) / (b[k] - a[k]);
      t->next[kept][k] = limit;
      t->next[kept][1 - k] = a[1 - k] + share * (b[1 - k] - a[1 - k]);
      ++kept;
    }
    if (b_in) {
      t->next[kept][0] = b[0];
      t->next[kept][1] = b[1];
      ++kept;
    }
  }
  double(*swap)[2] = t->clipped;
  t->clipped = t->next;
  t->next = swap;
  return kept;
}

/* A ring round a pole is closed through the pole. */
static void trace_area(fg__tracer *t, const fg__coast_part *p, double shift)
{
  const fg__plane *plane = t->plane;
  /* a window cuts an edge into three at most, four times */
  if (!make_room(t, 4 * p->count + 32)) {
    t->failed = true;
    return;
  }
  size_t count = 0;
  for (size_t n = 0; n < p->count; ++n, ++count) {
    t->clipped[count][0] = p->point[n][0] + shift;
    t->clipped[count][1] = p->point[n][1];
  }
  if (p->turn != 0.0) {
    const double pole = p->low[1] + p->high[1] > 0.0 ? 90.0 : -90.0;
    const double ends[] = {p->point[0][0] + p->turn + shift, p->point[0][0] + shift};
    const double places[][2] = {
        {ends[0], p->point[0][1]}, {ends[0], pole}, {ends[1], pole}};
    for (size_t n = 0; n < 3; ++n, ++count) {
      t->clipped[count][0] = places[n][0];
      t->clipped[count][1] = places[n][1];
    }
  }
  count = clip_loop(t, count, 0, -1.0, plane->west);
  count = clip_loop(t, count, 0, 1.0, plane->east);
  count = clip_loop(t, count, 1, -1.0, plane->south);
  count = clip_loop(t, count, 1, 1.0, plane->north);
  for (size_t n = 0; n < count; ++n)
    fg__stroke_add_straight(&t->stroke, t->clipped[n][0], t->clipped[n][1], t->step);
  if (count)
    fg__stroke_add_straight(&t->stroke, t->clipped[0][0], t->clipped[0][1], t->step);
  fg__stroke_end(&t->stroke, t->areas, plane, true);
}

static void trace_lines(fg__tracer *t, const fg__coast_part *p, double shift)
{
  const double low[2] = {t->plane->west, t->plane->south};
  const double high[2] = {t->plane->east, t->plane->north};
  bool going = false;
  for (size_t n = 0; n < fg__part_edges(p); ++n) {
    double a[2], b[2], share[2];
    fg__part_edge(p, n, a, b);
    a[0] += shift;
    b[0] += shift;
    fg__clip_edge(share, a, b, low, high);
    if (fg__edge_is_cut(a, b) || share[0] >= share[1]) {
      fg__stroke_end(&t->stroke, t->lines, t->plane, false);
      going = false;
      continue;
    }
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    if (!going || share[0] > 0.0) {
      fg__stroke_end(&t->stroke, t->lines, t->plane, false);
      fg__stroke_add(&t->stroke, a[0] + share[0] * d[0], a[1] + share[0] * d[1]);
    }
    fg__stroke_add_straight(&t->stroke, a[0] + share[1] * d[0], a[1] + share[1] * d[1],
                            t->step);
    going = share[1] >= 1.0;
  }
  fg__stroke_end(&t->stroke, t->lines, t->plane, false);
}

void fg__trace_flat(fg__tracer *t, const fg__coast_part *p)
{
  int turns[2];
  fg__part_turns(turns, p, t->plane);
  for (int k = turns[0]; k <= turns[1]; ++k) {
    if (t->areas && p->closed)
      trace_area(t, p, 360.0 * k);
    if (t->lines)
      trace_lines(t, p, 360.0 * k);
  }
}
