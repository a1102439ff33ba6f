/* Spines of clusters that the domain or a mask cuts. */
#include "skeleton/spine_shapes_test.h"

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

/* Askew across the whole domain: the spine meets its boundaries in the middle of the cut.
 */
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
  made made_spine =
      make_along(across_domain, across_domain_axis, 0.75 * H, 1.0 / 0.9, 2 * H);
  clear(&made_spine);
}

/* Along the boundary: the spine runs half way between it and the cluster's own boundary.
 */
static double along_boundary(double x, double y)
{
  return 0.16 - hypot(0.16 / 0.42 * (x - 0.5), y);
}

static void test_cluster_along_the_domain(void **state)
{
  (void)state;
  made made_spine = make(along_boundary);
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
      cmocka_unit_test(test_corner),
      cmocka_unit_test(test_stripe_cut_by_the_domain),
      cmocka_unit_test(test_cluster_along_the_domain),
      cmocka_unit_test(test_cut_by_a_mask),
  };
  return cmocka_run_group_tests_name("skeleton/spine_boundary", tests, NULL, NULL);
}
