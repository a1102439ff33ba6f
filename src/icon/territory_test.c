#include "icon/shapes_test.h"

#include "icon/territory.h"

#include <string.h>

static const double DISC[3][3] = {{-3, 11, 2.1}, {4.5, 27, 3.2}, {19, 17, 1.4}};

static double discs(double x, double y)
{
  double depth = -HUGE_VAL;
  for (int i = 0; i < 3; i++)
    depth = fmax(depth, DISC[i][2] - hypot(x - DISC[i][0], y - DISC[i][1]));
  return depth;
}

/* Left and right of a wall, at unequal distances from it. */
static double pair(double x, double y)
{
  return fmax(2 - hypot(x - 4, y - 10), 2 - hypot(x - 16, y - 10));
}

typedef struct test_bench {
  fg_context *context;
  fg_density *density;
  fg__labels labels;
  fg__territories land;
} test_bench;

static test_bench bench_of(depth_of depth, const unsigned char *active)
{
  test_bench bench = {0};
  assert_int_equal(fg_context_create(&bench.context), FG_STATUS_OK);
  bench.density = density_of(bench.context, depth, active);
  const fg_density_arrays *arrays = fg_density_contents(bench.density);
  assert_int_equal(fg__labels_create(&bench.labels, bench.context, arrays), FG_STATUS_OK);
  assert_int_equal(
      fg__territories_create(&bench.land, bench.context, arrays, &bench.labels),
      FG_STATUS_OK);
  return bench;
}

static void end_bench(test_bench *bench)
{
  fg__territories_clear(&bench->land);
  fg__labels_clear(&bench->labels);
  fg_density_destroy(bench->density);
  fg_context_destroy(bench->context);
}

static int node_at(double x, double y)
{
  int i = (int)lround((x - SHAPE_ORIGIN[0]) / SHAPE_SPACING);
  int j = (int)lround((y - SHAPE_ORIGIN[1]) / SHAPE_SPACING);
  return j * SHAPE_NODES_X + i;
}

/* First order fast marching from a disc is late by about 0.4 spacings at 15 spacings. */
static void every_place_belongs_to_the_nearest_disc(void **state)
{
  (void)state;
  test_bench bench = bench_of(discs, NULL);
  assert_int_equal(bench.labels.count, 3);
  int label[3];
  for (int k = 0; k < 3; k++)
    label[k] = bench.labels.label[node_at(DISC[k][0], DISC[k][1])];
  int checked = 0;
  for (int j = 0; j < SHAPE_NODES_Y; j++)
    for (int i = 0; i < SHAPE_NODES_X; i++) {
      double x = SHAPE_ORIGIN[0] + SHAPE_SPACING * i;
      double y = SHAPE_ORIGIN[1] + SHAPE_SPACING * j;
      double away[3];
      int nearest = 0;
      for (int k = 0; k < 3; k++) {
        away[k] = fmax(hypot(x - DISC[k][0], y - DISC[k][1]) - DISC[k][2], 0);
        nearest = away[k] < away[nearest] ? k : nearest;
      }
      int node = j * SHAPE_NODES_X + i;
      assert_true(fabs(bench.land.distance[node] - away[nearest]) < 1.5 * SHAPE_SPACING);
      bool clear = true; /* of the border between two */
      for (int k = 0; k < 3; k++)
        clear = clear && (k == nearest || away[k] - away[nearest] > 2 * SHAPE_SPACING);
      if (!clear)
        continue;
      assert_int_equal(bench.land.owner[node], label[nearest]);
      checked++;
    }
  assert_true(checked > SHAPE_NODES_X * SHAPE_NODES_Y * 9 / 10);
  double area = 40.0 * 30.0;
  assert_true(fabs(bench.land.fair_share - sqrt(area / 3)) < 1e-9);
  end_bench(&bench);
}

/* The windows of two neighbours do not overlap, and leave no strip between them. */
static void windows_part_the_domain(void **state)
{
  (void)state;
  test_bench bench = bench_of(discs, NULL);
  fg__window window[3];
  double center[2] = {10, 20};
  for (int k = 0; k < 3; k++)
    assert_int_equal(
        fg__territory_window(&window[k], bench.context, &bench.land, k + 1, center, 100),
        FG_STATUS_OK);
  int none = 0, total = 0;
  for (double y = 5.03; y < 35; y += 0.11)
    for (double x = -9.98; x < 30; x += 0.13, total++) {
      double point[2] = {x, y};
      int owners = 0;
      for (int k = 0; k < 3; k++)
        owners += fg__window_level(&window[k], point) > 0;
      assert_true(owners <= 1);
      none += owners == 0;
    }
  assert_true(none < total / 500); /* at the places where three meet */
  /* half way between two discs, along the line through both centres */
  double dx = 7.5 / hypot(7.5, 16), dy = 16 / hypot(7.5, 16);
  double middle = (2.1 + hypot(7.5, 16) - 3.2) / 2;
  int first = bench.labels.label[node_at(-3, 11)] - 1;
  double before[2] = {-3 + (middle - 0.5 * SHAPE_SPACING) * dx,
                      11 + (middle - 0.5 * SHAPE_SPACING) * dy};
  double after[2] = {-3 + (middle + 0.5 * SHAPE_SPACING) * dx,
                     11 + (middle + 0.5 * SHAPE_SPACING) * dy};
  assert_true(fg__window_level(&window[first], before) > 0);
  assert_true(fg__window_level(&window[first], after) <= 0);
  for (int k = 0; k < 3; k++)
    fg__window_clear(&window[k]);
  end_bench(&bench);
}

