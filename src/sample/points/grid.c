/* Whether points lie where the lines of a grid cross. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "sample/gaps.h"
#include "sample/points/points.h"

enum {
  MOST_EMPTY = 64, /* samples a point: half of a coast's box and more may be empty */
  SMALL = 1024     /* samples that are made whatever the number of points */
};

/* Of the axis' width: coordinates on one line differ by less, those of lines by more. */
static const double SAME_LINE = 1e-6;

/* An interval is a whole multiple of the narrowest one, but for this share of it. */
static const double EVEN = 0.01;

/* The largest share of the intervals that may lack a line of points. */
static const double FEW = 0.1;

typedef struct ranked {
  double at;
  size_t point;
} ranked;

/* Lines across an axis, and the one that each point lies on. */
typedef struct lines {
  size_t count;
  double *at;
  int *of; /* [points] */
} lines;

static void clear(lines *l)
{
  free(l->at);
  free(l->of);
  *l = (lines){0};
}

static int by_place(const void *a, const void *b)
{
  const ranked *p = a, *q = b;
  return (p->at > q->at) - (p->at < q->at);
}

static fg_status find_lines(lines *out, const fg__scatter *points, int k)
{
  const size_t count = points->count;
  ranked *order = fg__allocate(count, sizeof *order);
  *out = (lines){.at = fg__allocate(count, sizeof *out->at),
                 .of = fg__allocate(count, sizeof *out->of)};
  if (!order || !out->at || !out->of) {
    free(order);
    return fg__fail_memory(points->context, "lines of a grid", count * sizeof *order);
  }
  for (size_t i = 0; i < count; ++i)
    order[i] = (ranked){points->position[k][i], i};
  qsort(order, count, sizeof *order, by_place);
  const double same = SAME_LINE * (order[count - 1].at - order[0].at);
  for (size_t i = 0; i < count; ++i) {
    if (i == 0 || order[i].at - out->at[out->count - 1] > same)
      out->at[out->count++] = order[i].at;
    out->of[order[i].point] = (int)out->count - 1;
  }
  free(order);
  return FG_STATUS_OK;
}

/* How many of the narrowest interval fit between lines i - 1 and i; 0 where it is no
 * whole number. */
static double steps_between(const lines *l, size_t i, double narrowest)
{
  const double steps = (l->at[i] - l->at[i - 1]) / narrowest;
  return fabs(steps - round(steps)) <= EVEN * steps ? round(steps) : 0.0;
}

/* Lines of an even grid that have no point at all are put back, so that nothing is
 * interpolated across them. */
static fg_status fill_gaps(lines *l, const fg__scatter *points)
{
  double narrowest = HUGE_VAL, all = 1.0, gaps = 0.0;
  for (size_t i = 1; i < l->count; ++i)
    narrowest = fmin(narrowest, l->at[i] - l->at[i - 1]);
  for (size_t i = 1; i < l->count; ++i) {
    const double steps = steps_between(l, i, narrowest);
    if (steps == 0.0)
      return FG_STATUS_OK;
    all += steps;
    gaps += steps > 1.0;
  }
  if (gaps == 0.0 || gaps > FEW * (double)l->count || all > 2.0 * (double)l->count)
    return FG_STATUS_OK;
  double *at = fg__allocate((size_t)all, sizeof *at);
  int *now = fg__allocate(l->count, sizeof *now);
  if (at && now) {
    size_t n = 0;
    at[n] = l->at[0];
    for (size_t i = 1; i < l->count; ++i) {
      const double steps = steps_between(l, i, narrowest);
      for (double s = 1.0; s < steps; ++s)
        at[++n] = l->at[i - 1] + (l->at[i] - l->at[i - 1]) * s / steps;
      at[++n] = l->at[i];
      now[i] = (int)n;
    }
    for (size_t p = 0; p < points->count; ++p)
      l->of[p] = now[l->of[p]];
    free(l->at);
    l->at = at;
    l->count = n + 1;
    at = NULL;
  }
  const bool failed = !now || (at && now);
  free(at);
  free(now);
  return failed ? fg__fail_memory(points->context, "lines of a grid", (size_t)all * 8)
                : FG_STATUS_OK;
}

/* How far apart the lines are on one side of interval i, which is a gap. */
static double step_beside(const lines *l, const bool *gap, size_t i, bool after)
{
  const size_t intervals = l->count - 1;
  for (size_t k = 1; k < intervals; ++k) {
    const size_t other = after ? i + k : i - k;
    if (other < intervals && !gap[other])
      return l->at[other + 1] - l->at[other];
    if (other >= intervals)
      break;
  }
  return 0.25 * (l->at[i + 1] - l->at[i]);
}

/* Two lines without a point in each interval that is wide beside its neighbours, so that
 * nothing is interpolated across it. */
