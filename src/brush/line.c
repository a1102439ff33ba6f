#include "brush/line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "skeleton/spine.h"

/* Points lie that many widths of the brush apart. */
static const double spacing_share = 0.22;
/* A stroke goes on beyond its cluster by that share of the brush's width at either end.
 */
static const double overshoot = 0.35;
/* A shorter stroke would be a dot: its brush is narrowed. */
static const double least_aspect = 2.2;
/* Shares of the full width that are tried. */
static const double narrower[] = {1.0, 0.8, 0.64, 0.5, 0.4};

enum { SMOOTHING = 12 };

static double distance_between(const double a[3], const double b[3])
{
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

/* Half the brush's width: the mean of the upper half of distances along the spine. */
static double half_width(const fg__spine *spine)
{
  double sum = 0.0, most = 0.0, count = 0.0;
  for (int n = 0; n < spine->count; ++n)
    most = fmax(most, spine->distance[n]);
  for (int n = 0; n < spine->count; ++n)
    if (spine->distance[n] >= 0.5 * most) {
      sum += spine->distance[n];
      count += 1.0;
    }
  return count > 0.0 ? sum / count : most;
}

/* The spine's points with y downwards; of a ring nine tenths. */
static int copy_spine(double (*to)[2], const fg__spine *spine, double height)
{
  int count = spine->closed ? spine->count - spine->count / 10 : spine->count;
  int first = spine->closed ? spine->center + spine->count / 20 : 0;
  for (int n = 0; n < count; ++n) {
    const double *p = spine->point[(first + n) % spine->count];
    to[n][0] = p[0];
    to[n][1] = height - p[1];
  }
  return count;
}

/* Each inner point goes halfway to the middle of its neighbours. */
static void smooth(double (*point)[2], int count)
{
  for (int pass = 0; pass < SMOOTHING; ++pass) {
    double before[2] = {point[0][0], point[0][1]};
    for (int n = 1; n + 1 < count; ++n)
      for (int k = 0; k < 2; ++k) {
        double here = point[n][k];
        point[n][k] = 0.5 * here + 0.25 * (before[k] + point[n + 1][k]);
        before[k] = here;
      }
  }
}

static double length_of(double (*point)[2], int count)
{
  double length = 0.0;
  for (int n = 1; n < count; ++n)
    length += hypot(point[n][0] - point[n - 1][0], point[n][1] - point[n - 1][1]);
  return length;
}

/* The point at an arc length; before the first and behind the last straight on. */
static void point_at(double out[2], double (*point)[2], int count, double arc)
{
  int n = 0;
  double piece = hypot(point[1][0] - point[0][0], point[1][1] - point[0][1]);
  while (arc > piece && n + 2 < count) {
    arc -= piece;
    ++n;
    piece = hypot(point[n + 1][0] - point[n][0], point[n + 1][1] - point[n][1]);
  }
  double t = piece > 0.0 ? arc / piece : 0.0;
  for (int k = 0; k < 2; ++k)
    out[k] = point[n][k] + t * (point[n + 1][k] - point[n][k]);
}

/* Evenly spaced points from arc length `from` to `to`. */
static void resample(fg__brush_line *line, double (*point)[2], int count, double from,
                     double to)
{
  double pieces = ceil((to - from) / fmax(spacing_share * line->width, 0.5));
  line->count = (int)fmin(fmax(pieces, 2.0), FG__LINE_POINTS - 1.0) + 1;
  for (int n = 0; n < line->count; ++n)
    point_at(line->point[n], point, count, from + (to - from) * n / (line->count - 1));
}

/* Leaves the points about the middle whose colour is that of the middle. */
static void cut_at_edges(fg__brush_line *line, const fg__brush_canvas *image,
                         double tolerance)
{
  double middle[3], color[3];
  int center = line->count / 2, first = center, last = center;
  fg__canvas_color(middle, image, line->point[center]);
  for (; first > 0; --first) {
    fg__canvas_color(color, image, line->point[first - 1]);
    if (distance_between(color, middle) > tolerance)
      break;
  }
  for (; last + 1 < line->count; ++last) {
    fg__canvas_color(color, image, line->point[last + 1]);
    if (distance_between(color, middle) > tolerance)
      break;
  }
  line->count = last - first + 1;
  memmove(line->point, line->point + first, (size_t)line->count * sizeof line->point[0]);
}

static void find_color(fg__brush_line *line, const fg__brush_canvas *image)
{
  double color[3], sum[3] = {0.0, 0.0, 0.0};
  for (int n = 0; n < line->count; ++n) {
    fg__canvas_color(color, image, line->point[n]);
    for (int k = 0; k < 3; ++k)
      sum[k] += color[k];
  }
  for (int k = 0; k < 3; ++k)
    line->color[k] = sum[k] / line->count;
}

/* The point so many widths beside the n-th of a line. */
static void point_beside(double out[2], const fg__brush_line *line, int n, double offset)
{
  const double *a = line->point[n > 0 ? n - 1 : n];
  const double *b = line->point[n + 1 < line->count ? n + 1 : n];
  double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
  double share = length > 0.0 ? offset * line->width / length : 0.0;
  out[0] = line->point[n][0] - share * y;
  out[1] = line->point[n][1] + share * x;
}

/* By how much the mean colour along a side of the stroke differs from the line's. */
static double difference_beside(const fg__brush_line *line, const fg__brush_canvas *image,
                                double offset)
{
  double color[3], at[2], sum = 0.0;
  for (int n = 0; n < line->count; ++n) {
    point_beside(at, line, n, offset);
    fg__canvas_color(color, image, at);
    sum += distance_between(color, line->color);
  }
  return sum / line->count;
}

/* Narrows the brush until both sides have the line's colour. */
static void fit_width(fg__brush_line *line, const fg__brush_canvas *image,
                      double tolerance)
{
  double full = line->width;
  for (size_t n = 0; n < sizeof narrower / sizeof *narrower; ++n) {
    line->width = full * narrower[n];
    if (difference_beside(line, image, 0.42) <= tolerance &&
        difference_beside(line, image, -0.42) <= tolerance)
      return;
  }
}

static void shape_line(fg__brush_line *line, double (*point)[2], int count,
                       const fg__brush_canvas *image, const fg__line_rule *rule)
{
  smooth(point, count);
  double length = length_of(point, count), more = overshoot * line->width;
  if (!(length > 0.0))
    return;
  resample(line, point, count, -more, length + more);
  cut_at_edges(line, image, rule->tolerance);
  if (line->count < 2) {
    line->count = 0;
    return;
  }
  find_color(line, image);
  fit_width(line, image, rule->tolerance);
  length = length_of(line->point, line->count);
  line->width = fmin(line->width, length / least_aspect);
}

fg_status fg__line_create(fg__brush_line *out, fg_context *context,
                          const fg__window *window, const fg__brush_canvas *image,
                          const fg__line_rule *rule)
{
  size_t nodes = fg__window_count(window);
  double *distance = fg__allocate(nodes, sizeof *distance);
  double(*point)[2] = NULL;
  fg__spine spine = {0};
  out->count = 0;
  fg_status status = distance ? fg__march(distance, context, window, false)
                              : fg__fail_memory(context, "a stroke", nodes * 8);
  if (!status)
    status = fg__spine_create(&spine, context, window, distance);
  if (!status && spine.count > 1) {
    point = fg__allocate((size_t)spine.count, sizeof *point);
    if (!point)
      status = fg__fail_memory(context, "a stroke", (size_t)spine.count * 16);
  }
  if (point) {
    out->width = 2.0 * rule->widening * half_width(&spine);
    shape_line(out, point, copy_spine(point, &spine, image->height), image, rule);
  }
  free(distance);
  free(point);
  fg__spine_clear(&spine);
  return status;
}

double fg__line_difference(const fg__brush_line *line, const fg__brush_canvas *one,
                           const fg__brush_canvas *other)
{
  double a[3], b[3], at[2], most = 0.0;
  for (int side = -1; side <= 1; ++side) {
    double sum = 0.0;
    for (int n = 0; n < line->count; ++n) {
      point_beside(at, line, n, 0.25 * side);
      fg__canvas_color(a, one, at);
      fg__canvas_color(b, other, at);
      sum += distance_between(a, b);
    }
    most = fmax(most, sum / line->count);
  }
  return most;
}

bool fg__line_is_bare(const fg__brush_line *line, const fg__brush_canvas *painted)
{
  double at[2];
  for (int n = 1; n + 2 < line->count; ++n)
    for (int side = -1; side <= 1; ++side) {
      point_beside(at, line, n, 0.25 * side);
      if (fg__canvas_is_bare(painted, at))
        return true;
    }
  return false;
}