/* A wall with a gap at the top: places behind it belong to the disc behind it, however
 * near the other one is. */
static void ways_lead_round_masks(void **state)
{
  (void)state;
  static unsigned char active[(SHAPE_NODES_X - 1) * (SHAPE_NODES_Y - 1)];
  memset(active, 1, sizeof active);
  /* x from 6.5 to 7, y from 5 to 30 */
  for (int j = 0; j < 100; j++)
    active[j * (SHAPE_NODES_X - 1) + 66] = active[j * (SHAPE_NODES_X - 1) + 67] = 0;
  test_bench bench = bench_of(pair, active);
  int left = bench.labels.label[node_at(4, 10)];
  int right = bench.labels.label[node_at(16, 10)];
  /* (7.5, 10): 1.5 from the left disc, but behind the wall */
  assert_int_equal(bench.land.owner[node_at(7.5, 10)], right);
  assert_true(fabs(bench.land.distance[node_at(7.5, 10)] - 6.5) < SHAPE_SPACING);
  assert_int_equal(bench.land.owner[node_at(6, 10)], left);
  assert_int_equal(bench.land.owner[node_at(6.75, 10)], 0); /* within the wall */
  /* above the wall both have their half, as the crow flies */
  assert_int_equal(bench.land.owner[node_at(8, 33)], left);
  assert_int_equal(bench.land.owner[node_at(12, 33)], right);
  end_bench(&bench);
}

/* Ways go round a periodic axis; windows end where the domain ends. */
static void goes_round_in_a_window_of_the_domain(void **state)
{
  (void)state;
  enum { N = 60, M = 31 };
  static float u[N * M];
  for (int j = 0; j < M; j++)
    for (int i = 0; i < N; i++) {
      double x = 2 + 0.5 * i, y = -4 + 0.5 * j;
      double one = 1.5 - hypot(x - 4, y - 3), two = 1.5 - hypot(x - 20, y - 3);
      u[j * N + i] = (float)fmax(fmin(fmax(one, two) / 0.5, 1), -1);
    }
  fg_density_arrays arrays = {.dimension = 2,
                              .nodes = {N, M, 1},
                              .origin = {2, -4, 0},
                              .spacing = {0.5, 0.5, 1},
                              .periodic = {true, false, false},
                              .u = u};
  test_bench bench = {0};
  assert_int_equal(fg_context_create(&bench.context), FG_STATUS_OK);
  assert_int_equal(fg_density_create_from_arrays(&bench.density, bench.context, &arrays),
                   FG_STATUS_OK);
  const fg_density_arrays *copy = fg_density_contents(bench.density);
  assert_int_equal(fg__labels_create(&bench.labels, bench.context, copy), FG_STATUS_OK);
  assert_int_equal(
      fg__territories_create(&bench.land, bench.context, copy, &bench.labels),
      FG_STATUS_OK);
  /* the period is 30: x = 30 lies 4 before the first disc's centre, 10 after the second's
   */
  int first = bench.labels.label[14 * N + 4];
  assert_int_equal(bench.land.owner[14 * N + 56], first);
  fg__window window;
  double center[2] = {4, 3};
  assert_int_equal(
      fg__territory_window(&window, bench.context, &bench.land, first, center, 1000),
      FG_STATUS_OK);
  assert_true(window.origin[0] >= 2);
  assert_true(window.origin[0] + (window.nodes[0] - 1) * 0.5 <= 32);
  double here[2] = {2.5, 3}, round[2] = {29, 3}, beyond[2] = {26, 3}, second[2] = {13, 3};
  assert_true(fg__window_level(&window, here) > 0);
  assert_true(fg__window_level(&window, round) > 0);
  assert_false(fg__window_level(&window, beyond) > 0);
  assert_false(fg__window_level(&window, second) > 0);
  fg__window_clear(&window);
  end_bench(&bench);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_place_belongs_to_the_nearest_disc),
      cmocka_unit_test(windows_part_the_domain),
      cmocka_unit_test(ways_lead_round_masks),
      cmocka_unit_test(goes_round_in_a_window_of_the_domain),
  };
  return cmocka_run_group_tests_name("icon/territory", tests, NULL, NULL);
}
