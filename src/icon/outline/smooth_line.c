#include "icon/outline/smooth_line.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* Points in a reach, and the most of a line; a longer one is not a stroke. */
enum { IN_REACH = 20, MOST_POINTS = 4000 };

/* In widths of an icon: over how much of its line to either side kinks are averaged away,
 * and a line that this moves by less has none. */
static const double REACH = 10.0, LEAST = 0.1;

/* Over more of an even arc's radius it would be moved. */
static const double RADIUS_SHARE = 1.25;

static double length_of(const double (*points)[3], int count)
{
  double sum = 0.0;
  for (int n = 1; n < count; ++n)
    sum += hypot(points[n][0] - points[n - 1][0], points[n][1] - points[n - 1][1]);
  return sum;
}

/* `count` points at even distances along a line of a length. */
static void resample(double (*out)[3], int count, const double (*points)[3],
                     int point_count, double length)
{
  double start = 0.0; /* of the piece before point n */
  for (int k = 0, n = 1; k < count; ++k) {
    const double at = length * k / (count - 1);
    double piece =
        hypot(points[n][0] - points[n - 1][0], points[n][1] - points[n - 1][1]);
    for (; n + 1 < point_count && start + piece < at; ++n) {
      start += piece;
      piece = hypot(points[n + 1][0] - points[n][0], points[n + 1][1] - points[n][1]);
    }
    const double share = piece > 0.0 ? fmin((at - start) / piece, 1.0) : 0.0;
    for (int i = 0; i < 2; ++i)
      out[k][i] = points[n - 1][i] + share * (points[n][i] - points[n - 1][i]);
  }
}

/* The mean about point n over less than `reach` steps to either side. */
static void average(double out[2], const double (*points)[3], int n, double reach)
{
  const int most = (int)ceil(reach) - 1;
  double sum = 0.0, mean[2] = {0.0, 0.0};
  for (int k = -most; k <= most; ++k) {
    const double u = k / reach, one = 1.0 - u * u;
    const double weight = one * one * (1.0 - 3.0 * u * u);
    sum += weight;
    for (int i = 0; i < 2; ++i)
      mean[i] += weight * points[n + k][i];
  }
  for (int i = 0; i < 2; ++i)
    out[i] = mean[i] / sum;
}

/* How many steps to either side are averaged: on an arc at most so much of its radius. */
static double reach_at(const double (*points)[3], int count, int n)
{
  const int ends = n < count - 1 - n ? n : count - 1 - n;
  const int most = ends < IN_REACH ? ends : IN_REACH;
  const double *from = points[n - most], *here = points[n], *to = points[n + most];
  const double before[2] = {here[0] - from[0], here[1] - from[1]};
  const double after[2] = {to[0] - here[0], to[1] - here[1]};
  const double turn = fabs(atan2(before[0] * after[1] - before[1] * after[0],
                                 before[0] * after[0] + before[1] * after[1]));
  return 1.0 + fmin(most, RADIUS_SHARE * most / fmax(turn, 1e-6));
}

bool fg__smooth_line(double (**out)[3], int *count, const double (*points)[3],
                     int point_count, double reach, double least)
{
  const double length = length_of(points, point_count);
  *out = NULL;
  *count = 0;
  if (!(reach > 0.0) || !(length > 0.0) || length / reach * IN_REACH > MOST_POINTS)
    return true;
  const int samples = (int)ceil(length / reach * IN_REACH) + 1;
  double(*even)[3] = fg__allocate((size_t)samples, sizeof *even);
  double(*smooth)[3] = fg__allocate((size_t)samples, sizeof *smooth);
  const bool good = even && smooth;
  double most = 0.0;
  if (good)
    resample(even, samples, points, point_count, length);
  for (int n = 0; good && n < samples; ++n) {
    const double(*line)[3] = (const double(*)[3])even;
    average(smooth[n], line, n, reach_at(line, samples, n));
    most = fmax(most, hypot(smooth[n][0] - even[n][0], smooth[n][1] - even[n][1]));
  }
  if (good && most >= least) {
    *out = smooth;
    *count = samples;
    smooth = NULL;
  }
  free(even);
  free(smooth);
  return good;
}

bool fg__icon_smooth(double (**out)[3], int *count, const fg_icon *icon)
{
  *out = NULL;
  *count = 0;
  return icon->id == 0 || fg__smooth_line(out, count, icon->points, icon->point_count,
                                          REACH * icon->width, LEAST * icon->width);
}