static fg_status open_gaps(lines *l, size_t *gaps, const fg__scatter *points)
{
  bool *gap;
  size_t found;
  bool memory = fg__gaps_along(&gap, &found, l->at, l->count);
  double *at = fg__allocate(l->count + 2 * found, sizeof *at);
  int *now = fg__allocate(l->count, sizeof *now);
  memory = memory && at && now;
  if (memory && found > 0) {
    size_t n = 0;
    for (size_t i = 0; i < l->count; ++i) {
      now[i] = (int)n;
      at[n++] = l->at[i];
      if (i + 1 == l->count || !gap[i])
        continue;
      const double quarter = 0.25 * (l->at[i + 1] - l->at[i]);
      at[n++] = l->at[i] + fmin(step_beside(l, gap, i, false), quarter);
      at[n++] = l->at[i + 1] - fmin(step_beside(l, gap, i, true), quarter);
    }
    for (size_t p = 0; p < points->count; ++p)
      l->of[p] = now[l->of[p]];
    free(l->at);
    l->at = at;
    l->count = n;
    at = NULL;
  }
  *gaps += found;
  free(gap);
  free(at);
  free(now);
  return memory ? FG_STATUS_OK
                : fg__fail_memory(points->context, "lines of a grid", l->count * 8);
}

/* The point at each crossing, or -1; false when two are at one. */
static bool place_points(int *point_at, size_t samples, const fg__scatter *points,
                         const lines *l)
{
  for (size_t n = 0; n < samples; ++n)
    point_at[n] = -1;
  for (size_t p = 0; p < points->count; ++p) {
    size_t n = 0, step = 1;
    for (int k = 0; k < points->dimension && k < 3; ++k) {
      n += step * (size_t)l[k].of[p];
      step *= l[k].count;
    }
    if (point_at[n] >= 0)
      return false;
    point_at[n] = (int)p;
  }
  return true;
}

/* Cells of the grid whose corners all have a point. */
static size_t count_cells(const int *point_at, const lines *l)
{
  const size_t nx = l[0].count, ny = l[1].count, nz = l[2].count;
  size_t full = 0;
  for (size_t z = 0; z + (nz > 1) < nz; ++z)
    for (size_t y = 0; y + 1 < ny; ++y)
      for (size_t x = 0; x + 1 < nx; ++x) {
        bool here = true;
        for (int corner = 0; corner < (nz > 1 ? 8 : 4) && here; ++corner)
          here = point_at[((z + (corner >> 2 & 1)) * ny + y + (corner >> 1 & 1)) * nx +
                          x + (corner & 1)] >= 0;
        full += here;
      }
  return full;
}

/* A grid has a point at most crossings, or holes: then most points have a full cell.
 * Random places that were rounded to few figures have neither. */
static bool is_grid(const int *point_at, size_t samples, size_t points, const lines *l)
{
  return 2 * points >= samples || 2 * count_cells(point_at, l) >= points;
}

static fg_status take_samples(fg__point_grid *out, const int *point_at, size_t samples,
                              const fg__scatter *points, lines *l)
{
  out->dimension = points->dimension;
  for (int k = 0; k < points->dimension && k < 3; ++k) {
    out->size[k] = (int)l[k].count;
    out->axis[k] = l[k].at;
    l[k].at = NULL;
    out->velocity[k] = fg__allocate(samples, sizeof *out->velocity[k]);
    if (!out->velocity[k])
      return fg__fail_memory(points->context, "a field's samples", samples * 4);
    for (size_t n = 0; n < samples; ++n)
      out->velocity[k][n] = point_at[n] < 0 ? NAN : points->velocity[k][point_at[n]];
  }
  return FG_STATUS_OK;
}

fg_status fg__scatter_find_grid(fg__point_grid *out, bool *found,
                                const fg__scatter *points)
{
  lines l[3] = {{0}, {0}, {.count = 1}};
  double samples = 1.0;
  int *point_at = NULL;
  size_t gaps = 0;
  fg_status status = FG_STATUS_OK;
  *out = (fg__point_grid){0};
  *found = true;
  for (int k = 0; k < points->dimension && k < 3 && status == FG_STATUS_OK && *found;
       ++k) {
    status = find_lines(&l[k], points, k);
    if (status == FG_STATUS_OK)
      status = fill_gaps(&l[k], points);
    if (status == FG_STATUS_OK)
      status = open_gaps(&l[k], &gaps, points);
    samples *= (double)l[k].count;
    *found = l[k].count > 1 &&
             samples <= fmin(MOST_EMPTY * (double)points->count + SMALL, INT_MAX);
  }
  if (status == FG_STATUS_OK && *found)
    status = fg__check_memory(points->context, points->path, samples,
                              sizeof(int) + points->dimension * (double)sizeof(float));
  if (status == FG_STATUS_OK && *found) {
    point_at = fg__allocate((size_t)samples, sizeof *point_at);
    if (!point_at)
      status = fg__fail_memory(points->context, "a grid", (size_t)samples * 4);
  }
  if (point_at) {
    *found = place_points(point_at, (size_t)samples, points, l) &&
             is_grid(point_at, (size_t)samples, points->count, l);
    if (*found)
      status = take_samples(out, point_at, (size_t)samples, points, l);
  }
  out->gaps = *found ? gaps : 0;
  free(point_at);
  for (int k = 0; k < 3; ++k)
    clear(&l[k]);
  if (status != FG_STATUS_OK)
    fg__point_grid_clear(out);
  return status;
}
