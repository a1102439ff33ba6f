#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/contour.h"
#include "picture/polygons.h"

static double total_area(const fg__polygons *polygons)
{
  double area = 0.0;
  for (size_t loop = 0; loop < polygons->count; ++loop)
    area += fg__polygon_area(polygons, loop);
  return area;
}

/* A density on a grid of unequal spacing: u = value(x, y). */
typedef struct sampled {
  fg_density_arrays arrays;
  float *u;
} sampled;

static sampled sample(int nx, int ny, const double low[2], const double high[2],
                      bool periodic, double (*value)(double, double))
{
  sampled s = {{.dimension = 2, .nodes = {nx, ny, 1}}, NULL};
  s.arrays.periodic[0] = periodic;
  const int intervals[2] = {periodic ? nx : nx - 1, ny - 1};
  for (int k = 0; k < 2; ++k) {
    s.arrays.origin[k] = low[k];
    s.arrays.spacing[k] = (high[k] - low[k]) / intervals[k];
  }
  s.u = malloc((size_t)nx * (size_t)ny * sizeof *s.u);
  assert_non_null(s.u);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      s.u[j * nx + i] = (float)value(low[0] + i * s.arrays.spacing[0],
                                     low[1] + j * s.arrays.spacing[1]);
  s.arrays.u = s.u;
  return s;
}

static fg__polygons contour(const sampled *s)
{
  fg__polygons polygons;
  assert_int_equal(fg__contour_positive(&polygons, NULL, &s->arrays), FG_STATUS_OK);
  return polygons;
}

static double disc(double x, double y)
{
  return 1.3 - hypot(x - 5.17, y - 2.63); /* area pi 1.69 */
}

static double ring(double x, double y)
{
  return 0.5 - fabs(hypot(x - 5.17, y - 2.63) - 1.6); /* area 2 pi 1.6 */
}

static double everywhere(double x, double y)
{
  (void)x;
  (void)y;
  return 0.7;
}

static double across_the_seam(double x, double y)
{
  double dx = fabs(x - 2.2);
  return 1.3 - hypot(fmin(dx, 7.0 - dx), y - 2.63);
}

static double small_and_large(double x, double y)
{
  return fmax(disc(x, y), 0.2 - hypot(x - 8.0, y - 0.7)); /* area pi 0.04 */
}

static const double low[2] = {2.0, 0.3}, high[2] = {9.0, 5.1};
static const double pi = 3.14159265358979;

static void areas_converge_to_exact_ones(void **state)
{
  (void)state;
  double (*const shapes[])(double, double) = {disc, ring};
  const double exact[] = {pi * 1.69, 2.0 * pi * 1.6};
  for (int shape = 0; shape < 2; ++shape) {
    double error[2];
    for (int level = 0; level < 2; ++level) {
      int n = level ? 113 : 57;
      sampled s = sample(n, n - 9, low, high, false, shapes[shape]);
      fg__polygons polygons = contour(&s);
      assert_int_equal(polygons.count, shape + 1);
      error[level] = fabs(total_area(&polygons) - exact[shape]);
      fg__polygons_clear(&polygons);
      free(s.u);
    }
    assert_true(error[1] < 2e-3 * exact[shape]);
    assert_true(error[1] < 0.4 * error[0]); /* second order */
  }
}

static void vertices_lie_on_the_zero_set(void **state)
{
  (void)state;
  sampled s = sample(81, 67, low, high, false, disc);
  fg__polygons polygons = contour(&s);
  assert_true(polygons.point_count > 40);
  for (size_t n = 0; n < polygons.point_count; ++n)
    assert_true(fabs(disc(polygons.point[n][0], polygons.point[n][1])) < 2e-3);
  fg__polygons_clear(&polygons);
  free(s.u);
}

static void a_full_domain_is_its_box(void **state)
{
  (void)state;
  for (int periodic = 0; periodic < 2; ++periodic) {
    sampled s = sample(12, 9, low, high, periodic, everywhere);
    fg__polygons polygons = contour(&s);
    assert_int_equal(polygons.count, 1);
    assert_true(fabs(total_area(&polygons) - 7.0 * 4.8) < 1e-9);
    fg__polygons_clear(&polygons);
    free(s.u);
  }
}

