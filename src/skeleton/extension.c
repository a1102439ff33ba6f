#include "skeleton/extension.h"

#include <math.h>

/* A way on from the end of a line: a circular arc, after a quarter turn straight. */
typedef struct way_on {
  double from[2], direction[2];
  double turn; /* curvature, to the left */
} way_on;

static const double quarter_turn = 1.57079632679489661923;

static void arc_point(const way_on *arc, double length, double point[2])
{
  double bent = arc->turn != 0.0 ? fmin(length, quarter_turn / fabs(arc->turn)) : 0.0;
  double angle = bent * arc->turn;
  double along = bent > 0.0 ? sin(angle) / arc->turn : 0.0;
  double aside = bent > 0.0 ? (1.0 - cos(angle)) / arc->turn : 0.0;
  along += (length - bent) * cos(angle);
  aside += (length - bent) * sin(angle);
  point[0] = arc->from[0] + along * arc->direction[0] - aside * arc->direction[1];
  point[1] = arc->from[1] + along * arc->direction[1] + aside * arc->direction[0];
}

static bool is_inside(const fg__window *window, const double point[2])
{
  return fg__window_level(window, point) > 0.0;
}

/* The length at which an arc from inside leaves the cluster, less at most a thousandth of
 * a cell. */
static double length_inside(const fg__window *window, const way_on *arc)
{
  double step = 0.25 * fmin(window->spacing[0], window->spacing[1]);
  double inside = 0.0;
  double outside = step;
  double point[2];
  for (;; outside += step) {
    arc_point(arc, outside, point);
    if (!is_inside(window, point))
      break;
    inside = outside;
  }
  while (outside - inside > 4e-3 * step) {
    double middle = 0.5 * (inside + outside);
    arc_point(arc, middle, point);
    *(is_inside(window, point) ? &inside : &outside) = middle;
  }
  return inside;
}

static double between(const double a[2], const double b[2])
{
  return hypot(b[0] - a[0], b[1] - a[1]);
}

/* The last point before `from` that is at least `base` away from it, else the first. */
static int point_before(const fg__polyline *line, int from, double base)
{
  int k = from;
  while (k > 0 && between(line->point[k], line->point[from]) < base)
    --k;
  return k;
}

/* The arc on which the last point and those `base` and twice `base` before it lie. It
 * bends at most with the radius of twice `widest`, as the ridge of a cluster so wide can
 * without being blunt. False when there is but one point. */
static bool fit_arc(way_on *arc, const fg__polyline *line, double base, double widest)
{
  int last = line->count - 1;
  int middle = point_before(line, last, base);
  const double *c = line->point[last];
  const double *b = line->point[middle];
  double length = between(b, c);
  if (!(length > 0.0))
    return false;
  double heading = atan2(c[1] - b[1], c[0] - b[0]);
  const double *a = line->point[point_before(line, middle, base)];
  double before = between(a, b);
  double turn = 0.0;
  if (before > 0.5 * base) {
    double change =
        remainder(heading - atan2(b[1] - a[1], b[0] - a[0]), 4.0 * quarter_turn);
    double most = 0.5 / widest;
    turn = fmin(fmax(2.0 * change / (length + before), -most), most);
  }
  heading += 0.5 * turn * length;
  arc->from[0] = c[0];
  arc->from[1] = c[1];
  arc->direction[0] = cos(heading);
  arc->direction[1] = sin(heading);
  arc->turn = turn;
  return true;
}

static bool extend_end(fg__polyline *line, const fg__signed_distance *field)
{
  const fg__window *window = field->window;
  while (line->count > 1 && !is_inside(window, line->point[line->count - 1]))
    --line->count;
  double h = fmax(window->spacing[0], window->spacing[1]);
  double distance = fg__signed_distance_at(field, line->point[line->count - 1]);
  double base = fmax(distance, 2.0 * h);
  way_on arc;
  if (!fit_arc(&arc, line, base, base))
    return true;
  double length = length_inside(window, &arc);
  if (!(length > 0.0))
    return true;
  int pieces = (int)fmin(ceil(length / h), 1e6);
  for (int k = 1; k <= pieces; ++k) {
    double point[2];
    arc_point(&arc, length * k / pieces, point);
    if (!fg__polyline_add(line, point))
      return false;
  }
  return true;
}

bool fg__polyline_extend(fg__polyline *line, const fg__signed_distance *field)
{
  for (int side = 0; side < 2; ++side) {
    fg__polyline_reverse(line);
    if (!extend_end(line, field))
      return false;
  }
  return true;
}

/* Direction in which the nodes of the cluster lie spread widest. */
static void principal_axis(const fg__window *window, double direction[2])
{
  double count = 0.0;
  double mean[2] = {0.0, 0.0};
  double moment[3] = {0.0, 0.0, 0.0}; /* xx, xy, yy */
  for (int y = 0; y < window->nodes[1]; ++y) {
    for (int x = 0; x < window->nodes[0]; ++x) {
      if (!(window->level[y * window->nodes[0] + x] > 0.0F))
        continue;
      double place[2] = {x * window->spacing[0], y * window->spacing[1]};
      count += 1.0;
      mean[0] += place[0];
      mean[1] += place[1];
      moment[0] += place[0] * place[0];
      moment[1] += place[0] * place[1];
      moment[2] += place[1] * place[1];
    }
  }
  double xx = moment[0] - mean[0] * mean[0] / count;
  double xy = moment[1] - mean[0] * mean[1] / count;
  double yy = moment[2] - mean[1] * mean[1] / count;
  /* the grid alone spreads the nodes of a disc of ten cells by half a per cent */
  bool is_round = hypot(2.0 * xy, xx - yy) <= 0.01 * (xx + yy);
  double angle = is_round ? 0.0 : 0.5 * atan2(2.0 * xy, xx - yy);
  direction[0] = cos(angle);
  direction[1] = sin(angle);
}

bool fg__polyline_make_chord(fg__polyline *line, const fg__window *window,
                             const double middle[2])
{
  way_on arc = {.from = {middle[0], middle[1]}};
  principal_axis(window, arc.direction);
  double ahead = length_inside(window, &arc);
  arc.direction[0] = -arc.direction[0];
  arc.direction[1] = -arc.direction[1];
  double behind = length_inside(window, &arc);
  const double lengths[3] = {behind, 0.0, -ahead};
  line->count = 0;
  for (int k = 0; k < 3; ++k) {
    double point[2];
    arc_point(&arc, lengths[k], point);
    if ((k == 1 || lengths[k] != 0.0) && !fg__polyline_add(line, point))
      return false;
  }
  return true;
}
