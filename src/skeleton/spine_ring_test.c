/* Spines that close, or nearly do. */
#include "skeleton/spine_shapes_test.h"

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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_ring),
      cmocka_unit_test(test_thin_ring),
      cmocka_unit_test(test_ring_with_a_gap),
      cmocka_unit_test(test_holes),
  };
  return cmocka_run_group_tests_name("skeleton/spine_ring", tests, NULL, NULL);
}
