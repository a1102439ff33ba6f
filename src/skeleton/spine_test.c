#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "skeleton/spine.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

/* Shapes on the unit square, positive inside; H is a cell of the grid they are put on. */
enum { N = 81 };
static const double H = 1.0 / (N - 1);

typedef double shape(double x, double y);

typedef struct made {
  fg__window window;
  fg__spine spine;
} made;

/* `turn`: 0 as it is, 1 turned by a quarter, 2 mirrored at x = 1/2, 3 at the diagonal. */
static void turned(int turn, double x, double y, double out[2])
{
  out[0] = turn == 1 ? y : turn == 2 ? 1.0 - x : turn == 3 ? y : x;
  out[1] = turn == 1 ? 1.0 - x : turn == 3 ? x : y;
}

static made make_masked(shape *level, int turn, const unsigned char *active)
{
  float *u = malloc(sizeof *u * N * N);
  for (int k = 0; k < N * N; ++k) {
    double place[2];
    turned(turn, k % N * H, k / N * H, place);
    u[k] = (float)(20.0 * level(place[0], place[1]));
  }
  fg_density_arrays density = {.dimension = 2,
                               .nodes = {N, N},
                               .spacing = {H, H},
                               .u = u,
                               .active = active,
                               .debris_area = 2 * H * H};
  fg__labels labels;
  made result;
  assert_int_equal(fg__labels_create(&labels, NULL, &density), FG_STATUS_OK);
  assert_int_equal(labels.count, 1);
  assert_int_equal(fg__window_create(&result.window, NULL, &density, &labels, 1),
                   FG_STATUS_OK);
  size_t nodes = (size_t)(result.window.nodes[0] * result.window.nodes[1]);
  double *distance = malloc(nodes * sizeof *distance);
  assert_int_equal(fg__march(distance, NULL, &result.window, true), FG_STATUS_OK);
  assert_int_equal(fg__spine_create(&result.spine, NULL, &result.window, distance),
                   FG_STATUS_OK);
  free(distance);
  free(u);
  fg__labels_clear(&labels);
  return result;
}

static void clear(made *made_spine)
{
  fg__window_clear(&made_spine->window);
  fg__spine_clear(&made_spine->spine);
}

static double between(const double a[2], const double b[2])
{
  return hypot(a[0] - b[0], a[1] - b[1]);
}

static double side_of(const double a[2], const double b[2], const double c[2])
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool segments_cross(const double a[2], const double b[2], const double c[2],
                           const double d[2])
{
  return side_of(a, b, c) * side_of(a, b, d) < 0.0 &&
         side_of(c, d, a) * side_of(c, d, b) < 0.0;
}

/* What every spine promises. */
static void assert_sound(const made *made_spine)
{
  const fg__spine *spine = &made_spine->spine;
  assert_true(spine->count >= 1);
  assert_in_range(spine->center, 0, spine->count - 1);
  int segments = spine->closed ? spine->count : spine->count - 1;
  double length = 0.0;
  for (int k = 0; k < segments; ++k) {
    const double *a = spine->point[k];
    const double *b = spine->point[(k + 1) % spine->count];
    double piece = between(a, b);
    length += piece;
    assert_true(piece < 1.7 * H);
    assert_true(spine->count < 4 || piece > 0.5 * H);
    for (int m = k + 2; m < segments; ++m)
      assert_false(
          segments_cross(a, b, spine->point[m], spine->point[(m + 1) % spine->count]));
  }
  assert_near(length, spine->length, 1e-9);
  for (int k = 0; k < spine->count; ++k) {
    bool end = !spine->closed && (k == 0 || k == spine->count - 1);
    double level = fg__window_level(&made_spine->window, spine->point[k]);
    if (!end)
      assert_true(level > -0.5);
    else if (spine->count > 2)
      assert_true(spine->distance[k] < H); /* it goes on to the border */
  }
  if (!spine->closed)
    assert_in_range(2 * spine->center, spine->count - 2, spine->count);
}

