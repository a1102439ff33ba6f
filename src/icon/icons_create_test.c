#include "icon/bench_test.h"

#include <string.h>

static void uniform(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = 1.3 * cos(0.44);
  v[1] = 1.3 * sin(0.44);
}

static void drifting(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = 11 * cos(0.14);
  v[1] = 11 * sin(0.14);
}

static void sink(double x, double y, double v[2])
{
  v[0] = -(x - CORE[0]);
  v[1] = -(y - CORE[1]);
}

/* Its streamlines are ellipses, six times as long as wide. */
static void narrow_vortex(double x, double y, double v[2])
{
  v[0] = -36 * (y - CORE[1]);
  v[1] = x - CORE[0];
}

static void convergence(double x, double y, double v[2])
{
  (void)y;
  v[0] = -(x - CORE[0]);
  v[1] = 0.02;
}

static double capsule(double x, double y, double ax, double ay, double bx, double by,
                      double radius)
{
  double dx = bx - ax, dy = by - ay;
  double t = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy);
  t = fmin(fmax(t, 0), 1);
  return radius - hypot(x - ax - t * dx, y - ay - t * dy);
}

static double grain(double x, double y)
{
  return ellipse(x, y, 11, 19, 6.2, 2.1, 0.44);
}

static double disc(double x, double y)
{
  return 4 - hypot(x - CORE[0], y - CORE[1]);
}

static double ring(double x, double y)
{
  return 1.5 - fabs(hypot(x - CORE[0], y - CORE[1]) - 6.5);
}

static double branches(double x, double y)
{
  double stem = capsule(x, y, 0, 20, 10, 20, 1.3);
  double upper = capsule(x, y, 10, 20, 17, 25, 1.3);
  double lower = capsule(x, y, 10, 20, 16, 15.5, 1.3);
  return fmax(stem, fmax(upper, lower));
}

static double stripe(double x, double y)
{
  return capsule(x, y, -5, 20, 25, 20, 1.5);
}

static double boundary_slivers(double x, double y)
{
  double strip = 0.2 - fmax(y - 5, fabs(x - 4) - 2);       /* along the lower boundary */
  double corner = (1.1 - (30 - x) - (35 - y)) / sqrt(2.0); /* in the upper right one */
  double side = capsule(x, y, -10, 20, -10, 24, 0.3);      /* half of it outside */
  return fmax(strip, fmax(corner, side));
}

static double boundary_grain(double x, double y)
{
  return fmax(ellipse(x, y, -10, 21, 7, 3, 0.3), ellipse(x, y, 14, 5, 6, 2.5, 0.2));
}

static double lens(double x, double y)
{
  return ellipse(x, y, CORE[0], CORE[1], 8, 3, 0);
}

static double blob(double x, double y)
{
  return 5 - hypot(x - CORE[0] - 0.3, y - CORE[1] + 0.2);
}

/* A wall of 6 by 19, four grains of half axes 5 and 2, and a small one between two of
 * them. */
static double uneven_family(double x, double y)
{
  double d = fmin(3 - fabs(x - 2), 9.5 - fabs(y - 18));
  d = fmax(d, ellipse(x, y, -5, 31, 5, 2, 0.1));
  d = fmax(d, ellipse(x, y, 8, 32, 5, 2, -0.1));
  d = fmax(d, ellipse(x, y, 22, 31, 5, 2, 0.2));
  d = fmax(d, ellipse(x, y, 24, 8, 5, 2, 0));
  return fmax(d, ellipse(x, y, 15, 31.2, 1.2, 0.8, 0));
}

/* The one arrow of a bench with one cluster. */
static const fg_icon *only_icon(const test_bench *bench)
{
  assert_int_equal(fg_icons_clusters(bench->icons), 1);
  assert_int_equal(fg_icons_count(bench->icons), 1);
  return fg_icons_at(bench->icons, 0);
}

static double mean_radius(const fg_icon *icon)
{
  double sum = 0;
  for (int i = 0; i < icon->point_count; i++)
    sum += hypot(icon->points[i][0] - CORE[0], icon->points[i][1] - CORE[1]);
  return sum / icon->point_count;
}

static void runs_along_a_grain(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, grain);
  const fg_icon *icon = only_icon(&bench);
  assert_int_equal(icon->kind, FG_ICON_ARROW);
  assert_int_equal(icon->cluster, 1);
  assert_true(fg__icon_length(icon) > 0.95 * 12.4);
  assert_true(hypot(icon->center[0] - 11, icon->center[1] - 19) < SHAPE_SPACING);
  assert_true(fabs(icon->area / (PI * 6.2 * 2.1) - 1) < 0.02);
  assert_true(fabs(icon->speed - 1.3) < 1e-6);
  end_bench(&bench);
}