static void a_cluster_across_the_seam_is_two_pieces(void **state)
{
  (void)state;
  sampled s = sample(140, 97, low, high, true, across_the_seam);
  s.arrays.debris_area = 100.0; /* must not drop the pieces: they are parts */
  fg__polygons polygons = contour(&s);
  assert_int_equal(polygons.count, 2);
  assert_true(fabs(total_area(&polygons) - pi * 1.69) < 0.01);
  for (size_t n = 0; n < polygons.point_count; ++n)
    assert_true(polygons.point[n][0] >= low[0] && polygons.point[n][0] <= high[0]);
  fg__polygons_clear(&polygons);
  free(s.u);
}

static void debris_is_left_out(void **state)
{
  (void)state;
  sampled s = sample(141, 97, low, high, false, small_and_large);
  fg__polygons with = contour(&s);
  s.arrays.debris_area = 0.5;
  fg__polygons without = contour(&s);
  assert_int_equal(with.count, 2);
  assert_int_equal(without.count, 1);
  assert_true(fabs(total_area(&without) - pi * 1.69) < 0.01);
  fg__polygons_clear(&with);
  fg__polygons_clear(&without);
  free(s.u);
}

/* Masked nodes may hold anything, NaN included. */
static void masked_places_are_outside(void **state)
{
  (void)state;
  sampled s = sample(15, 11, low, high, false, everywhere);
  unsigned char active[14 * 10];
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 14; ++i)
      active[j * 14 + i] = i < 6;
  for (int j = 0; j < 11; ++j)
    for (int i = 7; i < 15; ++i)
      s.u[j * 15 + i] = i & 1 ? NAN : 1e30F;
  s.arrays.active = active;
  fg__polygons polygons = contour(&s);
  assert_int_equal(polygons.count, 1);
  double area = total_area(&polygons);
  assert_true(area >= 7.0 * 4.8 * 6.0 / 14.0 - 1e-9 && area < 7.0 * 4.8 * 7.0 / 14.0);
  fg__polygons_clear(&polygons);
  free(s.u);
}

/* Random signs hit every case, saddles included; each loop must close on itself. */
static void loops_of_random_densities_close(void **state)
{
  (void)state;
  enum { NX = 23, NY = 17 };
  static float u[NX * NY];
  fg_density_arrays arrays = {.dimension = 2, .nodes = {NX, NY, 1}, .u = u};
  arrays.spacing[0] = 0.7;
  arrays.spacing[1] = 1.9;
  uint32_t seed = 99;
  for (int run = 0; run < 300; ++run) {
    double positive = 0.0;
    for (int n = 0; n < NX * NY; ++n) {
      seed = seed * 1664525U + 1013904223U;
      u[n] = (float)((double)(seed >> 8) / 16777216.0 - 0.5);
    }
    arrays.periodic[0] = run & 1;
    fg__polygons polygons;
    assert_int_equal(fg__contour_positive(&polygons, NULL, &arrays), FG_STATUS_OK);
    for (size_t loop = 0; loop < polygons.count; ++loop) {
      size_t count = polygons.start[loop + 1] - polygons.start[loop];
      assert_true(count >= 3);
      for (size_t n = polygons.start[loop]; n < polygons.start[loop + 1]; ++n) {
        size_t next = n + 1 < polygons.start[loop + 1] ? n + 1 : polygons.start[loop];
        assert_true(fabs(polygons.point[next][0] - polygons.point[n][0]) <= 0.7 + 1e-9);
        assert_true(fabs(polygons.point[next][1] - polygons.point[n][1]) <= 1.9 + 1e-9);
      }
      positive += fg__polygon_area(&polygons, loop);
    }
    double whole = (arrays.periodic[0] ? NX : NX - 1) * 0.7 * (NY - 1) * 1.9;
    assert_true(positive > 0.3 * whole && positive < 0.7 * whole);
    fg__polygons_clear(&polygons);
  }
}

/* u = u0 (1-x)(1-y) + ...: at its saddle point (u0 u2 - u1 u3) / (u0 - u1 + u2 - u3). */
static void saddles_join_as_the_bilinear_density_does(void **state)
{
  (void)state;
  static const struct {
    float u[4]; /* lower left, lower right, upper left, upper right */
    size_t loops;
  } cases[] = {{{3.0F, -1.0F, -1.0F, 1.0F}, 1}, /* + 1/3 at the saddle */
               {{1.0F, -3.0F, -1.0F, 1.0F}, 2}, /* - 1/3 */
               {{-1.0F, 2.0F, 4.0F, -1.5F}, 1}, /* + 0.76 */
               {{-4.0F, 1.0F, 2.0F, -1.5F}, 2}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    fg_density_arrays arrays = {
        .dimension = 2, .nodes = {2, 2, 1}, .spacing = {1.5, 0.7, 0.0}, .u = cases[k].u};
    fg__polygons polygons;
    assert_int_equal(fg__contour_positive(&polygons, NULL, &arrays), FG_STATUS_OK);
    assert_int_equal(polygons.count, cases[k].loops);
    fg__polygons_clear(&polygons);
  }
}

