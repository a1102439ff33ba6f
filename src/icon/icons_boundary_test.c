/* Arrows of clusters across periodic boundaries. */
#include "icon/bench_test.h"

#include <string.h>

/* A domain on [3, 43] x [-9, 11], round along x and, if asked for, along y. */
enum { N = 80, M = 40 };
static const double LOW[2] = {3, -9}, SIZE[2] = {40, 20};

typedef double (*round_depth)(double x, double y, const double center[2]);

static double nearest_copy(double x, double center, double period)
{
  return x - period * floor((x - center) / period + 0.5) - center;
}

/* 14 long, 5 wide. */
static double round_grain(double x, double y, const double center[2])
{
  return ellipse(nearest_copy(x, center[0], SIZE[0]), nearest_copy(y, center[1], SIZE[1]),
                 0, 0, 7, 2.5, 0.1);
}

/* All round, 3 wide and narrower at the centre. */
static double round_band(double x, double y, const double center[2])
{
  double dx = nearest_copy(x, center[0], SIZE[0]);
  return 1.5 - 0.7 * exp(-dx * dx / 9) - fabs(y - center[1]);
}

static test_bench round_bench(round_depth depth, const double center[2], bool both)
{
  float u[N * M], velocity[2][N * M];
  double axis[2][N];
  test_bench bench = {0};
  for (int i = 0; i < N; i++)
    axis[0][i] = LOW[0] + 0.5 * i;
  for (int j = 0; j < M; j++)
    axis[1][j] = LOW[1] + 0.5 * j;
  for (int j = 0; j < M; j++)
    for (int i = 0; i < N; i++) {
      double inside = depth(axis[0][i], axis[1][j], center);
      u[j * N + i] = (float)fmax(fmin(inside / 0.5, 1), -1);
      velocity[0][j * N + i] = -4;
      velocity[1][j * N + i] = -0.4F;
    }
  fg_field_arrays field = {.dimension = 2,
                           .size = {N, M, 1},
                           .axis = {axis[0], axis[1]},
                           .period = {SIZE[0], both ? SIZE[1] : 0, 0},
                           .velocity = {velocity[0], velocity[1]}};
  fg_density_arrays density = {.dimension = 2,
                               .nodes = {N, M, 1},
                               .origin = {LOW[0], LOW[1], 0},
                               .spacing = {0.5, 0.5, 1},
                               .periodic = {true, both, false},
                               .u = u};
  assert_int_equal(fg_context_create(&bench.context), FG_STATUS_OK);
  assert_int_equal(fg_field_create(&bench.field, bench.context, &field), FG_STATUS_OK);
  assert_int_equal(fg_density_create_from_arrays(&bench.density, bench.context, &density),
                   FG_STATUS_OK);
  assert_int_equal(
      fg_icons_create(&bench.icons, bench.context, bench.field, bench.density, NULL),
      FG_STATUS_OK);
  return bench;
}

/* Each outline lies in the domain and in the cluster; returns the arrows' length. */
static double judge_all(const test_bench *bench, round_depth depth,
                        const double center[2], bool both)
{
  double length = 0;
  for (int n = 0; n < fg_icons_count(bench->icons); n++) {
    const fg_icon *icon = fg_icons_at(bench->icons, n);
    double(*vertex)[2];
    int count;
    assert_int_equal(fg_icon_outline(icon, &vertex, &count), FG_STATUS_OK);
    assert_true(is_simple((const double(*)[2])vertex, count));
    for (int i = 0; i < count; i++) {
      assert_true(vertex[i][0] > LOW[0] && vertex[i][0] < LOW[0] + SIZE[0]);
      if (both)
        assert_true(vertex[i][1] > LOW[1] && vertex[i][1] < LOW[1] + SIZE[1]);
      assert_true(depth(vertex[i][0], vertex[i][1], center) > 0);
    }
    free(vertex);
    for (int k = 0; k < 2; k++)
      assert_true(icon->center[k] >= LOW[k] && icon->center[k] <= LOW[k] + SIZE[k]);
    assert_true(icon_tangency(icon, bench->field) < 0.5);
    length += fg__icon_length(icon);
  }
  return length;
}

/* Wherever the grain lies: where the boundary leaves a good part on either side each gets
 * an arrow of its own, else the larger part does, and no arrow crosses the boundary. */
static void no_arrow_crosses_a_periodic_boundary(void **state)
{
  (void)state;
  for (int n = 0; n < 40; n++) {
    const double center[2] = {3.1 + n, 0.7};
    double beside = fabs(nearest_copy(center[0], LOW[0], SIZE[0]));
    test_bench bench = round_bench(round_grain, center, false);
    int count = fg_icons_count(bench.icons);
    assert_int_equal(fg_icons_clusters(bench.icons), 1);
    assert_int_equal(fg_icons_dropped(bench.icons), 0);
    /* at 2.9 of 7 a quarter of an ellipse is left */
    if (beside < 2.3 || beside > 3.5)
      assert_int_equal(count, beside < 2.9 ? 2 : 1);
    double length = judge_all(&bench, round_grain, center, false), area = 0;
    assert_true(length > 0.6 * 14 && length < 14);
    for (int k = 0; k < count; k++) {
      const fg_icon *icon = fg_icons_at(bench.icons, k);
      assert_int_equal(icon->cluster, 1);
      area += icon->area;
    }
    assert_true(fabs(area / (PI * 7 * 2.5) - 1) < 0.03);
    end_bench(&bench);
  }
}

/* The grain with four small ones far from it. */
static double among_small_ones(double x, double y, const double center[2])
{
  double d = round_grain(x, y, center);
  for (int k = 0; k < 4; k++)
    d = fmax(d, ellipse(x, y, 20 + 4 * (k % 2), k < 2 ? -6 : 7, 1.6, 0.9, 0));
  return d;
}

/* What is a small part of a large cluster is worth an arrow where most are small. */
static void a_piece_as_large_as_other_clusters_has_an_arrow(void **state)
{
  (void)state;
  const double center[2] = {6.8, 0.7};
  for (int k = 0; k < 2; k++) {
    round_depth depth = k ? among_small_ones : round_grain;
    test_bench bench = round_bench(depth, center, false);
    assert_int_equal(fg_icons_clusters(bench.icons), k ? 5 : 1);
    assert_int_equal(fg_icons_count(bench.icons), k ? 6 : 1);
    judge_all(&bench, depth, center, false);
    end_bench(&bench);
  }
}

static void nor_a_corner_of_two(void **state)
{
  (void)state;
  const double center[2] = {3.4, -8.7};
  test_bench bench = round_bench(round_grain, center, true);
  assert_in_range(fg_icons_count(bench.icons), 1, 4);
  judge_all(&bench, round_grain, center, true);
  end_bench(&bench);
}

static void a_band_is_cut_at_the_boundary_too(void **state)
{
  (void)state;
  const double center[2] = {20, 1}; /* cut here: 17 to one side, 23 to the other */
  test_bench bench = round_bench(round_band, center, false);
  assert_int_equal(fg_icons_clusters(bench.icons), 1);
  assert_int_equal(fg_icons_count(bench.icons), 2);
  judge_all(&bench, round_band, center, false);
  end_bench(&bench);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_arrow_crosses_a_periodic_boundary),
      cmocka_unit_test(nor_a_corner_of_two),
      cmocka_unit_test(a_piece_as_large_as_other_clusters_has_an_arrow),
      cmocka_unit_test(a_band_is_cut_at_the_boundary_too),
  };
  return cmocka_run_group_tests_name("icon/icons_boundary", tests, NULL, NULL);
}
