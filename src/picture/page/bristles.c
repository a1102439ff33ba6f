#include "picture/page/bristles.h"

#include <math.h>

#include "base/mix.h"

/* What looks like paint, chosen by eye on the Mona Lisa at 512 pixels. Lengths are in
 * widths of the brush unless said otherwise. */
enum { MOST_BRISTLES = 12, LEAST_PIECES = 8, MOST_POINTS = 600 };
static const double pixels_a_bristle = 2.2;
static const double lightness_range = 0.085; /* of bristles about the stroke's colour */
static const double overlap = 1.5;           /* breadth of bristles by their distance */
static const double touch_range = 0.25, lift_range = 0.8; /* where bristles touch, lift */
static const double taper = 0.45;                         /* of a bristle's ends */
static const double ridge = 0.07;        /* breadth of the ridges of paint at the edges */
static const double ridge_opacity = 0.5; /* where they face the light or turn from it */
static const double ridge_light = 1.45, ridge_dark = 0.55;
static const double piece = 1.5; /* pixels between the points that are drawn */

/* Where the light comes from: above and left. */
static const double light[2] = {-0.6, -0.8};

/* A stroke's line, drawn smoothly through its points, with its normals. */
typedef struct track {
  int count;
  double point[MOST_POINTS][2], normal[MOST_POINTS][2], arc[MOST_POINTS];
  double length, width;
  double color[3]; /* of the stroke */
  fg__polygon_sink *sink;
  void *closure;
} track;

static double chance(uint64_t seed, int what)
{
  return (double)(fg__mix(seed ^ fg__mix((uint64_t)what)) >> 11) * 0x1p-53;
}

/* 0 before 0, 1 beyond 1, a quarter of a circle between. */
static double rounded(double share)
{
  double rest = 1.0 - fmin(fmax(share, 0.0), 1.0);
  return sqrt(1.0 - rest * rest);
}

