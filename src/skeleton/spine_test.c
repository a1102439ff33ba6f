#include "skeleton/spine_shapes_test.h"

static double disc(double x, double y)
{
  return 0.31 - hypot(x - 0.52, y - 0.47);
}

static void test_disc(void **state)
{
  (void)state;
  made made_spine = make_masked(disc, 0, NULL);
  assert_sound(&made_spine);
  const fg__spine *spine = &made_spine.spine;
  assert_false(spine->closed);
  assert_true(spine->length <= 2 * 0.31 + H);
  const double middle[2] = {0.52, 0.47};
  assert_true(between(spine->point[spine->center], middle) < 1.5 * H);
  assert_near(spine->distance[spine->center], 0.31, 1.5 * H);
  clear(&made_spine);
}

static void ellipse_axis(double t, double point[2])
{
  point[0] = 0.5 + (2 * t - 1) * 0.4 * 12 / 13;
  point[1] = 0.48 + (2 * t - 1) * 0.4 * 5 / 13;
}

static void test_ellipse(void **state)
{
  (void)state;
  made made_spine = make_along(ellipse, ellipse_axis, 0.3 * H, 0.8, 2 * H);
  const double middle[2] = {0.5, 0.48};
  assert_true(between(made_spine.spine.point[made_spine.spine.center], middle) < 1.5 * H);
  clear(&made_spine);
}

/* Sides 0.8 and 0.2, turned by atan(3/4): the ridge forks 0.1 before the ends. */
static double rectangle(double x, double y)
{
  double along = 0.8 * (x - 0.51) + 0.6 * (y - 0.49);
  double across = -0.6 * (x - 0.51) + 0.8 * (y - 0.49);
  return fmin(0.4 - fabs(along), 0.1 - fabs(across));
}

static void rectangle_axis(double t, double point[2])
{
  point[0] = 0.51 + (2 * t - 1) * 0.4 * 0.8;
  point[1] = 0.49 + (2 * t - 1) * 0.4 * 0.6;
}

static void test_rectangle(void **state)
{
  (void)state;
  made made_spine = make_along(rectangle, rectangle_axis, 0.75 * H, 0.8, 2 * H);
  clear(&made_spine);
}

static void horseshoe_axis(double t, double point[2])
{
  double length = 0.35 + 0.26 * pi + 0.25; /* legs of unequal length */
  double at = t * length;
  if (at < 0.35) {
    point[0] = 0.24;
    point[1] = 0.2 + at;
  } else if (at < 0.35 + 0.26 * pi) {
    double angle = pi - (at - 0.35) / 0.26;
    point[0] = 0.5 + 0.26 * cos(angle);
    point[1] = 0.55 + 0.26 * sin(angle);
  } else {
    point[0] = 0.76;
    point[1] = 0.55 - (at - 0.35 - 0.26 * pi);
  }
}

static double horseshoe(double x, double y)
{
  return stroke(horseshoe_axis, 0.09, x, y);
}

static void test_horseshoe(void **state)
{
  (void)state;
  made made_spine = make(horseshoe);
  const fg__spine *spine = &made_spine.spine;
  assert_false(spine->closed);
  for (int k = 0; k < spine->count; ++k) {
    double least = distance_to_line(horseshoe_axis, 4000, spine->point[k]);
    /* round caps add 0.09 at each end */
    assert_true(least < (spine->distance[k] > 0.085 ? 0.5 * H : 0.09 + 0.5 * H));
  }
  double length = 0.6 + 0.26 * pi;
  assert_true(spine->length > length + 0.09 && spine->length < length + 0.18 + 2 * H);
  clear(&made_spine);
}

/* Branches of 0.5, 0.4 and 0.25 that meet in (0.5, 0.45). */
static double branch(double angle, double length, double x, double y)
{
  double dx = x - 0.5;
  double dy = y - 0.45;
  double along = fmin(fmax(dx * cos(angle) + dy * sin(angle), 0.0), length);
  return 0.05 - hypot(dx - along * cos(angle), dy - along * sin(angle));
}

static double y_shape(double x, double y)
{
  return fmax(fmax(branch(2.2, 0.5, x, y), branch(0.5, 0.4, x, y)),
              branch(-1.5, 0.25, x, y));
}

