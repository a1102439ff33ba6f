/* Critical points of the field that a reader finds. */
#include "base/memory.h"
#include "score/measures.h"
#include "score/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Fields are smoothed by a Gaussian of so many lambda, cut off at as many of its standard
 * deviations; points nearer than that many lambda are one. */
static const double SMOOTHING = 0.25, CUT_OFF = 3.0, REACH = 0.5;

/* A field of directions, a number a cell, and the same smoothed. */
typedef struct plane {
  const fg__score_raster *raster;
  unsigned char *inside;
  double *value[2], *smooth[2];
  double *kernel[2]; /* along x and y, from the middle on */
  int radius[2];
} plane;

static fg_status plane_create(plane *out, fg_context *context,
                              const fg__score_raster *raster, double lambda)
{
  *out = (plane){.raster = raster};
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

static void plane_clear(plane *p)
{
  free(p->inside);
  for (int k = 0; k < 2; ++k) {
    free(p->value[k]);
    free(p->smooth[k]);
    free(p->kernel[k]);
  }
}

/* The field's directions or, with one, the reader's. */
static void fill(plane *p, const fg__harmonic *harmonic)
{
  const fg__score_raster *raster = p->raster;
  for (size_t n = 0; n < raster->cells; ++n) {
    double x = (double)raster->direction[0][n], y = (double)raster->direction[1][n];
    p->inside[n] = raster->inside[n];
    if (harmonic) {
      x = harmonic->value[0][n];
      y = harmonic->value[1][n];
      p->inside[n] = harmonic->known[n];
    }
    const double length = hypot(x, y);
    p->value[0][n] = length > 0.0 ? x / length : 0.0;
    p->value[1][n] = length > 0.0 ? y / length : 0.0;
  }
}

/* Along x, from `from` to `to`; what lies outside counts 0. */
static void smooth_row(const plane *p, double *restrict to, const double *restrict from)
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

static void smooth_column(const plane *p, double *restrict to, const double *values,
                          int row)
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
  const plane *plane;
  bool across; /* along y, second; else along x */
} pass;

/* Division by the smoothed mask is left out: it changes no direction. */
static void smooth_rows(void *argument, const fg__thread *thread)
{
  const pass *work = argument;
  const plane *p = work->plane;
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
static int index_of(const plane *p, size_t place)
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

/* The merged critical points of the field or of the reader. */
static fg_status find_points(fg__points *points, plane *p, fg_context *context,
                             const fg__harmonic *harmonic, fg__threads *threads)
{
  const fg__score_raster *raster = p->raster;
  fg_status status = FG_STATUS_OK;
  fill(p, harmonic);
  fg__threads_run(threads, smooth_rows, &(pass){.plane = p});
  fg__threads_run(threads, smooth_rows, &(pass){.plane = p, .across = true});
  for (int j = 0; j + 1 < raster->size[1]; ++j)
    for (int i = 0; i + 1 < raster->size[0] && status == FG_STATUS_OK; ++i) {
      const size_t place = (size_t)j * (size_t)raster->size[0] + (size_t)i;
      const int index = index_of(p, place);
      const double at[2] = {raster->origin[0] + (i + 1) * raster->cell[0],
                            raster->origin[1] + (j + 1) * raster->cell[1]};
      if (index)
        status = fg__points_add(points, context, at, index);
    }
  return status == FG_STATUS_OK ? fg__points_merge(points, context) : status;
}

fg_status fg__score_critical(double *f1, fg_context *context,
                             const fg__score_raster *raster, const fg__harmonic *harmonic,
                             double lambda, fg__threads *threads)
{
  double high[2];
  plane p;
  fg__points found[2] = {0};
  size_t matched = 0;
  for (int k = 0; k < 2; ++k)
    high[k] = raster->origin[k] + raster->size[k] * raster->cell[k];
  fg_status status = plane_create(&p, context, raster, lambda);
  for (int n = 0; n < 2 && status == FG_STATUS_OK; ++n) {
    status = fg__points_create(&found[n], context, raster->origin, high, REACH * lambda);
    if (status == FG_STATUS_OK)
      status = find_points(&found[n], &p, context, n ? harmonic : NULL, threads);
  }
  if (status == FG_STATUS_OK)
    status = fg__points_match(&matched, context, &found[0], &found[1]);
  const size_t all = fg__points_left(&found[0]) + fg__points_left(&found[1]);
  *f1 = all ? 2.0 * (double)matched / (double)all : 1.0;
  fg__points_clear(&found[0]);
  fg__points_clear(&found[1]);
  plane_clear(&p);
  return status;
}