static double distance_to(const fg__spine *spine, const double point[2])
{
  double least = HUGE_VAL;
  int segments = spine->closed ? spine->count : spine->count - 1;
  for (int k = 0; k < segments; ++k) {
    const double *a = spine->point[k];
    const double *b = spine->point[(k + 1) % spine->count];
    double square = pow(between(a, b), 2);
    double share =
        ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / square;
    share = fmin(fmax(share, 0.0), 1.0);
    const double foot[2] = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    least = fmin(least, between(point, foot));
  }
  return least;
}

/* The spine of the turned and mirrored shape is the turned and mirrored spine. */
static made make(shape *level)
{
  made first = make_masked(level, 0, NULL);
  assert_sound(&first);
  for (int turn = 1; turn <= 3; ++turn) {
    made other = make_masked(level, turn, NULL);
    assert_sound(&other);
    assert_int_equal(other.spine.closed, first.spine.closed);
    assert_near(other.spine.length, first.spine.length, 0.02 * first.spine.length + H);
    for (int k = 0; k < other.spine.count; ++k) {
      double place[2];
      turned(turn, other.spine.point[k][0], other.spine.point[k][1], place);
      /* ends may differ more: where nodes tie, their order decides */
      bool end = !other.spine.closed && (k < 5 || k >= other.spine.count - 5);
      assert_true(distance_to(&first.spine, place) < (end ? H : 0.5 * H));
    }
    clear(&other);
  }
  return first;
}

/* The largest distance of a point of the spine from a line of points, given as a function
 * of its parameter. */
typedef void curve(double t, double point[2]);

static double farthest_from(const fg__spine *spine, curve *line)
{
  double most = 0.0;
  for (int k = 0; k < spine->count; ++k) {
    double least = HUGE_VAL;
    for (int m = 0; m <= 4000; ++m) {
      double point[2];
      line(m / 4000.0, point);
      least = fmin(least, between(point, spine->point[k]));
    }
    most = fmax(most, least);
  }
  return most;
}

static const double pi = 3.14159265358979323846;

static double stroke(curve *line, double width, double x, double y)
{
  const double place[2] = {x, y};
  double least = HUGE_VAL;
  for (int m = 0; m <= 300; ++m) {
    double point[2];
    line(m / 300.0, point);
    least = fmin(least, between(point, place));
  }
  return width - least;
}

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

/* Half axes 0.4 and 0.13, turned by atan(5/12). */
static double ellipse(double x, double y)
{
  double along = (12 * (x - 0.5) + 5 * (y - 0.48)) / 13;
  double across = (-5 * (x - 0.5) + 12 * (y - 0.48)) / 13;
  return 0.13 - hypot(along * 0.13 / 0.4, across);
}

static void ellipse_axis(double t, double point[2])
{
  point[0] = 0.5 + (2 * t - 1) * 0.4 * 12 / 13;
  point[1] = 0.48 + (2 * t - 1) * 0.4 * 5 / 13;
}

static void test_ellipse(void **state)
{
  (void)state;
  made made_spine = make(ellipse);
  assert_true(farthest_from(&made_spine.spine, ellipse_axis) < 0.3 * H);
  assert_near(made_spine.spine.length, 0.8, 2 * H);
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
  made made_spine = make(rectangle);
  assert_true(farthest_from(&made_spine.spine, rectangle_axis) < 0.75 * H);
  assert_near(made_spine.spine.length, 0.8, 2 * H);
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
    double least = HUGE_VAL;
    for (int m = 0; m <= 4000; ++m) {
      double point[2];
      horseshoe_axis(m / 4000.0, point);
      least = fmin(least, between(point, spine->point[k]));
    }
    /* round caps add 0.09 at each end */
    assert_true(least < (spine->distance[k] > 0.085 ? 0.5 * H : 0.09 + 0.5 * H));
  }
  double length = 0.6 + 0.26 * pi;
  assert_true(spine->length > length + 0.09 && spine->length < length + 0.18 + 2 * H);
  clear(&made_spine);
}

