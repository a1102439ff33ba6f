/* Territories of clusters, and arrows that go on through them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "icon/shapes_test.h"
#include "icon/territory.h"

enum { BALLS = 4, SIDE = 41, MOST_NODES = SIDE * SIDE * SIDE };

typedef struct balls {
  int dimension, nodes[3];
  bool periodic[3];
  double spacing[3], at[BALLS][3], radius[BALLS];

} balls;

static const balls SITUATIONS[] = {
    {2,
     {41, 31, 1},
     {false},
     {0.5, 0.5, 1.0},
     {{3, 3}, {15, 4}, {8, 11}, {17, 13}},
     {1.5, 1.0, 2.0, 0.8}},
    {2,
     {41, 31, 1},
     {true, false},
     {0.5, 0.4, 1.0},
     {{1, 3}, {12, 4}, {8, 9}, {19, 10}},
     {1.5, 1.0, 2.0, 1.2}},
    {3,
     {21, 17, 15},
     {false, false, true},
     {0.5, 0.5, 0.6},
     {{2, 2, 1}, {7, 6, 5}, {8, 2, 6}, {2, 6, 7}},
     {1.1, 1.2, 1.0, 1.3}},
};

static size_t nodes_of(const balls *b)
{
  return (size_t)b->nodes[0] * (size_t)b->nodes[1] * (size_t)b->nodes[2];
}

/* The distance from a node to a ball's surface; below 0 inside. */
static double distance_of(const balls *b, size_t node, int ball)
{
  const size_t row = (size_t)b->nodes[0], plane = row * (size_t)b->nodes[1];
  const size_t at[3] = {node % row, node % plane / row, node / plane};
  double sum = 0.0;
  for (int k = 0; k < b->dimension; ++k) {
    double d = fabs((double)at[k] * b->spacing[k] - b->at[ball][k]);
    const double period = b->nodes[k] * b->spacing[k];
    d = b->periodic[k] ? fmin(d, period - d) : d;
    sum += d * d;
  }
  return sqrt(sum) - b->radius[ball];
}

static fg_density *density_of_balls(fg_context *context, const balls *b, float *u)
{
  fg_density *density;
  for (size_t n = 0; n < nodes_of(b); ++n) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < BALLS; ++k)
      nearest = fmin(nearest, distance_of(b, n, k));
    u[n] = (float)fmax(fmin(-nearest, 1.0), -1.0);
  }
  const fg_density_arrays arrays = {
      .dimension = b->dimension,
      .nodes = {b->nodes[0], b->nodes[1], b->nodes[2]},
      .spacing = {b->spacing[0], b->spacing[1], b->spacing[2]},
      .periodic = {b->periodic[0], b->periodic[1], b->periodic[2]},
      .u = u,
      .clusters = BALLS};
  assert_int_equal(fg_density_create_from_arrays(&density, context, &arrays),
                   FG_STATUS_OK);
  return density;
}

/* Each node that is nearer to a ball than to any other by the gap and some error of the
 * march is that ball's territory, and no node that is as much nearer to another. */
static void territories_are_nearest(void **state)
{
  float *u = calloc(MOST_NODES, sizeof *u);
  assert_non_null(u);
  for (size_t s = 0; s < sizeof SITUATIONS / sizeof *SITUATIONS; ++s) {
    const balls *b = &SITUATIONS[s];
    fg_density *density = density_of_balls(*state, b, u), *territories;
    fg__territory of = {.density = density};
    int whose[BALLS] = {0};
    const int *own = fg_density_labels(density);
    assert_int_equal(fg__territories_create(&territories, &of, *state, density),
                     FG_STATUS_OK);
    assert_int_equal(fg_density_contents(territories)->clusters, BALLS);
    const int *label = fg_density_labels(territories);
    for (size_t n = 0; n < nodes_of(b); ++n)
      for (int k = 0; k < BALLS; ++k)
        if (own[n] > 0 && distance_of(b, n, k) < 0.0)
          whose[k] = own[n];
    size_t checked = 0;
    for (size_t n = 0; n < nodes_of(b); ++n) {
      double nearest = HUGE_VAL, next = HUGE_VAL;
      int ball = 0;
      for (int k = 0; k < BALLS; ++k) {
        const double d = distance_of(b, n, k);
        next = d < nearest ? nearest : fmin(next, d);
        ball = d < nearest ? k : ball;
        nearest = fmin(nearest, d);
      }
      if (next - nearest < 3.2 * b->spacing[b->dimension - 1])
        continue;
      ++checked;
      assert_true(label[n] > 0);
      assert_int_equal(of.cluster[label[n]], whose[ball]);
    }
    assert_true(3 * checked > nodes_of(b));
    fg_density_destroy(density);
    fg_density_destroy(territories);
    free(of.cluster);
  }
  free(u);
}

/* Two balls on either side of a wall with a door at the far end: what lies behind the
 * wall is nearer to the ball there by any way that does not cross it. */
