/* Arrows that go on through their territories. */
#include "icon/bench_test.h"

#include <string.h>

static double grains_in_line(double x, double y)
{
  return fmax(ellipse(x, y, -3, 20, 5, 1.8, 0), ellipse(x, y, 16, 20.3, 5, 1.8, 0));
}

static double everywhere(double x, double y)
{
  return fmin(fmin(x + 10, 30 - x), fmin(y - 5, 35 - y));
}

/* Two grains in line with the flow: their arrows go on until half way between them, are
 * not wider, and keep the other promises. */
static void goes_on_through_its_territory(void **state)
{
  (void)state;
  test_bench cluster = bench_with(eastward, grains_in_line, NULL, 0);
  test_bench wide =
      bench_reaching(eastward, grains_in_line, NULL, 0, FG_ICON_EXTENT_TERRITORY);
  assert_int_equal(fg_icons_count(cluster.icons), 2);
  assert_int_equal(fg_icons_count(wide.icons), 2);
  double fair_share = sqrt(40.0 * 30.0 / 2);
  for (int i = 0; i < 2; i++) {
    const fg_icon *a = fg_icons_at(cluster.icons, i), *b = fg_icons_at(wide.icons, i);
    judge(&wide, b, everywhere);
    assert_true(fg__icon_length(b) > 1.3 * fg__icon_length(a));
    assert_true(fg__icon_length(b) <= 2 * fair_share);
    assert_true(b->width <= a->width);
    assert_true(fabs(b->center[1] - a->center[1]) < SHAPE_SPACING);
    /* the grains end at 2 and 11: the border is at 6.5 */
    bool left = a->center[0] < 6.5;
    for (int k = 0; k < b->point_count; k++)
      assert_true((b->points[k][0] < 6.5) == left);
  }
  end_bench(&cluster);
  end_bench(&wide);
}

static void never_leaves_its_side_of_a_mask(void **state)
{
  (void)state;
  static unsigned char active[(SHAPE_NODES_X - 1) * (SHAPE_NODES_Y - 1)];
  memset(active, 1, sizeof active);
  /* x from 3.5 to 3.75, all the way: nearer to the left grain than to the right one */
  for (int j = 0; j < SHAPE_NODES_Y - 1; j++)
    active[j * (SHAPE_NODES_X - 1) + 54] = 0;
  test_bench bench =
      bench_reaching(eastward, grains_in_line, active, 0, FG_ICON_EXTENT_TERRITORY);
  assert_int_equal(fg_icons_count(bench.icons), 2);
  for (int i = 0; i < 2; i++) {
    const fg_icon *icon = fg_icons_at(bench.icons, i);
    bool left = icon->center[0] < 3.5;
    double(*vertex)[2];
    int count;
    assert_int_equal(fg_icon_outline(icon, &vertex, &count), FG_STATUS_OK);
    double reach = left ? -HUGE_VAL : HUGE_VAL;
    for (int k = 0; k < count; k++)
      reach = left ? fmax(reach, vertex[k][0]) : fmin(reach, vertex[k][0]);
    free(vertex);
    /* close to the mask, and not in it */
    assert_true(left ? reach <= 3.5 && reach > 2.5 : reach >= 3.75 && reach < 5);
  }
  end_bench(&bench);
}

static bool outlines_meet(const fg_icon *a, const fg_icon *b)
{
  double(*p)[2], (*q)[2];
  int m, n;
  assert_int_equal(fg_icon_outline(a, &p, &m), FG_STATUS_OK);
  assert_int_equal(fg_icon_outline(b, &q, &n), FG_STATUS_OK);
  bool meet = false;
  for (int i = 0; i < m; i++)
    for (int k = 0; k < n; k++)
      meet = meet || edges_cross(p[i], p[(i + 1) % m], q[k], q[(k + 1) % n]);
  free(p);
  free(q);
  return meet;
}

static void keeps_its_promises_in_territories(void **state)
{
  (void)state;
  velocity_of flows[] = {vortex, saddle, shear, rough};
  for (int f = 0; f < 4; f++) {
    test_bench bench =
        bench_reaching(flows[f], family, NULL, 2, FG_ICON_EXTENT_TERRITORY);
    int count = fg_icons_count(bench.icons);
    assert_true(count >= 3);
    for (int i = 0; i < count; i++) {
      judge(&bench, fg_icons_at(bench.icons, i), everywhere);
      for (int k = 0; k < i; k++)
        assert_false(
            outlines_meet(fg_icons_at(bench.icons, i), fg_icons_at(bench.icons, k)));
    }
    end_bench(&bench);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(goes_on_through_its_territory),
      cmocka_unit_test(never_leaves_its_side_of_a_mask),
      cmocka_unit_test(keeps_its_promises_in_territories),
  };
  return cmocka_run_group_tests_name("icon/icons_territory", tests, NULL, NULL);
}