static double ring(double x, double y)
{
  return 0.07 - fabs(hypot(x - 0.51, y - 0.48) - 0.3);
}

static void test_ring(void **state)
{
  (void)state;
  made made_spine = make(ring);
  const fg__spine *spine = &made_spine.spine;
  assert_true(spine->closed);
  assert_near(spine->length, 2 * pi * 0.3, 0.01 * 2 * pi * 0.3);
  for (int k = 0; k < spine->count; ++k) {
    assert_near(hypot(spine->point[k][0] - 0.51, spine->point[k][1] - 0.48), 0.3,
                0.2 * H);
    assert_near(spine->distance[k], 0.07, 0.5 * H);
  }
  clear(&made_spine);
}

static double thin_ring(double x, double y)
{
  return 0.8 * H - fabs(hypot(x - 0.51, y - 0.48) - 0.3);
}

static void test_thin_ring(void **state)
{
  (void)state;
  made made_spine = make(thin_ring);
  assert_true(made_spine.spine.closed);
  for (int k = 0; k < made_spine.spine.count; ++k)
    assert_near(
        hypot(made_spine.spine.point[k][0] - 0.51, made_spine.spine.point[k][1] - 0.48),
        0.3, 0.5 * H);
  clear(&made_spine);
}

/* 300 degrees of a ring. */
static void open_ring_axis(double t, double point[2])
{
  double angle = (0.4 + (2 * pi - pi / 3) * t);
  point[0] = 0.51 + 0.3 * cos(angle);
  point[1] = 0.48 + 0.3 * sin(angle);
}

static double open_ring(double x, double y)
{
  return stroke(open_ring_axis, 0.06, x, y);
}

static void test_ring_with_a_gap(void **state)
{
  (void)state;
  made made_spine = make(open_ring);
  const fg__spine *spine = &made_spine.spine;
  assert_false(spine->closed);
  assert_true(spine->length > 0.3 * (2 * pi - pi / 3) + 0.06);
  for (int k = 0; k < spine->count; ++k) {
    double off = fabs(hypot(spine->point[k][0] - 0.51, spine->point[k][1] - 0.48) - 0.3);
    assert_true(off < (spine->distance[k] > 0.057 ? 0.3 * H : 0.04));
  }
  clear(&made_spine);
}

/* A ring with a short tail goes round; a long stripe with a small hole goes through. */
static double ring_with_tail(double x, double y)
{
  double tail = fmin(0.05 - fabs(y - 0.48), 0.2 - fabs(x - 0.81));
  return fmax(0.07 - fabs(hypot(x - 0.41, y - 0.48) - 0.25), fmin(tail, x - 0.6));
}

static double stripe_with_hole(double x, double y)
{
  double stripe = fmin(0.11 - fabs(y - 0.47), 0.42 - fabs(x - 0.5));
  return fmin(stripe, hypot(x - 0.61, y - 0.47) - 0.045);
}

