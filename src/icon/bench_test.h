/* Icons of clusters and flows from formulas, and what holds for every arrow. */
#ifndef FG__ICON_BENCH_TEST_H
#define FG__ICON_BENCH_TEST_H

#include "icon/shapes_test.h"

static const double CORE[2] = {9.3, 21.7};
static const double PI = 3.141592653589793;

/* Flows are linear, so that the samples carry them exactly; shapes are signed depths. */

static inline void eastward(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = 0.02;
  v[1] = 0;
}

static inline void vortex(double x, double y, double v[2])
{
  v[0] = -2 * (y - CORE[1]);
  v[1] = 2 * (x - CORE[0]);
}

static inline void saddle(double x, double y, double v[2])
{
  v[0] = x - CORE[0];
  v[1] = -(y - CORE[1]);
}

static inline void shear(double x, double y, double v[2])
{
  (void)x;
  v[0] = y - CORE[1];
  v[1] = 0;
}

/* Directions that differ by up to 70 degrees from sample to sample. */
static inline void rough(double x, double y, double v[2])
{
  double angle = 1.2 * sin(12.9898 * x + 78.233 * y + 40 * sin(3.1 * x - 1.7 * y));
  v[0] = 5 * cos(angle);
  v[1] = 5 * sin(angle);
}

/* An ellipse of half axes a and b, tilted; depth to first order. */
static inline double ellipse(double x, double y, double cx, double cy, double a, double b,
                             double tilt)
{
  double p = ((x - cx) * cos(tilt) + (y - cy) * sin(tilt)) / a;
  double q = (-(x - cx) * sin(tilt) + (y - cy) * cos(tilt)) / b;
  double r = hypot(p, q);
  double slope = r > 0 ? hypot(p / a, q / b) / r : 1 / a;
  return (1 - r) / slope;
}

/* 220 degrees of a ring, its ends rounded */
static inline double horseshoe(double x, double y)
{
  double half = 1.92, radius = 7;
  double angle = atan2(y - CORE[1], x - CORE[0]);
  if (fabs(angle) < half)
    return 1.4 - fabs(hypot(x - CORE[0], y - CORE[1]) - radius);
  double end = copysign(half, angle);
  return 1.4 - hypot(x - CORE[0] - radius * cos(end), y - CORE[1] - radius * sin(end));
}

static inline double family(double x, double y)
{
  double d = fmax(horseshoe(x, y), ellipse(x, y, 22, 10, 5, 1.6, 0.9));
  d = fmax(d, ellipse(x, y, -4, 12, 1.6, 4.4, 0.5));
  return fmax(d, ellipse(x, y, 10.1, 20.9, 2.6, 2.2, 0));
}

typedef struct test_bench {
  fg_context *context;
  fg_field *field;
  fg_density *density;
  fg_icons *icons;
} test_bench;

static inline test_bench bench_with(velocity_of velocity, depth_of depth,
                                    const unsigned char *active, int threads)
{
  test_bench bench = {0};
  assert_int_equal(fg_context_create(&bench.context), FG_STATUS_OK);
  bench.field = field_of(bench.context, velocity);
  bench.density = density_of(bench.context, depth, active);
  fg_icon_options options = {.extent = FG_EXTENT_CLUSTER, .threads = threads};
  assert_int_equal(
      fg_icons_create(&bench.icons, bench.context, bench.field, bench.density, &options),
      FG_STATUS_OK);
  return bench;
}

static inline void end_bench(test_bench *bench)
{
  fg_icons_destroy(bench->icons);
  fg_density_destroy(bench->density);
  fg_field_destroy(bench->field);
  fg_context_destroy(bench->context);
}

/* What holds for every arrow: simple, inside its cluster and the domain, along the flow,
 * not wider than its length allows, its centre on it. */
static inline void judge(const test_bench *bench, const fg_icon *icon, depth_of depth)
{
  double(*vertex)[2];
  int count;
  assert_int_equal(fg_icon_outline(icon, &vertex, &count), FG_STATUS_OK);
  assert_true(is_simple((const double(*)[2])vertex, count));
  assert_true(is_within((const double(*)[2])vertex, count, depth));
  for (int i = 0; i < count; i++) {
    assert_true(vertex[i][0] > -10 && vertex[i][0] < 30);
    assert_true(vertex[i][1] > 5 && vertex[i][1] < 35);
  }
  free(vertex);
  assert_true(icon_tangency(icon, bench->field) < 0.5);
  double length = fg__icon_length(icon);
  assert_true(length >= 3 * SHAPE_SPACING);
  assert_true(icon->head_width >= 1.2 * SHAPE_SPACING);
  assert_true(icon->width < 0.1 * length && icon->tail_width < icon->width);
  assert_true(icon->width >= 0.003 * length); /* a hairline of a thin cluster */
  double nearest = HUGE_VAL;
  for (int i = 0; i < icon->point_count; i++) {
    nearest = fmin(nearest, hypot(icon->points[i][0] - icon->center[0],
                                  icon->points[i][1] - icon->center[1]));
    assert_true(icon->points[i][2] == 0);
  }
  assert_true(nearest < SHAPE_SPACING);
  assert_true(icon->speed > 0 && icon->area > 0);
}

static inline test_bench bench_of(velocity_of velocity, depth_of depth)
{
  test_bench bench = bench_with(velocity, depth, NULL, 0);
  for (int i = 0; i < fg_icons_count(bench.icons); i++)
    judge(&bench, fg_icons_at(bench.icons, i), depth);
  assert_int_equal(fg_icons_clusters(bench.icons),
                   fg_icons_count(bench.icons) + fg_icons_dropped(bench.icons));
  return bench;
}

#endif
