/* Clusters that one arrow does not stand for. */
#include "icon/bench_test.h"

/* Four grains of area 31 far from what is tested. */
static double others(double x, double y)
{
  double d = ellipse(x, y, -5, 31, 5, 2, 0.1);
  d = fmax(d, ellipse(x, y, 8, 32, 5, 2, -0.1));
  d = fmax(d, ellipse(x, y, 22, 31, 5, 2, 0.2));
  return fmax(d, ellipse(x, y, 24, 8, 5, 2, 0));
}

static double box(double x, double y, double cx, double cy, double a, double b)
{
  return fmin(a - fabs(x - cx), b - fabs(y - cy));
}

static void northward(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = 0.4;
  v[1] = 7;
}

/* 6 by 19, across an eastward stream. */
static double wall(double x, double y)
{
  return box(x, y, 2, 18, 3, 9.5);
}

static double wall_among_others(double x, double y)
{
  return fmax(wall(x, y), others(x, y));
}

/* As large as a grain. */
static double small_among_others(double x, double y)
{
  return fmax(box(x, y, 2, 18, 2, 4), others(x, y));
}

/* Icons with their centres near a point, and what they stand for together. */
static int icons_near(const test_bench *bench, double x, double y, double reach,
                      double *area)
{
  int count = 0;
  *area = 0;
  for (int n = 0; n < fg_icons_count(bench->icons); n++) {
    const fg_icon *icon = fg_icons_at(bench->icons, n);
    if (hypot(icon->center[0] - x, icon->center[1] - y) < reach) {
      count++;
      *area += icon->area;
    }
  }
  return count;
}

static double gap_between(const fg_icon *a, const fg_icon *b)
{
  double gap = HUGE_VAL;
  for (int i = 0; i < a->point_count; i++)
    for (int k = 0; k < b->point_count; k++)
      gap = fmin(gap, hypot(a->points[i][0] - b->points[k][0],
                            a->points[i][1] - b->points[k][1]));
  return gap;
}

static void far_parts_have_arrows_of_their_own(void **state)
{
  (void)state;
  double area;
  test_bench bench = bench_of(eastward, wall_among_others);
  int count = icons_near(&bench, 2, 18, 10, &area);
  assert_int_equal(fg_icons_clusters(bench.icons), 5);
  assert_in_range(count, 2, 4);
  assert_int_equal(fg_icons_count(bench.icons), 4 + count);
  /* together they stand for the cluster */
  assert_true(fabs(area / (6 * 19) - 1) < 0.02);
  double mean = (6 * 19 + 4 * PI * 10) / 5;
  for (int n = 0; n < fg_icons_count(bench.icons); n++)
    for (int m = 0; m < n; m++) {
      const fg_icon *a = fg_icons_at(bench.icons, n), *b = fg_icons_at(bench.icons, m);
      if (a->cluster == b->cluster) {
        assert_true(gap_between(a, b) > 0.5 * sqrt(mean));
        assert_true(a->area > 0.1 * mean && b->area > 0.1 * mean);
      }
    }
  end_bench(&bench);
}

static void a_cluster_like_the_others_has_one(void **state)
{
  (void)state;
  double area;
  test_bench bench = bench_of(eastward, small_among_others);
  assert_int_equal(fg_icons_count(bench.icons), 5);
  assert_int_equal(icons_near(&bench, 2, 18, 4, &area), 1);
  assert_true(fabs(area / (4 * 8) - 1) < 0.02);
  end_bench(&bench);
}

/* One along the stream is followed from end to end. */
static void nor_does_a_long_arrow_leave_any(void **state)
{
  (void)state;
  double area;
  test_bench bench = bench_of(northward, wall_among_others);
  assert_int_equal(icons_near(&bench, 2, 18, 10, &area), 1);
  assert_true(fabs(area / (6 * 19) - 1) < 0.02);
  end_bench(&bench);
}

/* Beyond their clusters two of one might meet. */
static void territories_have_one_each(void **state)
{
  (void)state;
  test_bench bench =
      bench_reaching(eastward, wall_among_others, NULL, 1, FG_ICON_EXTENT_TERRITORY);
  assert_int_equal(fg_icons_count(bench.icons), 5);
  end_bench(&bench);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(far_parts_have_arrows_of_their_own),
      cmocka_unit_test(a_cluster_like_the_others_has_one),
      cmocka_unit_test(nor_does_a_long_arrow_leave_any),
      cmocka_unit_test(territories_have_one_each),
  };
  return cmocka_run_group_tests_name("icon/rest", tests, NULL, NULL);
}