static void goes_round_a_vortex_core_at_half_radius(void **state)
{
  (void)state;
  test_bench bench = bench_of(vortex, disc);
  const fg_icon *icon = only_icon(&bench);
  assert_int_equal(icon->kind, FG_ICON_RING);
  double turning = icon_turning(icon); /* anticlockwise, like the vortex */
  assert_true(turning > 240 * PI / 180 && turning < 302 * PI / 180);
  assert_true(mean_radius(icon) > 0.4 * 4 && mean_radius(icon) < 0.75 * 4);
  end_bench(&bench);
}

static void goes_round_a_ring_but_for_a_gap(void **state)
{
  (void)state;
  test_bench bench = bench_of(vortex, ring);
  const fg_icon *icon = only_icon(&bench);
  assert_int_equal(icon->kind, FG_ICON_RING);
  double turning = icon_turning(icon);
  assert_true(turning > 270 * PI / 180 && turning < 302 * PI / 180);
  assert_true(fabs(mean_radius(icon) - 6.5) < 0.4);
  end_bench(&bench);
}

static void follows_a_horseshoe(void **state)
{
  (void)state;
  test_bench bench = bench_of(vortex, horseshoe);
  const fg_icon *icon = only_icon(&bench);
  assert_true(fg__icon_length(icon) > 1.05 * 7 * 2 * 1.92);
  assert_true(fabs(mean_radius(icon) - 7) < 0.4);
  end_bench(&bench);
}

static void keeps_the_spine(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, grain);
  const fg_icon *icon = only_icon(&bench);
  assert_true(icon->spine_count > 20); /* about 12 long, a point a cell */
  for (int n = 0; n < icon->spine_count; ++n)
    assert_true(grain(icon->spine[n][0], icon->spine[n][1]) > -0.1 * SHAPE_SPACING);
  const double *a = icon->spine[0], *b = icon->spine[icon->spine_count - 1];
  assert_true(hypot(a[0] - b[0], a[1] - b[1]) > 0.9 * 12.4);
  end_bench(&bench);
  bench = bench_of(vortex, ring);
  icon = only_icon(&bench);
  a = icon->spine[0], b = icon->spine[icon->spine_count - 1];
  assert_true(hypot(a[0] - b[0], a[1] - b[1]) < 1e-9);
  for (int n = 0; n < icon->spine_count; ++n)
    assert_true(fabs(hypot(icon->spine[n][0] - CORE[0], icon->spine[n][1] - CORE[1]) -
                     6.5) < 0.4);
  end_bench(&bench);
}

static void takes_one_branch_or_the_stem(void **state)
{
  (void)state;
  test_bench bench = bench_of(eastward, branches);
  const fg_icon *icon = only_icon(&bench);
  assert_true(fg__icon_length(icon) > 13); /* the stem and what lies before it */
  assert_true(fabs(icon->points[0][1] - 20) < 0.8);
  end_bench(&bench);
}

static void takes_the_longest_way_through_a_stripe(void **state)
{
  (void)state;
  test_bench bench = bench_of(drifting, stripe);
  const fg_icon *icon = only_icon(&bench);
  /* the flow crosses the stripe, 3 wide, at 0.14 radians */
  assert_true(fg__icon_length(icon) > 0.62 * 3 / sin(0.14));
  const double *tail = icon->points[0], *tip = icon->points[icon->point_count - 1];
  assert_true(fabs((tail[0] + tip[0]) / 2 - 10) < 3);
  end_bench(&bench);
}

/* 36.8 long and 0.8 wide. */
static double thread(double x, double y)
{
  return capsule(x, y, -8, 20, 28, 20, 0.4);
}

static void bends_little(double x, double y, double velocity[2])
{
  (void)y;
  velocity[0] = 1;
  velocity[1] = 0.01 * sin(0.5 * x);
}

static void fills_a_thin_cluster(void **state)
{
  (void)state;
  test_bench bench = bench_of(bends_little, thread);
  assert_true(fg__icon_length(only_icon(&bench)) > 0.95 * 36.8);
  end_bench(&bench);
}

static void drops_slivers_and_counts_them(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, boundary_slivers);
  assert_int_equal(fg_icons_count(bench.icons), 0);
  assert_int_equal(fg_icons_clusters(bench.icons), 3);
  assert_int_equal(fg_icons_dropped(bench.icons), 3);
  end_bench(&bench);
}

/* The stream crosses the wall, so that an arrow is near to a part of it only. */
static void each_cluster_has_one_however_large(void **state)
{
  (void)state;
  test_bench bench = bench_of(eastward, uneven_family);
  bool small = false, wall = false;
  assert_int_equal(fg_icons_clusters(bench.icons), 6);
  assert_int_equal(fg_icons_count(bench.icons), 6);
  for (int i = 0; i < 6; i++) {
    const fg_icon *icon = fg_icons_at(bench.icons, i);
    assert_int_equal(icon->cluster, i + 1);
    small = small || fabs(icon->area / (PI * 1.2 * 0.8) - 1) < 0.1;
    wall = wall || fabs(icon->area / (6 * 19) - 1) < 0.02;
  }
  assert_true(small && wall);
  end_bench(&bench);
}