static void simplifying_keeps_the_shape(void **state)
{
  (void)state;
  sampled s = sample(181, 131, low, high, false, ring);
  fg__polygons polygons = contour(&s);
  size_t before = polygons.point_count;
  double area = total_area(&polygons);
  const double tolerance = 0.004;
  fg__polygons_simplify(&polygons, tolerance);
  assert_int_equal(polygons.count, 2);
  assert_int_equal(polygons.start[2], polygons.point_count);
  assert_true(polygons.point_count < before / 2);
  assert_true(fabs(total_area(&polygons) - area) < tolerance * 2.0 * pi * 3.2);
  for (size_t n = 0; n < polygons.point_count; ++n)
    assert_true(fabs(ring(polygons.point[n][0], polygons.point[n][1])) < 2e-3);
  fg__polygons_clear(&polygons);
  free(s.u);
}

enum { MX = 40, MY = 30 };

typedef struct mask_grid {
  unsigned char mask[MX * MY];
  double x[MX + 1], y[MY + 1];
} mask_grid;

static void even_edges(mask_grid *grid)
{
  memset(grid, 0, sizeof *grid);
  for (int i = 0; i <= MX; ++i)
    grid->x[i] = 100.0 + 2.0 * i;
  for (int j = 0; j <= MY; ++j)
    grid->y[j] = -40.0 + 3.0 * j;
}

static fg__polygons mask_contour(const mask_grid *grid)
{
  const int size[2] = {MX, MY};
  const double *const edges[2] = {grid->x, grid->y};
  fg__polygons polygons;
  assert_int_equal(fg__contour_cells(&polygons, NULL, grid->mask, size, edges),
                   FG_STATUS_OK);
  return polygons;
}

static void masks_keep_their_area(void **state)
{
  (void)state;
  mask_grid grid;
  even_edges(&grid);
  int cells = 0;
  for (int j = 0; j < MY; ++j)
    for (int i = 0; i < MX; ++i)
      if (hypot(i - 17.3, j - 14.8) < 9.4 && hypot(i - 15.0, j - 14.0) > 3.2) {
        grid.mask[j * MX + i] = 1;
        ++cells;
      }
  fg__polygons polygons = mask_contour(&grid);
  assert_int_equal(polygons.count, 2);
  assert_true(fabs(total_area(&polygons) / (6.0 * cells) - 1.0) < 0.01);
  fg__polygons_clear(&polygons);
}

static void a_staircase_becomes_a_slope(void **state)
{
  (void)state;
  mask_grid grid;
  even_edges(&grid);
  for (int j = 0; j < MY; ++j)
    for (int i = 0; i < MX; ++i)
      grid.mask[j * MX + i] = i < j;
  fg__polygons polygons = mask_contour(&grid);
  assert_int_equal(polygons.count, 1);
  int inside = 0;
  for (size_t n = 0; n < polygons.point_count; ++n) {
    double i = (polygons.point[n][0] - 100.0) / 2.0;
    double j = (polygons.point[n][1] + 40.0) / 3.0;
    if (j < 5.0 || j > MY - 5.0 || i < 1.0)
      continue;
    ++inside;
    /* the steps' middles lie on i = j - 1/2; unsmoothed, they depart by 1/2 */
    assert_true(fabs(i - j + 0.5) < 0.1);
  }
  assert_true(inside > 50);
  fg__polygons_clear(&polygons);
}

