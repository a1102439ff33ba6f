#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "cluster/labels_test.h"
#include "skeleton/spine.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

/* A shape on [0, 1.5] x [0, 1] whose level crosses zero where the exact distance does,
 * but is no distance itself. */
typedef double shape(double x, double y);

typedef struct marched_window {
  fg__window window;
  double *distance;
} marched_window;

static marched_window march(shape *level, int nodes_x, int nodes_y, bool boundary_counts)
{
  float *u = malloc((size_t)(nodes_x * nodes_y) * sizeof *u);
  double h_x = 1.5 / (nodes_x - 1);
  double h_y = 1.0 / (nodes_y - 1);
  for (int k = 0; k < nodes_x * nodes_y; ++k) {
    double value = level(k % nodes_x * h_x, k / nodes_x * h_y);
    u[k] = (float)(value * (3.0 + value)); /* same zeros for values above -3 */
  }
  fg_density_arrays density = {
      .dimension = 2, .nodes = {nodes_x, nodes_y}, .spacing = {h_x, h_y}, .u = u};
  fg__labels labels;
  marched_window result;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 1);
  assert_int_equal(fg__window_create(&result.window, NULL, &density, &labels, 1),
                   FG_STATUS_OK);
  size_t nodes = (size_t)(result.window.nodes[0] * result.window.nodes[1]);
  result.distance = malloc(nodes * sizeof *result.distance);
  assert_int_equal(fg__march(result.distance, NULL, &result.window, boundary_counts),
                   FG_STATUS_OK);
  fg__labels_clear(&labels);
  free(u);
  return result;
}

static void clear(marched_window *marched)
{
  fg__window_clear(&marched->window);
  free(marched->distance);
}

static void node_place(const fg__window *window, int node, double place[2])
{
  place[0] = window->origin[0] + node % window->nodes[0] * window->spacing[0];
  place[1] = window->origin[1] + node / window->nodes[0] * window->spacing[1];
}

/* Largest and mean error against the exact distance, at the nodes inside. */
static void errors(const marched_window *marched, shape *exact, double *largest,
                   double *mean)
{
  int count = 0;
  *largest = *mean = 0.0;
  for (int k = 0; k < marched->window.nodes[0] * marched->window.nodes[1]; ++k) {
    double place[2];
    node_place(&marched->window, k, place);
    if (!(marched->window.level[k] > 0.0F)) {
      assert_true(marched->distance[k] == 0.0);
      continue;
    }
    double error = fabs(marched->distance[k] - exact(place[0], place[1]));
    *largest = fmax(*largest, error);
    *mean += error;
    ++count;
  }
  *mean /= count;
}

/* Errors at h = 1/40 and h = 1/160 (twice that along x when `stretched`). */
static void assert_order(shape *exact, bool boundary_counts, bool stretched,
                         double mean_order, double largest_in_cells)
{
  double largest[2];
  double mean[2];
  for (int k = 0; k < 2; ++k) {
    int cells = k == 0 ? 40 : 160;
    marched_window marched = march(exact, (stretched ? cells * 3 / 4 : cells * 3 / 2) + 1,
                                   cells + 1, boundary_counts);
    errors(&marched, exact, &largest[k], &mean[k]);
    assert_true(largest[k] < largest_in_cells / cells);
    clear(&marched);
  }
  assert_true(log(mean[0] / mean[1]) / log(4.0) > mean_order);
}

static double disc(double x, double y)
{
  return 0.37 - hypot(x - 0.71, y - 0.52);
}

static double ring(double x, double y)
{
  return 0.12 - fabs(hypot(x - 0.66, y - 0.49) - 0.28);
}

/* Turned by atan(3/4), sides 0.9 and 0.3; inside the distance is the smaller of two. */
static double rectangle(double x, double y)
{
  double along = 0.8 * (x - 0.73) + 0.6 * (y - 0.51);
  double across = -0.6 * (x - 0.73) + 0.8 * (y - 0.51);
  return fmin(0.45 - fabs(along), 0.15 - fabs(across));
}

static void test_disc(void **state)
{
  (void)state;
  assert_order(disc, false, false, 1.6, 0.5);
}

static void test_ring(void **state)
{
  (void)state;
  assert_order(ring, false, false, 1.6, 0.5);
}

/* Corners and ridges hold the order down to one there. */
static void test_turned_rectangle(void **state)
{
  (void)state;
  assert_order(rectangle, false, false, 1.3, 0.6);
}

static void test_unequal_spacing(void **state)
{
  (void)state;
  assert_order(disc, false, true, 1.6, 1.0);
  assert_order(ring, false, true, 1.5, 1.0);
}

/* On the long axis of an ellipse with half axes a > b the nearest point of the boundary
 * is at b sqrt(1 - x^2/(a^2 - b^2)), up to x = (a^2 - b^2)/a. */
static double ellipse(double x, double y)
{
  double along = 0.96 * (x - 0.75) + 0.28 * (y - 0.5);
  double across = -0.28 * (x - 0.75) + 0.96 * (y - 0.5);
  return 1.0 - hypot(along / 0.6, across / 0.2);
}

static void test_turned_ellipse(void **state)
{
  (void)state;
  marched_window marched = march(ellipse, 181, 121, false);
  double h = 1.0 / 120;
  int near_axis = 0;
  for (int k = 0; k < marched.window.nodes[0] * marched.window.nodes[1]; ++k) {
    double place[2];
    node_place(&marched.window, k, place);
    double along = 0.96 * (place[0] - 0.75) + 0.28 * (place[1] - 0.5);
    double across = -0.28 * (place[0] - 0.75) + 0.96 * (place[1] - 0.5);
    /* the ellipse holds the disc of `across` less than b, and lies within a strip */
    assert_true(marched.distance[k] <= fmax(0.2 - fabs(across), 0.0) + 0.1 * h);
    if (fabs(across) > 0.5 * h || fabs(along) > 0.5)
      continue;
    ++near_axis;
    double exact = 0.2 * sqrt(1.0 - along * along / (0.36 - 0.04));
    assert_near(marched.distance[k], exact - fabs(across), 0.25 * h);
  }
  assert_true(near_axis > 50);
  clear(&marched);
}

