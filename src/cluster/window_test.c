#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "cluster/labels_test.h"
#include "cluster/window.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

enum { W = 24, H = 10 };

static float u[W * H];
static unsigned char active[W * H];

static fg_density_arrays empty(bool periodic)
{
  for (int k = 0; k < W * H; ++k) {
    u[k] = -1.0F;
    active[k] = 1;
  }
  return (fg_density_arrays){.dimension = 2,
                             .nodes = {W, H},
                             .origin = {10.0, -3.0},
                             .spacing = {0.5, 0.25},
                             .periodic = {periodic, false},
                             .u = u};
}

static void fill(int x0, int x1, int y0, int y1, float value)
{
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x)
      u[y * W + x % W] = value;
  }
}

static int positive_nodes(const fg__window *window)
{
  int count = 0;
  for (int k = 0; k < window->nodes[0] * window->nodes[1]; ++k)
    count += window->level[k] > 0.0F;
  return count;
}

static void test_bounds_and_rim(void **state)
{
  (void)state;
  fg_density_arrays density = empty(false);
  fill(7, 9, 4, 5, 0.5F);
  fill(15, 22, 1, 2, 0.25F);
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 2);
  assert_int_equal(labels.label[1 * W + 15], 1);
  const int expected[4] = {15, 22, 1, 2};
  assert_memory_equal(labels.bounds[0], expected, sizeof expected);
  /* 7 x 1 cells; a fifth of each cell beside them, 0.25 : 1; a thirteenth of each at a
   * corner, 0.25 : 3 */
  double straight = 2 * (7 + 1) * 0.2;
  assert_near(labels.area[0], (7 + straight + 4 / 13.0) * 0.125, 1e-6);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(window.nodes[0], 11); /* 13 ... 23, the domain's end */
  assert_int_equal(window.nodes[1], 5);  /* 0 ... 4 */
  assert_near(window.origin[0], 10 + 13 * 0.5, 1e-12);
  assert_near(window.origin[1], -3.0, 1e-12);
  assert_false(window.at_boundary[0]);
  assert_true(window.at_boundary[1]);
  assert_true(window.at_boundary[2]);
  assert_false(window.at_boundary[3]);
  assert_int_equal(positive_nodes(&window), 16);
  fg__window_clear(&window);
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 3),
                   FG_STATUS_ARGUMENT);
  fg__labels_clear(&labels);
}

/* Two clusters that touch a cell from two corners, and debris beside them. */
static void test_neighbours_do_not_appear(void **state)
{
  (void)state;
  fg_density_arrays density = empty(false);
  density.debris_area = 0.6 * 0.125;
  fill(4, 6, 2, 4, 0.5F);
  fill(7, 10, 5, 7, 0.8F);
  u[2 * W + 8] = 0.4F; /* debris */
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 2);
  assert_int_equal(labels.debris, 1);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(positive_nodes(&window), 9);
  /* everywhere but in the cell that both touch, this cluster's boundary is where it was
   */
  double least_moved = 0.0;
  for (int i = 0; i <= 100; ++i) {
    for (int j = 0; j <= 100; ++j) {
      double x = 3.5 + 3.0 * i / 100; /* up to x = 6.5, in nodes */
      double y = 1.5 + 3.0 * j / 100;
      const double place[2] = {10 + 0.5 * x, -3 + 0.25 * y};
      double level = fg__window_level(&window, place);
      int x0 = (int)x;
      int y0 = (int)y;
      double s = x - x0;
      double t = y - y0;
      const float *low = u + y0 * W + x0;
      double density_there = (1 - t) * ((1 - s) * (double)low[0] + s * (double)low[1]) +
                             t * ((1 - s) * (double)low[W] + s * (double)low[W + 1]);
      if (x0 == 6 && y0 == 4)
        least_moved = fmax(least_moved, fabs(level - density_there));
      else
        assert_near(level, density_there, 1e-6);
    }
  }
  assert_true(least_moved < 0.5);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

static void test_mask_is_outside(void **state)
{
  (void)state;
  fg_density_arrays density = empty(false);
  density.active = active;
  fill(5, 9, 3, 6, 0.5F);
  for (int y = 0; y < H - 1; ++y)
    active[y * (W - 1) + 7] = 0; /* cells between nodes 7 and 8 */
  u[4 * W + 2] = NAN;
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 2);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(positive_nodes(&window), 12);
  const double in_mask[2] = {10 + 0.5 * 7.25, -3 + 0.25 * 4.5};
  const double beside[2] = {10 + 0.5 * 6.75, -3 + 0.25 * 4.5};
  const double far_off[2] = {10.1, -3 + 0.25 * 4.5};
  assert_true(fg__window_level(&window, in_mask) < 0);
  assert_near(fg__window_level(&window, beside), 0.5, 1e-6);
  assert_true(fg__window_level(&window, far_off) < 0);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

static void test_across_a_periodic_boundary(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true);
  fill(21, 21 + 5, 3, 5, 0.5F); /* 21, 22, 23, 0, 1, 2 */
  fill(10, 12, 3, 3, 0.5F);
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 2);
  const int expected[4] = {21, 26, 3, 5};
  assert_memory_equal(labels.bounds[0], expected, sizeof expected);
  assert_false(labels.closed[0][0]);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(window.nodes[0], 10);
  assert_near(window.origin[0], 10 + 19 * 0.5, 1e-12);
  assert_int_equal(positive_nodes(&window), 18);
  assert_false(window.at_boundary[0] || window.at_boundary[1]);
  const double beyond[2] = {10 + 0.5 * 25.3, -3 + 0.25 * 4.0};
  assert_near(fg__window_level(&window, beyond), 0.5, 1e-6);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

/* A closed band is cut where it is thinnest. */
static void test_band_round_the_period(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true);
  fill(0, W - 1, 4, 6, 0.5F);
  u[4 * W + 17] = -1.0F;
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 1);
  assert_true(labels.closed[0][0]);
  assert_int_equal(labels.bounds[0][0], 17);
  assert_int_equal(labels.bounds[0][1], 17 + W);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(window.nodes[0], W + 1);
  assert_true(window.at_boundary[0] && window.at_boundary[1]);
  assert_int_equal(positive_nodes(&window), 3 * W + 1);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

/* A stripe that goes on past its own beginning without touching it: every node once. */
static void test_stripe_longer_than_the_period(void **state)
{
  (void)state;
  fg_density_arrays density = empty(true);
  int nodes = 0;
  for (int x = 5; x < 5 + W + 9; ++x) {
    int y = 1 + (x - 5) / 5;
    u[y * W + x % W] = 0.5F;
    ++nodes;
    if ((x - 5) % 5 == 0 && x > 5) {
      u[(y - 1) * W + x % W] = 0.5F;
      ++nodes;
    }
  }
  fg__labels labels;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 1);
  assert_false(labels.closed[0][0]);
  assert_int_equal(labels.bounds[0][0], 5);
  assert_int_equal(labels.bounds[0][1], 5 + W + 8);
  fg__window window;
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(window.nodes[0], W + 9 + 4);
  assert_int_equal(positive_nodes(&window), nodes);
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_bounds_and_rim),
      cmocka_unit_test(test_neighbours_do_not_appear),
      cmocka_unit_test(test_mask_is_outside),
      cmocka_unit_test(test_across_a_periodic_boundary),
      cmocka_unit_test(test_band_round_the_period),
      cmocka_unit_test(test_stripe_longer_than_the_period),
  };
  return cmocka_run_group_tests_name("cluster/window", tests, NULL, NULL);
}