/* Steps of a coarse grid become a slope; what lies on the frame stays; small parts go. */
static void coarse_steps_are_smoothed_away(void **state)
{
  (void)state;
  const double from[2] = {0.0, 0.0}, to[2] = {40.0, 40.0};
  fg__polygons stairs = {.point = NULL}, smooth = {.point = NULL};
  assert_true(fg__polygons_begin(&stairs));
  assert_true(fg__polygons_add(&stairs, (double[2]){0.0, 40.0}));
  for (int n = 0; n < 20; ++n) {
    assert_true(fg__polygons_add(&stairs, (double[2]){2.0 * n, 2.0 * n}));
    assert_true(fg__polygons_add(&stairs, (double[2]){2.0 * n + 2.0, 2.0 * n}));
  }
  assert_true(fg__polygons_add(&stairs, (double[2]){40.0, 40.0}));
  assert_true(fg__polygons_begin(&stairs)); /* a speck */
  for (int n = 0; n < 3; ++n)
    assert_true(
        fg__polygons_add(&stairs, (double[2]){30.0 + 0.2 * n, 5.0 + 0.1 * n * n}));
  assert_true(fg__polygons_add_smooth(&smooth, &stairs, 3.0, from, to));
  assert_int_equal(smooth.count, 1);
  int on_frame = 0, on_slope = 0;
  for (size_t n = 0; n < smooth.point_count; ++n) {
    const double *at = smooth.point[n];
    on_frame += at[0] <= 0.0 || at[1] >= 40.0;
    if (at[0] < 8.0 || at[0] > 32.0 || at[1] > at[0] + 4.0)
      continue;
    ++on_slope;
    assert_true(fabs(at[1] - at[0] + 1.0) < 0.25); /* by 1, where it is a staircase */
  }
  assert_true(on_frame > 70 && on_slope > 30);
  fg__polygons_clear(&stairs);
  fg__polygons_clear(&smooth);
}

static void boundaries_of_the_grid_stay_straight(void **state)
{
  (void)state;
  mask_grid grid;
  even_edges(&grid);
  memset(grid.mask, 1, sizeof grid.mask);
  fg__polygons polygons = mask_contour(&grid);
  assert_int_equal(polygons.count, 1);
  assert_true(fabs(total_area(&polygons) - 80.0 * 90.0) < 1e-9);
  fg__polygons_clear(&polygons);
}

static void lone_cells_stay_visible(void **state)
{
  (void)state;
  mask_grid grid;
  even_edges(&grid);
  grid.mask[7 * MX + 9] = 1;
  grid.mask[8 * MX + 10] = 1; /* touches the first at a corner */
  grid.mask[20 * MX + 30] = 1;
  fg__polygons polygons = mask_contour(&grid);
  assert_int_equal(polygons.count, 3);
  for (size_t loop = 0; loop < 3; ++loop) {
    double area = fg__polygon_area(&polygons, loop);
    assert_true(area > 0.6 * 6.0 && area < 6.0);
  }
  fg__polygons_clear(&polygons);
}

static void random_masks_close_and_stay_near(void **state)
{
  (void)state;
  mask_grid grid;
  uint32_t seed = 7;
  for (int run = 0; run < 200; ++run) {
    even_edges(&grid);
    int cells = 0;
    for (int n = 0; n < MX * MY; ++n) {
      seed = seed * 1664525U + 1013904223U;
      grid.mask[n] = seed >> 24 < 40U + (unsigned)run;
      cells += grid.mask[n];
    }
    fg__polygons polygons = mask_contour(&grid);
    for (size_t n = 0; n < polygons.point_count; ++n) {
      assert_true(polygons.point[n][0] >= 99.0 && polygons.point[n][0] <= 181.0);
      assert_true(polygons.point[n][1] >= -41.5 && polygons.point[n][1] <= 51.5);
    }
    assert_true(fabs(total_area(&polygons) / (6.0 * cells) - 1.0) < 0.4);
    fg__polygons_clear(&polygons);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(areas_converge_to_exact_ones),
      cmocka_unit_test(vertices_lie_on_the_zero_set),
      cmocka_unit_test(a_full_domain_is_its_box),
      cmocka_unit_test(a_cluster_across_the_seam_is_two_pieces),
      cmocka_unit_test(debris_is_left_out),
      cmocka_unit_test(masked_places_are_outside),
      cmocka_unit_test(loops_of_random_densities_close),
      cmocka_unit_test(saddles_join_as_the_bilinear_density_does),
      cmocka_unit_test(simplifying_keeps_the_shape),
      cmocka_unit_test(masks_keep_their_area),
      cmocka_unit_test(a_staircase_becomes_a_slope),
      cmocka_unit_test(coarse_steps_are_smoothed_away),
      cmocka_unit_test(boundaries_of_the_grid_stay_straight),
      cmocka_unit_test(lone_cells_stay_visible),
      cmocka_unit_test(random_masks_close_and_stay_near),
  };
  return cmocka_run_group_tests_name("picture/contour", tests, NULL, NULL);
}
