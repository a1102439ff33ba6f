#include "critical/directions.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where the Gaussian is cut off, in its standard deviations. */
static const double CUT_OFF = 3.0;

/* Of lambda: the Gaussian's standard deviation, and the distance below which points are
 * one. */
static const double SMOOTHING = 0.25, REACH = 0.5;

fg_status fg__directions_create(fg__directions *out, fg_context *context,
                                const fg__domain_raster *raster, double lambda)
{
  *out = (fg__directions){.raster = raster, .lambda = lambda};
  out->inside = fg__allocate(raster->cells, 1);
  bool all = out->inside != NULL;
  for (int k = 0; k < 2; ++k) {
    const double deviation = SMOOTHING * lambda / raster->cell[k];
    const double most = raster->size[k];
    out->radius[k] = (int)ceil(fmin(CUT_OFF * deviation, most));
    out->value[k] = fg__allocate(raster->cells, sizeof(double));
    out->smooth[k] = fg__allocate(raster->cells, sizeof(double));
    out->kernel[k] = fg__allocate((size_t)out->radius[k] + 1, sizeof(double));
    all = all && out->value[k] && out->smooth[k] && out->kernel[k];
    for (int n = 0; out->kernel[k] && n <= out->radius[k]; ++n)
      out->kernel[k][n] = exp(-0.5 * (n / deviation) * (n / deviation));
  }
  return all ? FG_STATUS_OK
             : fg__fail_memory(context, "smoothed directions",
                               raster->cells * 4 * sizeof(double));
}

void fg__directions_clear(fg__directions *p)
{
  free(p->inside);
  for (int k = 0; k < 2; ++k) {
    free(p->value[k]);
    free(p->smooth[k]);
    free(p->kernel[k]);
  }
}

/* Along x, from `from` to `to`; what lies outside counts 0. */
static void smooth_row(const fg__directions *p, double *restrict to,
                       const double *restrict from)
{
  const int columns = p->raster->size[0];
  for (int i = 0; i < columns; ++i)
    to[i] = p->kernel[0][0] * from[i];
  for (int n = 1; n <= p->radius[0] && n < columns; ++n) {
    const double weight = p->kernel[0][n];
    for (int i = 0; i < columns - n; ++i)
      to[i] += weight * from[i + n];
    for (int i = n; i < columns; ++i)
      to[i] += weight * from[i - n];
  }
}

static void smooth_column(const fg__directions *p, double *restrict to,
                          const double *values, int row)
{
  const int columns = p->raster->size[0], rows = p->raster->size[1];
  memset(to, 0, (size_t)columns * sizeof *to);
  for (int j = row - p->radius[1]; j <= row + p->radius[1]; ++j) {
    if (j < 0 || j >= rows)
      continue;
    const double weight = p->kernel[1][abs(j - row)];
    const double *restrict from = values + (size_t)j * (size_t)columns;
    for (int i = 0; i < columns; ++i)
      to[i] += weight * from[i];
  }
}

typedef struct pass {
  const fg__directions *directions;
  bool across; /* along y, second; else along x */
} pass;

/* Division by the smoothed mask is left out: it changes no direction. */
static void smooth_rows(void *argument, const fg__thread *thread)
{
  const pass *work = argument;
  const fg__directions *p = work->directions;
  const size_t columns = (size_t)p->raster->size[0];
  int row, end;
  fg__threads_range(thread, p->raster->size[1], 1, &row, &end);
  for (; row < end; ++row)
    for (int k = 0; k < 2; ++k) {
      const size_t place = (size_t)row * columns;
      if (work->across)
        smooth_column(p, p->value[k] + place, p->smooth[k], row);
      else
        smooth_row(p, p->smooth[k] + place, p->value[k] + place);
    }
}

/* Poincare's index round a block of 2 x 2 cells: turns of the direction. */
static int index_of(const fg__directions *p, size_t place)
{
  const size_t columns = (size_t)p->raster->size[0];
  const size_t corner[4] = {place, place + 1, place + columns + 1, place + columns};
  double x[5], y[5], turn = 0.0;
  bool turns = false;
  for (int n = 0; n < 5; ++n) {
    if (!p->inside[corner[n % 4]])
      return 0;
    x[n] = p->value[0][corner[n % 4]];
    y[n] = p->value[1][corner[n % 4]];
    if (x[n] == 0.0 && y[n] == 0.0)
      return 0;
    turns = turns || x[n] * x[0] + y[n] * y[0] < 0.0;
  }
  for (int n = 0; turns && n < 4; ++n)
    turn += atan2(x[n] * y[n + 1] - y[n] * x[n + 1], x[n] * x[n + 1] + y[n] * y[n + 1]);
  return (int)lround(turn / 6.283185307179586);
}