/* A half disc at the domain's lower boundary, centre on it. */
static double half_disc(double x, double y)
{
  return 0.4 - hypot(x - 0.7, y);
}

static double half_disc_with_boundary(double x, double y)
{
  return fmin(y, 0.4 - hypot(x - 0.7, y));
}

static void test_domain_boundary(void **state)
{
  (void)state;
  double largest;
  double mean;
  marched_window marched = march(half_disc, 121, 81, false);
  errors(&marched, half_disc, &largest, &mean);
  assert_true(largest < 0.3 / 80); /* at the middle, where the front collapses */
  clear(&marched);
  marched = march(half_disc, 121, 81, true);
  errors(&marched, half_disc_with_boundary, &largest, &mean);
  assert_true(largest < 0.4 / 80);
  clear(&marched);
}

static double everywhere(double x, double y)
{
  return 1.0 + 0.1 * x * y;
}

static void test_cluster_that_is_the_domain(void **state)
{
  (void)state;
  marched_window marched = march(everywhere, 31, 21, false);
  assert_near(marched.distance[10 * 31 + 15], 0.5, 0.02);
  assert_near(marched.distance[10 * 31 + 2], 0.1, 1e-9);
  clear(&marched);
}

/* A masked cell in the middle of a wide cluster is a boundary of its own, the square of
 * its four edges. */
static void test_mask(void **state)
{
  (void)state;
  enum { N = 41 };
  float u[N * N];
  unsigned char active[(N - 1) * (N - 1)];
  for (int k = 0; k < N * N; ++k)
    u[k] = 1.0F;
  memset(active, 1, sizeof active);
  active[18 * (N - 1) + 23] = 0;
  fg_density_arrays density = {
      .dimension = 2, .nodes = {N, N}, .spacing = {0.5, 0.5}, .u = u, .active = active};
  fg__labels labels;
  fg__window window;
  double distance[N * N];
  label_arrays(&labels, &density);
  assert_int_equal(fg__window_create(&window, NULL, &density, &labels, 1), FG_STATUS_OK);
  assert_int_equal(fg__march(distance, NULL, &window, false), FG_STATUS_OK);
  for (int y = 0; y < N; ++y) {
    for (int x = 0; x < N; ++x) {
      double dx = fmax(fmax(23 - x, x - 24), 0);
      double dy = fmax(fmax(18 - y, y - 19), 0);
      /* fans of the corners lose most, a cell in eighty */
      assert_near(distance[y * N + x], 0.5 * hypot(dx, dy), 0.2);
    }
  }
  fg__window_clear(&window);
  fg__labels_clear(&labels);
}

/* The level turned by a quarter gives the distance turned by a quarter. */
static void test_turns_with_the_shape(void **state)
{
  (void)state;
  enum { N = 50 };
  float u[2][N * N];
  double distance[2][N * N];
  int corner[2][2];
  fg__window window[2];
  for (int y = 0; y < N; ++y) {
    for (int x = 0; x < N; ++x) {
      double level = 0.2 + sin(0.21 * x + 0.1 * y) * cos(0.13 * y - 0.05 * x) -
                     0.004 * ((x - 20) * (x - 20) + (y - 27) * (y - 27));
      u[0][y * N + x] = (float)level;
      u[1][x * N + (N - 1 - y)] = (float)level;
    }
  }
  for (int k = 0; k < 2; ++k) {
    fg_density_arrays density = {
        .dimension = 2, .nodes = {N, N}, .spacing = {1.0, 1.0}, .u = u[k]};
    density.debris_area = 200.0; /* the largest piece alone */
    fg__labels labels;
    label_arrays(&labels, &density);
    assert_int_equal(labels.count, 1);
    assert_int_equal(fg__window_create(&window[k], NULL, &density, &labels, 1),
                     FG_STATUS_OK);
    assert_int_equal(fg__march(distance[k], NULL, &window[k], true), FG_STATUS_OK);
    corner[k][0] = (int)window[k].origin[0];
    corner[k][1] = (int)window[k].origin[1];
    fg__labels_clear(&labels);
  }
  for (int y = 0; y < window[0].nodes[1]; ++y) {
    for (int x = 0; x < window[0].nodes[0]; ++x) {
      int turned_x = N - 1 - (y + corner[0][1]) - corner[1][0];
      int turned_y = x + corner[0][0] - corner[1][1];
      assert_near(distance[0][y * window[0].nodes[0] + x],
                  distance[1][turned_y * window[1].nodes[0] + turned_x], 1e-9);
    }
  }
  fg__window_clear(&window[0]);
  fg__window_clear(&window[1]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_disc),
      cmocka_unit_test(test_ring),
      cmocka_unit_test(test_turned_rectangle),
      cmocka_unit_test(test_unequal_spacing),
      cmocka_unit_test(test_turned_ellipse),
      cmocka_unit_test(test_domain_boundary),
      cmocka_unit_test(test_cluster_that_is_the_domain),
      cmocka_unit_test(test_mask),
      cmocka_unit_test(test_turns_with_the_shape),
  };
  return cmocka_run_group_tests_name("skeleton/march", tests, NULL, NULL);
}