static void test_longest_way_through_a_y(void **state)
{
  (void)state;
  made made_spine = make(y_shape);
  const fg__spine *spine = &made_spine.spine;
  assert_true(spine->length > 0.9 && spine->length < 0.9 + 2 * 0.05 + 2 * H);
  const double long_tip[2] = {0.5 + 0.5 * cos(2.2), 0.45 + 0.5 * sin(2.2)};
  const double other_tip[2] = {0.5 + 0.4 * cos(0.5), 0.45 + 0.4 * sin(0.5)};
  const double short_tip[2] = {0.5 + 0.25 * cos(-1.5), 0.45 + 0.25 * sin(-1.5)};
  assert_true(distance_to(spine, long_tip) < H);
  assert_true(distance_to(spine, other_tip) < H);
  assert_true(distance_to(spine, short_tip) > 0.2);
  clear(&made_spine);
}

static void stripe_axis(double t, double point[2])
{
  point[0] = 0.08 + 0.84 * t;
  point[1] = 0.5 + 0.25 * sin(2 * pi * t);
}

static double stripe(double x, double y)
{
  return stroke(stripe_axis, 0.05, x, y);
}

static void test_long_stripe(void **state)
{
  (void)state;
  made made_spine = make(stripe);
  const fg__spine *spine = &made_spine.spine;
  double length = 0.0;
  double last[2];
  stripe_axis(0.0, last);
  for (int m = 1; m <= 1000; ++m) {
    double point[2];
    stripe_axis(m / 1000.0, point);
    length += between(last, point);
    memcpy(last, point, sizeof last);
    if (m < 1000)
      assert_true(distance_to(spine, point) < 0.75 * H);
  }
  assert_true(spine->length > length && spine->length < length + 0.1 + 2 * H);
  const double middle[2] = {0.5, 0.5};
  assert_true(between(spine->point[spine->center], middle) < 2 * H);
  clear(&made_spine);
}

/* A cell and a half wide, askew. */
static double sliver(double x, double y)
{
  double along = 0.96 * (x - 0.5) + 0.28 * (y - 0.5);
  double across = -0.28 * (x - 0.5) + 0.96 * (y - 0.5);
  return fmin(0.75 * H - fabs(across), 0.3 - fabs(along));
}

static void sliver_axis(double t, double point[2])
{
  point[0] = 0.5 + (2 * t - 1) * 0.3 * 0.96;
  point[1] = 0.5 + (2 * t - 1) * 0.3 * 0.28;
}

static void test_sliver(void **state)
{
  (void)state;
  made made_spine = make_along(sliver, sliver_axis, 0.5 * H, 0.6, 3 * H);
  clear(&made_spine);
}

static void test_single_node(void **state)
{
  (void)state;
  float u[5 * 5];
  for (int k = 0; k < 25; ++k)
    u[k] = k == 12 ? 1.0F : -1.0F;
  fg_density_arrays density = {
      .dimension = 2, .nodes = {5, 5}, .spacing = {1.0, 1.0}, .u = u};
  fg__labels labels;
  made made_spine;
  double distance[25];
  label_arrays(&labels, &density);
  assert_int_equal(fg__window_create(&made_spine.window, NULL, &density, &labels, 1),
                   FG_STATUS_OK);
  assert_int_equal(fg__march(distance, NULL, &made_spine.window, true), FG_STATUS_OK);
  assert_int_equal(
      fg__spine_create(&made_spine.spine, NULL, &made_spine.window, distance),
      FG_STATUS_OK);
  assert_true(made_spine.spine.count >= 1);
  const double *center = made_spine.spine.point[made_spine.spine.center];
  assert_true(hypot(center[0] - 2.0, center[1] - 2.0) < 0.6);
  fg__labels_clear(&labels);
  clear(&made_spine);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_disc),
      cmocka_unit_test(test_ellipse),
      cmocka_unit_test(test_rectangle),
      cmocka_unit_test(test_horseshoe),
      cmocka_unit_test(test_longest_way_through_a_y),
      cmocka_unit_test(test_long_stripe),
      cmocka_unit_test(test_sliver),
      cmocka_unit_test(test_single_node),
  };
  return cmocka_run_group_tests_name("skeleton/spine", tests, NULL, NULL);
}