/* The direction's gradient on such a block, and its zero: bilinear, by a step of Newton's
 * from the middle that stays in the block. */
static fg__point point_of(const fg__directions *p, int i, int j, int index)
{
  const fg__domain_raster *raster = p->raster;
  const size_t columns = (size_t)raster->size[0];
  const size_t place = (size_t)j * columns + (size_t)i;
  fg__point out = {.index = index};
  double middle[2], step[2];
  for (int k = 0; k < 2; ++k) {
    const double *v = p->value[k] + place;
    const double right = v[1] + v[columns + 1], upper = v[columns] + v[columns + 1];
    const double all = v[0] + v[1] + v[columns] + v[columns + 1];
    middle[k] = 0.25 * all;
    out.gradient[k][0] = (right - 0.5 * all) / raster->cell[0];
    out.gradient[k][1] = (upper - 0.5 * all) / raster->cell[1];
  }
  double(*g)[2] = out.gradient;
  const double determinant = g[0][0] * g[1][1] - g[0][1] * g[1][0];
  step[0] = (g[0][1] * middle[1] - g[1][1] * middle[0]) / determinant;
  step[1] = (g[1][0] * middle[0] - g[0][0] * middle[1]) / determinant;
  const int at[2] = {i + 1, j + 1};
  for (int k = 0; k < 2; ++k) {
    const double share = step[k] / raster->cell[k];
    out.at[k] = raster->origin[k] +
                (at[k] + (isfinite(share) ? fmin(fmax(share, -0.5), 0.5) : 0.0)) *
                    raster->cell[k];
  }
  return out;
}

static fg_status add_points(fg__points *points, fg_context *context,
                            const fg__directions *p)
{
  const int *size = p->raster->size;
  fg_status status = FG_STATUS_OK;
  for (int j = 0; j + 1 < size[1]; ++j)
    for (int i = 0; i + 1 < size[0] && status == FG_STATUS_OK; ++i) {
      const int index = index_of(p, (size_t)j * (size_t)size[0] + (size_t)i);
      if (!index)
        continue;
      const fg__point point = point_of(p, i, j, index);
      status = fg__points_add(points, context, &point);
    }
  return status;
}

fg_status fg__directions_find(fg__points *points, fg__directions *p, fg_context *context,
                              fg__threads *threads)
{
  const fg__domain_raster *raster = p->raster;
  double high[2];
  for (int k = 0; k < 2; ++k)
    high[k] = raster->origin[k] + raster->size[k] * raster->cell[k];
  fg_status status =
      fg__points_create(points, context, raster->origin, high, REACH * p->lambda);
  if (status != FG_STATUS_OK)
    return status;
  fg__threads_run(threads, smooth_rows, &(pass){.directions = p});
  fg__threads_run(threads, smooth_rows, &(pass){.directions = p, .across = true});
  status = add_points(points, context, p);
  return status == FG_STATUS_OK ? fg__points_merge(points, context) : status;
}

double fg__directions_share(const fg__directions *p, const double at[2])
{
  const fg__domain_raster *raster = p->raster;
  double inside = 0.0, all = 0.0;
  int middle[2];
  for (int k = 0; k < 2; ++k)
    middle[k] = (int)floor((at[k] - raster->origin[k]) / raster->cell[k]);
  for (int j = middle[1] - p->radius[1]; j <= middle[1] + p->radius[1]; ++j)
    for (int i = middle[0] - p->radius[0]; i <= middle[0] + p->radius[0]; ++i) {
      const double weight =
          p->kernel[0][abs(i - middle[0])] * p->kernel[1][abs(j - middle[1])];
      all += weight;
      if (i >= 0 && j >= 0 && i < raster->size[0] && j < raster->size[1] &&
          p->inside[(size_t)j * (size_t)raster->size[0] + (size_t)i])
        inside += weight;
    }
  return inside / all;
}