/* Catmull and Rom's cubic between b and c. */
static double cubic(double a, double b, double c, double d, double t)
{
  return b + 0.5 * t *
                 (c - a +
                  t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

static void follow(track *t, const fg_stroke *stroke)
{
  const double(*p)[2] = stroke->points;
  int last = stroke->point_count - 1;
  double spacing = hypot(p[1][0] - p[0][0], p[1][1] - p[0][1]);
  double pieces = fmax(ceil(spacing * last / piece), LEAST_PIECES);
  t->count = (int)fmin(pieces, MOST_POINTS - 1.0) + 1;
  for (int m = 0; m < t->count; ++m) {
    double at = (double)last * m / (t->count - 1);
    int n = (int)at < last ? (int)at : last - 1;
    const double *a = p[n > 0 ? n - 1 : 0], *b = p[n];
    const double *c = p[n + 1], *d = p[n + 2 < last ? n + 2 : last];
    for (int k = 0; k < 2; ++k)
      t->point[m][k] = cubic(a[k], b[k], c[k], d[k], at - n);
  }
  t->width = stroke->width;
  t->length = 0.0;
  for (int n = 0; n < t->count; ++n) {
    const double *back = t->point[n > 0 ? n - 1 : 0];
    const double *on = t->point[n + 1 < t->count ? n + 1 : n];
    double x = on[0] - back[0], y = on[1] - back[1], norm = hypot(x, y);
    t->length += hypot(t->point[n][0] - back[0], t->point[n][1] - back[1]);
    t->arc[n] = t->length;
    t->normal[n][0] = norm > 0.0 ? -y / norm : 0.0;
    t->normal[n][1] = norm > 0.0 ? x / norm : 0.0;
  }
}

/* What one bristle leaves: from arc length `from` to `to`, its middle `offset` half
 * widths beside the line, `breadth` half widths to either side, tapering over `end` at
 * both ends. */
typedef struct trace {
  double from, to, offset, breadth, end;
} trace;

static void trace_point(const track *t, const trace *b, int n, double side, double out[2])
{
  double along = fmin(t->arc[n] - b->from, b->to - t->arc[n]);
  double beside =
      0.5 * t->width * (b->offset + side * b->breadth * rounded(along / b->end));
  for (int k = 0; k < 2; ++k)
    out[k] = t->point[n][k] + beside * t->normal[n][k];
}

/* Fills a trace in the stroke's colour, lighter or darker by a factor. */
static void fill_trace(const track *t, const trace *b, double factor, double opacity)
{
  int first = 0, last = t->count - 1, count = 0;
  while (first < last && t->arc[first + 1] <= b->from)
    ++first;
  while (last > first && t->arc[last - 1] >= b->to)
    --last;
  if (last - first < 1)
    return;
  double outline[2 * MOST_POINTS][2], color[3];
  for (int n = first; n <= last; ++n)
    trace_point(t, b, n, 1.0, outline[count++]);
  for (int n = last; n >= first; --n)
    trace_point(t, b, n, -1.0, outline[count++]);
  for (int k = 0; k < 3; ++k)
    color[k] = fmin(t->color[k] * factor, 1.0);
  t->sink(t->closure, (const double(*)[2])outline, count, color, opacity);
}

/* Paint piles up at the edges: light on the side of the light, dark on the other. */
static void paint_ridges(const track *t)
{
  int middle = t->count / 2;
  double facing = t->normal[middle][0] * light[0] + t->normal[middle][1] * light[1];
  for (int side = -1; side <= 1; side += 2) {
    trace b = {.from = 0.25 * t->width,
               .to = t->length - 0.6 * t->width,
               .offset = (1.0 - ridge) * side,
               .breadth = ridge,
               .end = t->width};
    if (b.to > b.from)
      fill_trace(t, &b, side * facing > 0.0 ? ridge_light : ridge_dark,
                 ridge_opacity * fabs(facing));
  }
}

static void paint_bristle(const track *t, uint64_t seed, int bristle, int bristles)
{
  int what = 3 * bristle;
  double middle = (2.0 * bristle + 1.0) / bristles - 1.0;
  double room = t->width * fmin(1.0, 0.4 * t->length / t->width);
  /* the brush is round: its sides touch later and lift sooner */
  double late = 0.3 * (1.0 - sqrt(1.0 - middle * middle));
  double touch = late + touch_range * chance(seed, what);
  double lift = late + lift_range * chance(seed, what + 1);
  double factor = 1.0 + lightness_range * (2.0 * chance(seed, what + 2) - 1.0);
  if (bristles == 1)
    touch = lift = 0.0;
  double breadth = fmin(overlap / bristles, 1.0);
  trace b = {.from = touch * room,
             .to = t->length - lift * room,
             .offset =
                 middle * fmax(1.0 - breadth, 0.0) / fmax(1.0 - 1.0 / bristles, 1e-9),
             .breadth = breadth,
             .end = taper * room};
  fill_trace(t, &b, factor, 1.0);
}

void fg__stroke_paint(const fg_stroke *stroke, fg__polygon_sink *sink, void *closure)
{
  track t = {.sink = sink, .closure = closure};
  for (int k = 0; k < 3; ++k)
    t.color[k] = stroke->color[k];
  follow(&t, stroke);
  int bristles = (int)(stroke->width / pixels_a_bristle);
  bristles = bristles < 1 ? 1 : bristles < MOST_BRISTLES ? bristles : MOST_BRISTLES;
  if (bristles > 1) {
    trace body = {.from = 0.1 * t.width,
                  .to = t.length - fmin(0.4 * t.width, 0.2 * t.length),
                  .breadth = 0.9,
                  .end = 0.7 * t.width};
    fill_trace(&t, &body, 1.0, 1.0);
  }
  /* in an order of their own, so that all do not overlap one way */
  int step = bristles % 2 ? 2 : bristles % 3 ? 3 : bristles % 5 ? 5 : 1;
  for (int n = 0; n < bristles; ++n)
    paint_bristle(&t, stroke->seed, n * step % bristles, bristles);
  if (bristles > 1)
    paint_ridges(&t);
}