static void stays_inside_the_domain(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, boundary_grain);
  assert_int_equal(fg_icons_count(bench.icons), 2);
  for (int i = 0; i < 2; i++)
    assert_true(fg__icon_length(fg_icons_at(bench.icons, i)) > 4);
  end_bench(&bench);
}

static void never_enters_a_mask(void **state)
{
  (void)state;
  unsigned char active[(SHAPE_NODES_X - 1) * (SHAPE_NODES_Y - 1)];
  memset(active, 1, sizeof active);
  /* the grain is cut between x = 12 and 12.5: cells 88 and 89 of every row */
  for (int j = 0; j < SHAPE_NODES_Y - 1; j++)
    active[j * (SHAPE_NODES_X - 1) + 88] = active[j * (SHAPE_NODES_X - 1) + 89] = 0;
  test_bench bench = bench_with(uniform, grain, active, 0);
  assert_true(fg_icons_count(bench.icons) == 2);
  for (int i = 0; i < 2; i++) {
    const fg_icon *icon = fg_icons_at(bench.icons, i);
    judge(&bench, icon, grain);
    double(*vertex)[2];
    int count;
    assert_int_equal(fg_icon_outline(icon, &vertex, &count), FG_STATUS_OK);
    for (int k = 0; k < count; k++)
      assert_true((vertex[k][0] < 12) == (icon->center[0] < 12) &&
                  !(vertex[k][0] >= 12 && vertex[k][0] <= 12.5));
    free(vertex);
  }
  end_bench(&bench);
}

static void finds_a_way_past_a_stagnation_point(void **state)
{
  (void)state;
  velocity_of flows[] = {saddle, sink, shear, convergence};
  depth_of shapes[] = {blob, lens};
  for (int f = 0; f < 4; f++)
    for (int s = 0; s < 2; s++) {
      test_bench bench = bench_of(flows[f], shapes[s]);
      const fg_icon *icon = only_icon(&bench);
      assert_true(fg__icon_length(icon) > 3);
      assert_true(fabs(icon_turning(icon)) < PI / 2 + 0.1);
      end_bench(&bench);
    }
}

/* Parts that run against each other are well apart for the way between them: on a circle
 * by 0.6 of it, on this flow's streamlines, six times as long as wide, by 0.1. */
static void makes_no_hairpins(void **state)
{
  (void)state;
  depth_of shapes[] = {lens, blob, disc};
  for (int s = 0; s < 3; s++) {
    test_bench bench = bench_of(narrow_vortex, shapes[s]);
    const fg_icon *icon = only_icon(&bench);
    const double(*p)[3] = icon->points;
    for (int i = 0; i + 1 < icon->point_count; i++) {
      double way = 0;
      for (int k = i + 1; k + 1 < icon->point_count; k++) {
        way += hypot(p[k][0] - p[k - 1][0], p[k][1] - p[k - 1][1]);
        double a[2] = {p[i + 1][0] - p[i][0], p[i + 1][1] - p[i][1]};
        double b[2] = {p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1]};
        double cosine =
            (a[0] * b[0] + a[1] * b[1]) / hypot(a[0], a[1]) / hypot(b[0], b[1]);
        if (cosine < -0.8)
          assert_true(hypot(p[k][0] - p[i][0], p[k][1] - p[i][1]) > 0.28 * way);
      }
    }
    assert_true(fg__icon_length(icon) > 3);
    end_bench(&bench);
  }
}

/* Bends as tight as a cell of the data: the outlines are judged by bench_of. */
static void keeps_its_promises_in_a_rough_field(void **state)
{
  (void)state;
  depth_of shapes[] = {blob, lens, stripe, horseshoe, family};
  int drawn = 0;
  for (int i = 0; i < 5; i++) {
    test_bench bench = bench_of(rough, shapes[i]);
    drawn += fg_icons_count(bench.icons);
    end_bench(&bench);
  }
  assert_true(drawn >= 6); /* of 8 */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(runs_along_a_grain),
      cmocka_unit_test(goes_round_a_vortex_core_at_half_radius),
      cmocka_unit_test(goes_round_a_ring_but_for_a_gap),
      cmocka_unit_test(follows_a_horseshoe),
      cmocka_unit_test(keeps_the_spine),
      cmocka_unit_test(takes_one_branch_or_the_stem),
      cmocka_unit_test(takes_the_longest_way_through_a_stripe),
      cmocka_unit_test(fills_a_thin_cluster),
      cmocka_unit_test(drops_slivers_and_counts_them),
      cmocka_unit_test(each_cluster_has_one_however_large),
      cmocka_unit_test(stays_inside_the_domain),
      cmocka_unit_test(never_enters_a_mask),
      cmocka_unit_test(finds_a_way_past_a_stagnation_point),
      cmocka_unit_test(makes_no_hairpins),
      cmocka_unit_test(keeps_its_promises_in_a_rough_field),
  };
  return cmocka_run_group_tests_name("icon/icons_create", tests, NULL, NULL);
}