static void ways_go_round_masks(void **state)
{
  enum { NX = 41, NY = 31, WALL = 14, DOOR = 26 };
  static float u[NX * NY];
  static unsigned char active[(NX - 1) * (NY - 1)];
  fg_density *density, *territories;
  fg__territory of = {.longest = 0.0};
  for (int y = 0; y < NY; ++y)
    for (int x = 0; x < NX; ++x)
      u[y * NX + x] =
          (float)fmax(3.0 - fmin(hypot(x - 8, y - 6), hypot(x - 34, y - 6)), -1.0);
  for (int y = 0; y < NY - 1; ++y)
    for (int x = 0; x < NX - 1; ++x)
      active[y * (NX - 1) + x] = x < WALL || x > WALL + 1 || y >= DOOR;
  const fg_density_arrays arrays = {.dimension = 2,
                                    .nodes = {NX, NY, 1},
                                    .spacing = {1.0, 1.0, 1.0},
                                    .u = u,
                                    .active = active,
                                    .clusters = 2};
  assert_int_equal(fg_density_create_from_arrays(&density, *state, &arrays),
                   FG_STATUS_OK);
  assert_int_equal(fg__territories_create(&territories, &of, *state, density),
                   FG_STATUS_OK);
  const int *label = fg_density_labels(territories), *own = fg_density_labels(density);
  const int beyond = 6 * NX + WALL + 4; /* 10 from the ball before the wall, 16 from the
                                           other */
  assert_int_equal(of.cluster[label[beyond]], own[6 * NX + 34]);
  assert_int_equal(of.cluster[label[6 * NX + WALL - 1]], own[6 * NX + 8]);
  fg_density_destroy(density);
  fg_density_destroy(territories);
  free(of.cluster);
}

static void shear(double x, double y, double velocity[2])
{
  velocity[0] = 1.0 + 0.02 * y;
  velocity[1] = 0.15 * sin(0.2 * x);
}

static double five_discs(double x, double y)
{
  static const double at[][2] = {{-4, 10}, {8, 12}, {20, 9}, {2, 24}, {18, 25}};
  double depth = -HUGE_VAL;
  for (size_t n = 0; n < sizeof at / sizeof *at; ++n)
    depth = fmax(depth, 1.8 - hypot(x - at[n][0], y - at[n][1]));
  return depth;
}

static void arrows_go_on_through_territories(void **state)
{
  fg_field *field = field_of(*state, shear);
  fg_density *density = density_of(*state, five_discs, NULL);
  fg_icons *own, *wide;
  assert_int_equal(fg_icons_create(&own, *state, field, density, NULL), FG_STATUS_OK);
  for (int threads = 1; threads <= 2; ++threads) {
    const fg_icon_options options = {FG_EXTENT_TERRITORY, threads};
    assert_int_equal(fg_icons_create(&wide, *state, field, density, &options),
                     FG_STATUS_OK);
    assert_int_equal(fg_icons_count(wide), 5);
    assert_int_equal(fg_icons_clusters(wide), 5);
    assert_int_equal(fg_icons_dropped(wide), 0);
    const double extent = sqrt(1200.0 / 5.0);
    for (int n = 0; n < 5; ++n) {
      const fg_icon *a = fg_icons_at(wide, n), *in = fg_icons_at(own, n);
      const double length = hypot(a->points[a->point_count - 1][0] - a->points[0][0],
                                  a->points[a->point_count - 1][1] - a->points[0][1]);
      assert_int_equal(a->cluster, n + 1);
      assert_int_equal(in->cluster, n + 1);
      bool meets = false;
      for (int k = 0; k < a->point_count; ++k)
        meets = meets || five_discs(a->points[k][0], a->points[k][1]) > 0.0;
      assert_true(meets);
      assert_true(a->area > 8.0 * in->area);
      assert_true(length > 6.0 && length <= 3.0 * extent);
      assert_true(icon_tangency(a, field) < 0.2);
      double(*outline)[2], (*other)[2];
      int vertices, others;
      assert_int_equal(fg_icon_outline(a, &outline, &vertices), FG_STATUS_OK);
      assert_true(is_simple((const double(*)[2])outline, vertices));
      for (int m = 0; m < n; ++m) {
        assert_int_equal(fg_icon_outline(fg_icons_at(wide, m), &other, &others),
                         FG_STATUS_OK);
        for (int i = 0; i < vertices; ++i)
          for (int k = 0; k < others; ++k)
            assert_true(hypot(outline[i][0] - other[k][0], outline[i][1] - other[k][1]) >
                        0.05 * extent);
        free(other);
      }
      free(outline);
    }
    fg_icons_destroy(wide);
  }
  fg_icons_destroy(own);
  fg_density_destroy(density);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(territories_are_nearest, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(ways_go_round_masks, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(arrows_go_on_through_territories, context_set_up,
                                      context_tear_down),
  };
  return cmocka_run_group_tests_name("icon/territory", tests, NULL, NULL);
}