static void test_holes(void **state)
{
  (void)state;
  made made_spine = make_masked(ring_with_tail, 0, NULL);
  assert_sound(&made_spine);
  assert_true(made_spine.spine.closed);
  assert_near(made_spine.spine.length, 2 * pi * 0.25, 0.1 * 2 * pi * 0.25);
  clear(&made_spine);
  made_spine = make_masked(stripe_with_hole, 0, NULL);
  assert_sound(&made_spine);
  assert_false(made_spine.spine.closed);
  assert_true(made_spine.spine.length > 0.84 - 2 * H);
  const double hole[2] = {0.61, 0.47};
  assert_true(distance_to(&made_spine.spine, hole) > 0.055);
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
  made made_spine = make(sliver);
  assert_true(farthest_from(&made_spine.spine, sliver_axis) < 0.5 * H);
  assert_near(made_spine.spine.length, 0.6, 3 * H);
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
  assert_int_equal(fg__labels_create(&labels, NULL, &density), FG_STATUS_OK);
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

/* A quarter of a disc in the domain's corner. */
static double corner(double x, double y)
{
  return 0.4 - hypot(x, 1.2 * y);
}

static void test_corner(void **state)
{
  (void)state;
  made made_spine = make(corner);
  const fg__spine *spine = &made_spine.spine;
  const double *center = spine->point[spine->center];
  assert_true(center[0] > 0.08 && center[0] < 0.25);
  assert_true(center[1] > 0.08 && center[1] < 0.25);
  assert_true(spine->length > 0.3);
  clear(&made_spine);
}

/* Askew across the whole domain: the spine meets its borders in the middle of the cut. */
static double across_domain(double x, double y)
{
  return 0.1 - fabs((y - 0.45) * 0.9 + (x - 0.5) * 0.43589);
}

static void across_domain_axis(double t, double point[2])
{
  point[0] = t;
  point[1] = 0.45 - (t - 0.5) * 0.43589 / 0.9;
}

static void test_stripe_cut_by_the_domain(void **state)
{
  (void)state;
  made made_spine = make(across_domain);
  assert_true(farthest_from(&made_spine.spine, across_domain_axis) < 0.75 * H);
  assert_near(made_spine.spine.length, 1.0 / 0.9, 2 * H);
  clear(&made_spine);
}

/* Along the border: the spine runs half way between it and the cluster's own border. */
static double along_border(double x, double y)
{
  return 0.16 - hypot(0.16 / 0.42 * (x - 0.5), y);
}

static void test_cluster_along_the_domain(void **state)
{
  (void)state;
  made made_spine = make(along_border);
  const fg__spine *spine = &made_spine.spine;
  const double *center = spine->point[spine->center];
  assert_near(center[0], 0.5, 1.5 * H);
  assert_near(center[1], 0.08, 0.75 * H);
  assert_true(spine->length > 0.7);
  clear(&made_spine);
}

/* A mask cuts the ellipse: nothing of the spine lies in it. */
static void test_cut_by_a_mask(void **state)
{
  (void)state;
  unsigned char active[(N - 1) * (N - 1)];
  for (int k = 0; k < (N - 1) * (N - 1); ++k) {
    double x = (k % (N - 1) + 0.5) * H;
    double y = (k / (N - 1) + 0.5) * H;
    active[k] = hypot(x - 0.55, y - 0.68) > 0.2;
  }
  made made_spine = make_masked(ellipse, 0, active);
  assert_sound(&made_spine);
  const fg__spine *spine = &made_spine.spine;
  assert_true(spine->length > 0.7);
  for (int k = 1; k + 1 < spine->count; ++k) {
    int cell_x = (int)(spine->point[k][0] / H);
    int cell_y = (int)(spine->point[k][1] / H);
    assert_true(active[cell_y * (N - 1) + cell_x]);
    assert_true(hypot(spine->point[k][0] - 0.55, spine->point[k][1] - 0.68) > 0.2 - H);
  }
  clear(&made_spine);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_disc),
      cmocka_unit_test(test_ellipse),
      cmocka_unit_test(test_rectangle),
      cmocka_unit_test(test_horseshoe),
      cmocka_unit_test(test_ring),
      cmocka_unit_test(test_thin_ring),
      cmocka_unit_test(test_ring_with_a_gap),
      cmocka_unit_test(test_holes),
      cmocka_unit_test(test_longest_way_through_a_y),
      cmocka_unit_test(test_long_stripe),
      cmocka_unit_test(test_sliver),
      cmocka_unit_test(test_single_node),
      cmocka_unit_test(test_corner),
      cmocka_unit_test(test_stripe_cut_by_the_domain),
      cmocka_unit_test(test_cluster_along_the_domain),
      cmocka_unit_test(test_cut_by_a_mask),
  };
  return cmocka_run_group_tests_name("skeleton/spine", tests, NULL, NULL);
}
