#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "skeleton/march.h"

/* Distance to the boundary of a ball that lies askew on the grid. */
static double ball(double x, double y, double z)
{
  double dx = x - 0.37, dy = y + 0.21, dz = z - 1.13;
  return 0.9 - sqrt(dx * dx + dy * dy + dz * dz);
}

/* To that of a thick shell round it, whose middle sheet is a ridge. */
static double shell(double x, double y, double z)
{
  return 0.3 - fabs(ball(x, y, z) - 0.4);
}

typedef double (*depth_of)(double x, double y, double z);

/* Largest error of the distance, on cells that are no cubes. */
static double error_of(depth_of depth, int cells, bool steep)
{
  fg__window window = {
      .dimension = 3, .nodes = {cells + 1, cells + 4, cells + 8}, .cluster = 1};
  for (int k = 0; k < 3; ++k) {
    static const double low[3] = {-0.8, -1.4, 0.0}, wide[3] = {2.3, 2.4, 2.2};
    window.origin[k] = low[k];
    window.spacing[k] = wide[k] / (window.nodes[k] - 1);
  }
  size_t nodes = fg__window_count(&window);
  window.level = malloc(nodes * sizeof *window.level);
  window.active = malloc(nodes);
  double *distance = malloc(nodes * sizeof *distance);
  assert_true(window.level && window.active && distance);
  size_t node = 0;
  for (int z = 0; z < window.nodes[2]; ++z)
    for (int y = 0; y < window.nodes[1]; ++y)
      for (int x = 0; x < window.nodes[0]; ++x, ++node) {
        window.active[node] = 1;
        double d = depth(window.origin[0] + x * window.spacing[0],
                         window.origin[1] + y * window.spacing[1],
                         window.origin[2] + z * window.spacing[2]);
        window.level[node] = (float)(steep ? fmax(fmin(30 * d, 1), -1) : d);
      }
  assert_int_equal(fg__march(distance, NULL, &window, true), FG_STATUS_OK);
  double worst = 0.0;
  node = 0;
  for (int z = 0; z < window.nodes[2]; ++z)
    for (int y = 0; y < window.nodes[1]; ++y)
      for (int x = 0; x < window.nodes[0]; ++x, ++node) {
        double d = depth(window.origin[0] + x * window.spacing[0],
                         window.origin[1] + y * window.spacing[1],
                         window.origin[2] + z * window.spacing[2]);
        if (window.level[node] > 0.0F)
          worst = fmax(worst, fabs(distance[node] - d));
        else
          assert_true(distance[node] <= 0.0);
      }
  free(window.level);
  free(window.active);
  free(distance);
  return worst;
}

static void distances_converge(void **state)
{
  (void)state;
  double coarse = error_of(ball, 24, false), fine = error_of(ball, 72, false);
  assert_true(coarse < 0.35 * 2.4 / 24);
  assert_true(fine < coarse / 2.2); /* first order at the centre, where fronts meet */
  coarse = error_of(shell, 24, false);
  fine = error_of(shell, 72, false);
  assert_true(coarse < 0.6 * 2.4 / 24);
  assert_true(fine < coarse / 2.2);
}

/* A density is flat inside: only its zero set counts. */
static void only_the_zero_set_counts(void **state)
{
  (void)state;
  assert_true(error_of(ball, 48, true) < 0.6 * 2.4 / 48);
}

/* A block that fills its window: each side that is a boundary counts, a mask likewise. */
static void boundaries_and_masks_count(void **state)
{
  (void)state;
  enum { W = 9, H = 8, D = 7 };
  float level[W * H * D];
  unsigned char active[(W - 1) * (H - 1) * (D - 1)];
  double distance[W * H * D];
  fg__window window = {.dimension = 3,
                       .nodes = {W, H, D},
                       .spacing = {0.5, 1.0, 2.0},
                       .level = level,
                       .active = active,
                       .at_boundary = {true, false, false, false, false, false}};
  for (int n = 0; n < W * H * D; ++n)
    level[n] = 1.0F;
  for (int n = 0; n < (W - 1) * (H - 1) * (D - 1); ++n)
    active[n] = 1;
  assert_int_equal(fg__march(distance, NULL, &window, true), FG_STATUS_OK);
  for (int n = 0; n < W * H * D; ++n)
    assert_true(fabs(distance[n] - 0.5 * (n % W)) < 1e-9);
  active[fg__window_cell(&window, 7, 6, 5)] = 0;
  assert_int_equal(fg__march(distance, NULL, &window, true), FG_STATUS_OK);
  assert_true(fabs(distance[fg__window_node(&window, 7, 6, 5)]) < 1e-12);
  assert_true(fabs(distance[fg__window_node(&window, 7, 5, 5)] - 1.0) < 1e-9);
  assert_true(fabs(distance[fg__window_node(&window, 2, 2, 2)] - 1.0) < 1e-9);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(distances_converge),
      cmocka_unit_test(only_the_zero_set_counts),
      cmocka_unit_test(boundaries_and_masks_count),
  };
  return cmocka_run_group_tests_name("skeleton/march_solid", tests, NULL, NULL);
}
