#include "texture/contrast.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* A spread below this share of the whole picture's is no texture but rounding. */
static const float least_spread = 1e-3F;

enum { COLUMNS = 32 }; /* that are summed side by side */

/* Windows along one axis: 2 radius + 1 wide, cut at the ends or going round. */
typedef struct window {
  int count, radius;
  bool periodic;
} window;

static window window_of(const fg__raster *raster, int k, int radius)
{
  const int count = raster->size[k];
  const int most = raster->periodic[k] ? (count - 1) / 2 : count - 1;
  return (window){count, radius < most ? radius : most, raster->periodic[k]};
}

/* The place of a window's end, or -1 where it is cut. */
static int end_of(const window *w, int index)
{
  if (index >= 0 && index < w->count)
    return index;
  if (!w->periodic)
    return -1;
  return index < 0 ? index + w->count : index - w->count;
}

static int members_at(const window *w, int i)
{
  if (w->periodic)
    return 2 * w->radius + 1;
  const int first = i > w->radius ? i - w->radius : 0;
  const int last = i + w->radius < w->count ? i + w->radius : w->count - 1;
  return last - first + 1;
}

typedef struct evening {
  const fg__raster *raster;
  window window[2];
  float *value;
  float *along;  /* means along rows */
  float *around; /* means over windows */
  float *row;    /* one a thread */
  bool squares;  /* of values that are differences from the mean by now */
} evening;

/* Sums run along; in double, so that they do not drift. */
static void mean_row(float *out, const float *in, const window *w)
{
  double sum = 0.0;
  for (int i = -w->radius; i <= w->radius; ++i) {
    const int at = end_of(w, i);
    sum += at >= 0 ? (double)in[at] : 0.0;
  }
  for (int i = 0; i < w->count; ++i) {
    out[i] = (float)(sum / members_at(w, i));
    const int next = end_of(w, i + w->radius + 1), last = end_of(w, i - w->radius);
    sum += (next >= 0 ? (double)in[next] : 0.0) - (last >= 0 ? (double)in[last] : 0.0);
  }
}

static void mean_rows(void *argument, const fg__thread *thread)
{
  const evening *e = argument;
  const size_t columns = (size_t)e->raster->size[0];
  float *row = e->row + (size_t)thread->index * columns;
  int begin, end;
  fg__threads_range(thread, e->raster->size[1], 1, &begin, &end);
  for (int j = begin; j < end; ++j) {
    const float *in = e->value + (size_t)j * columns;
    for (size_t i = 0; i < columns; ++i)
      row[i] = e->squares ? in[i] * in[i] : in[i];
    mean_row(e->along + (size_t)j * columns, row, &e->window[0]);
  }
}

static void add_row(double sum[COLUMNS], const float *row, int count, double sign)
{
  for (int i = 0; i < count; ++i)
    sum[i] += sign * (double)row[i];
}

static void mean_strip(const evening *e, int first, int count)
{
  const window *w = &e->window[1];
  const size_t columns = (size_t)e->raster->size[0];
  const float *in = e->along + first;
  double sum[COLUMNS] = {0};
  for (int j = -w->radius; j <= w->radius; ++j) {
    const int at = end_of(w, j);
    if (at >= 0)
      add_row(sum, in + (size_t)at * columns, count, 1.0);
  }
  for (int j = 0; j < w->count; ++j) {
    float *out = e->around + (size_t)j * columns + first;
    const double share = 1.0 / members_at(w, j);
    for (int i = 0; i < count; ++i)
      out[i] = (float)(share * sum[i]);
    const int next = end_of(w, j + w->radius + 1), last = end_of(w, j - w->radius);
    if (next >= 0)
      add_row(sum, in + (size_t)next * columns, count, 1.0);
    if (last >= 0)
      add_row(sum, in + (size_t)last * columns, count, -1.0);
  }
}

static void mean_columns(void *argument, const fg__thread *thread)
{
  const evening *e = argument;
  int begin, end;
  fg__threads_range(thread, e->raster->size[0], COLUMNS, &begin, &end);
  for (int i = begin; i < end; i += COLUMNS)
    mean_strip(e, i, end - i < COLUMNS ? end - i : COLUMNS);
}

static void find_means(evening *e, fg__threads *threads, bool squares)
{
  e->squares = squares;
  fg__threads_run(threads, mean_rows, e);
  fg__threads_run(threads, mean_columns, e);
}

/* Serial, so that it does not depend on who sums what. */
static float whole_spread(const evening *e, size_t count)
{
  double sum = 0.0;
  for (size_t n = 0; n < count; ++n)
    sum += (double)e->around[n];
  return (float)(sum / (double)count);
}

static void settle(evening *e, size_t count, float cut)
{
  const float least = least_spread * least_spread * whole_spread(e, count);
  for (size_t n = 0; n < count; ++n) {
    const float spread = e->around[n] > least ? e->around[n] : least;
    const float size = cut * sqrtf(spread);
    e->value[n] = fg__contrast_bend(spread > 0.0F ? e->value[n] / size : 0.0F);
  }
}

fg_status fg__contrast_even(float *value, fg_context *context, const fg__raster *raster,
                            int radius, double cut, fg__threads *threads)
{
  const size_t columns = (size_t)raster->size[0];
  const size_t count = columns * (size_t)raster->size[1];
  const size_t rows = (size_t)fg__threads_count(threads);
  evening e = {.raster = raster, .value = value};
  for (int k = 0; k < 2; ++k)
    e.window[k] = window_of(raster, k, radius);
  e.along = fg__allocate(count, sizeof *e.along);
  e.around = fg__allocate(count, sizeof *e.around);
  e.row = fg__allocate(rows * columns, sizeof *e.row);
  fg_status status = FG_STATUS_OK;
  if (!e.along || !e.around || !e.row) {
    status = fg__fail_memory(context, "a picture's contrast",
                             (2 * count + rows * columns) * sizeof *e.row);
  } else {
    find_means(&e, threads, false);
    for (size_t n = 0; n < count; ++n)
      value[n] -= e.around[n];
    find_means(&e, threads, true);
    settle(&e, count, (float)cut);
  }
  free(e.along);
  free(e.around);
  free(e.row);
  return status;
}
