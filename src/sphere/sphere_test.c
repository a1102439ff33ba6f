/* A solid-body rotation about a tilted axis is smooth everywhere, at poles and at the
 * antimeridian too: what is sampled differs from it by the error of interpolation, which
 * falls with the square of the spacing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "field/slab.h"
#include "sphere/sphere.h"

#define RADIANS 0.017453292519943295

static const double AXIS[3] = {0.48, -0.36, 0.8};

static void exact(double *east, double *north, double longitude, double latitude)
{
  const double s = sin(longitude * RADIANS), c = cos(longitude * RADIANS);
  const double sine = sin(latitude * RADIANS), cosine = cos(latitude * RADIANS);
  const double up[3] = {cosine * c, cosine * s, sine};
  const double w[3] = {AXIS[1] * up[2] - AXIS[2] * up[1],
                       AXIS[2] * up[0] - AXIS[0] * up[2],
                       AXIS[0] * up[1] - AXIS[1] * up[0]};
  *east = -s * w[0] + c * w[1];
  *north = -sine * (c * w[0] + s * w[1]) + cosine * w[2];
}

static void must(fg_context *context, fg_status status)
{
  if (status != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
}

/* A grid of longitudes and latitudes: from west, with all longitudes when columns *
 * step is 360. */
static fg_field *grid_made(fg_context *context, double west, double south, double step,
                           int columns, int rows)
{
  double *axis[2] = {malloc((size_t)columns * sizeof(double)),
                     malloc((size_t)rows * sizeof(double))};
  const size_t samples = (size_t)columns * (size_t)rows;
  float *u = malloc(samples * sizeof *u), *v = malloc(samples * sizeof *v);
  assert_true(axis[0] && axis[1] && u && v);
  for (int i = 0; i < columns; ++i)
    axis[0][i] = west + i * step;
  for (int j = 0; j < rows; ++j)
    axis[1][j] = south + j * step;
  for (size_t n = 0; n < samples; ++n) {
    double east, north;
    exact(&east, &north, axis[0][n % (size_t)columns], axis[1][n / (size_t)columns]);
    u[n] = (float)east;
    v[n] = (float)north;
  }
  fg_field *field = NULL;
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {columns, rows},
                                  .axis = {axis[0], axis[1]},
                                  .period = {columns * step == 360.0 ? 360.0 : 0.0},
                                  .velocity = {u, v},
                                  .velocity_units = "m/s",
                                  .scale = FG_SCALE_GEO};
  must(context, fg_field_create(&field, context, &arrays));
  free(axis[0]);
  free(axis[1]);
  free(u);
  free(v);
  return field;
}

/* The largest error at n positions all over the part of the sphere north of `south`. */
static double worst(const fg__sphere *sphere, double south, int n)
{
  double most = 0.0;
  for (int k = 0; k < n; ++k) {
    const double longitude = -720.0 + fmod(k * 222.49223594996, 1440.0);
    const double sine = sin(south * RADIANS);
    const double latitude = asin(sine + (1.0 - sine) * (k + 0.5) / n) / RADIANS;
    float u, v;
    double east, north;
    fg__sphere_sample(&u, &v, sphere, 1, &longitude, &latitude);
    exact(&east, &north, longitude, latitude);
    const double error = hypot((double)u - east, (double)v - north);
    assert_true(error < 1.0); /* not NaN */
    most = fmax(most, error);
  }
  return most;
}

static void grids_are_smooth_everywhere(void **state)
{
  fg_context *context = *state;
  double error[2];
  for (int fine = 0; fine < 2; ++fine) {
    const double step = fine ? 3.0 : 6.0;
    const int rows = fine ? 60 : 30; /* half a step off the poles */
    fg_field *field = grid_made(context, 21.0, -90.0 + step / 2.0, step, 2 * rows, rows);
    fg__sphere *sphere;
    must(context, fg__sphere_of_field(&sphere, context, field));
    error[fine] = worst(sphere, -90.0, 5000);
    fg__sphere_extent extent;
    fg__sphere_extent_of(&extent, sphere);
    assert_true(extent.east - extent.west == 360.0);
    assert_true(extent.south == -90.0 && extent.north == 90.0);
    assert_string_equal(fg__sphere_words(sphere)->velocity_units, "m/s");
    fg__sphere_destroy(sphere);
    fg_field_destroy(field);
  }
  assert_true(error[0] < 3.0e-3);
  assert_true(error[1] < 0.27 * error[0]);
}

static void a_grid_ends_where_it_ends(void **state)
{
  fg_context *context = *state;
  fg_field *field = grid_made(context, 170.0, 10.0, 1.0, 21, 11);
  fg__sphere *sphere;
  must(context, fg__sphere_of_field(&sphere, context, field));
  fg__sphere_extent extent;
  fg__sphere_extent_of(&extent, sphere);
  assert_float_equal(extent.west, 170.0, 1e-9);
  assert_float_equal(extent.east, 190.0, 1e-9);
  assert_float_equal(extent.south, 10.0, 1e-9);
  assert_float_equal(extent.north, 20.0, 1e-9);
  const double longitude[] = {-175.0, 169.9, -169.9, 170.0, 190.0, 180.0};
  const double latitude[] = {15.0, 15.0, 15.0, 10.0, 20.0, 20.1};
  float u[6], v[6];
  fg__sphere_sample(u, v, sphere, 6, longitude, latitude);
  assert_true(isfinite(u[0]) && isnan(u[1]) && isnan(u[2]) && isnan(v[2]));
  assert_true(isfinite(u[3]) && isfinite(u[4]) && isnan(u[5]));
  fg__sphere_destroy(sphere);
  fg_field_destroy(field);
}

/* A grid round a pole that lies elsewhere: longitudes and latitudes north of -20 degrees,
 * moved by a Moebius transformation of the stereographic plane. Cells are far from equal
 * in size, the true pole lies within one. The last column repeats the first. */
static fg__sphere_cells displaced(int columns, int rows, bool triangles)
{
  const size_t points = (size_t)columns * (size_t)rows;
  const size_t quads = (size_t)(columns - 1) * (size_t)(rows - 1);
  fg__sphere_cells out = {.points = points,
                          .longitude = malloc(points * sizeof(double)),
                          .latitude = malloc(points * sizeof(double)),
                          .east = malloc(points * sizeof(float)),
                          .north = malloc(points * sizeof(float)),
                          .count = triangles ? 2 * quads : quads,
                          .corner = malloc(8 * quads * sizeof(int))};
  for (size_t n = 0; n < points; ++n) {
    const double turn = 360.0 * (double)(n % (size_t)columns) / (columns - 1);
    const double row = (double)(n / (size_t)columns) / (rows - 1);
    const double radius = tan((55.0 * (1.0 - row)) * RADIANS);
    const double x = radius * cos(turn * RADIANS), y = radius * sin(turn * RADIANS);
    const double a = 0.25, p = x + a, r = 1.0 + a * x,
                 s = a * y; /* (z + a) / (1 + a z) */
    const double norm = r * r + s * s;
    const double re = (p * r + y * s) / norm, im = (y * r - p * s) / norm;
    out.longitude[n] = atan2(im, re) / RADIANS;
    out.latitude[n] = 90.0 - 2.0 * atan(hypot(re, im)) / RADIANS;
    double east, north;
    exact(&east, &north, out.longitude[n], out.latitude[n]);
    out.east[n] = (float)east;
    out.north[n] = (float)north;
  }
  for (size_t n = 0; n < quads; ++n) {
    const int lower = (int)(n / (size_t)(columns - 1)) * columns;
    const int a = lower + (int)(n % (size_t)(columns - 1));
    const int ring[4] = {a, a + 1, a + columns + 1, a + columns};
    for (size_t k = 0; k < 4; ++k) {
      out.corner[(triangles ? 8 : 4) * n + k] = k == 3 && triangles ? -1 : ring[k];
      if (triangles)
        out.corner[8 * n + 4 + k] = k == 3 ? -1 : ring[(k + 2) % 4];
    }
  }
  return out;
}

static void cells_are_smooth_everywhere(void **state)
{
  fg_context *context = *state;
  for (int triangles = 0; triangles < 2; ++triangles) {
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
      fg__sphere_cells cells = displaced(fine ? 121 : 61, fine ? 41 : 21, triangles != 0);
      fg__sphere *sphere;
      must(context, fg__sphere_of_cells(&sphere, context, &cells));
      assert_null(cells.corner);
      error[fine] = worst(sphere, 30.0, 5000);
      fg__sphere_extent extent;
      fg__sphere_extent_of(&extent, sphere);
      assert_true(extent.east - extent.west == 360.0);
      assert_true(extent.north == 90.0);
      const double longitude = 0.0, latitude = -60.0; /* beyond its edge */
      float u, v;
      fg__sphere_sample(&u, &v, sphere, 1, &longitude, &latitude);
      assert_true(isnan(u) && isnan(v));
      fg__sphere_destroy(sphere);
    }
    assert_true(error[0] < 6.5e-3);
    assert_true(error[1] < 0.3 * error[0]);
  }
}

/* Any number of threads makes the same sphere, to the bit: of enough cells to be divided,
 * some of them missing, with the first face's in the middle of the order. */
static void threads_make_the_same(void **state)
{
  enum { COLUMNS = 501, ROWS = 161, PLACES = 4000 };
  fg_context *context = *state;
  fg__sphere_extent extent[3];
  static float u[3][PLACES], v[3][PLACES];
  static double longitude[PLACES], latitude[PLACES];
  for (int n = 0; n < PLACES; ++n) {
    longitude[n] = 360.0 * (n * 0.618034 - floor(n * 0.618034));
    latitude[n] = -30.0 + 120.0 * (n + 0.5) / PLACES;
  }
  size_t present = 0;
  for (int k = 0; k < 3; ++k) {
    fg__sphere_cells cells = displaced(COLUMNS, ROWS, false);
    cells.threads = 1 + 2 * k;
    for (size_t n = 0; n < cells.points; ++n)
      if (n % COLUMNS / 40 % 3 == 1 && n / COLUMNS / 20 % 2)
        cells.east[n] = NAN;
    fg__sphere *sphere;
    must(context, fg__sphere_of_cells(&sphere, context, &cells));
    fg__sphere_extent_of(&extent[k], sphere);
    fg__sphere_sample(u[k], v[k], sphere, PLACES, longitude, latitude);
    fg__sphere_destroy(sphere);
    assert_memory_equal(u[k], u[0], sizeof u[0]);
    assert_memory_equal(v[k], v[0], sizeof v[0]);
    assert_true(extent[k].spacing == extent[0].spacing);
    assert_true(extent[k].share == extent[0].share);
    assert_true(extent[k].points == extent[0].points);
    assert_true(extent[k].west == extent[0].west && extent[k].north == extent[0].north);
  }
  for (int n = 0; n < PLACES; ++n)
    present += isfinite(u[0][n]) ? 1 : 0;
  assert_true(present > PLACES / 2 && present < PLACES - PLACES / 20);
}

/* Points on the corners and the sides of cells are found, and have the same value from
 * whichever cell; the order and the sense of the corners do not matter. */
static void sides_belong_to_both(void **state)
{
  fg_context *context = *state;
  fg__sphere_cells cells = displaced(61, 21, false);
  double longitude[61 * 21] = {0.0}, latitude[61 * 21] = {0.0};
  float east[61 * 21] = {0.0f}, u[61 * 21], v[61 * 21];
  for (size_t n = 0; n < cells.points; ++n) {
    longitude[n] = cells.longitude[n];
    latitude[n] = cells.latitude[n];
    east[n] = cells.east[n];
  }
  for (size_t n = 0; n < cells.count; n += 2) {
    const int swapped = cells.corner[4 * n];
    cells.corner[4 * n] = cells.corner[4 * n + 2];
    cells.corner[4 * n + 2] = swapped;
  }
  fg__sphere *sphere;
  must(context, fg__sphere_of_cells(&sphere, context, &cells));
  fg__sphere_sample(u, v, sphere, 61 * 21, longitude, latitude);
  for (size_t n = 0; n < 61 * 20; ++n) /* the last row is one point, of any direction */
    assert_float_equal((double)u[n], (double)east[n], 1e-5);
  fg__sphere_destroy(sphere);
}

/* 3 x 2 points, the middle of the upper row missing, and the upper right. */
static void coasts_lie_half_way(void **state)
{
  fg_context *context = *state;
  fg__sphere_cells cells = {.points = 6,
                            .longitude = malloc(6 * sizeof(double)),
                            .latitude = malloc(6 * sizeof(double)),
                            .east = malloc(6 * sizeof(float)),
                            .north = malloc(6 * sizeof(float)),
                            .count = 2,
                            .corner = malloc(8 * sizeof(int))};
  static const int corner[] = {0, 1, 4, 3, 1, 2, 5, 4};
  for (int n = 0; n < 6; ++n) {
    cells.longitude[n] = 179.0 + n % 3;
    cells.latitude[n] = n / 3;
    cells.east[n] = (float)(n + 1);
    cells.north[n] = n == 4 ? NAN : n == 5 ? INFINITY : 0.0f;
  }
  for (int k = 0; k < 8; ++k)
    cells.corner[k] = corner[k];
  fg__sphere *sphere;
  must(context, fg__sphere_of_cells(&sphere, context, &cells));
  const double longitude[] = {180.4, 180.4, 179.0, 179.6, -179.2};
  const double latitude[] = {0.4, 0.6, 0.9, 0.9, 0.1};
  float u[5], v[5];
  fg__sphere_sample(u, v, sphere, 5, longitude, latitude);
  /* point 4 has the mean of 0, 1, 3 of one cell and 1, 2 of the other, point 5 of 1, 2 */
  const double four = (1.0 + 2.0 + 4.0 + 2.0 + 3.0) / 5.0, five = 2.5;
  const double expected = 0.6 * (0.6 * 2.0 + 0.4 * 3.0) + 0.4 * (0.6 * four + 0.4 * five);
  assert_float_equal((double)u[0], expected, 2e-3);
  assert_true(isnan(u[1]) && isnan(v[1]) && isnan(u[3]));
  assert_float_equal((double)u[2], 3.7, 2e-3);
  assert_true(isfinite(u[4]));
  fg__sphere_destroy(sphere);
}

static void refuses(fg_context *context, fg__sphere_cells *cells, const char *words)
{
  fg__sphere *sphere;
  assert_int_not_equal(fg__sphere_of_cells(&sphere, context, cells), FG_STATUS_OK);
  assert_null(sphere);
  assert_non_null(strstr(fg_context_message(context), words));
  fg_context_clear(context);
}

static void what_is_no_mesh_is_refused(void **state)
{
  fg_context *context = *state;
  fg__sphere_cells cells = displaced(7, 5, false);
  cells.corner[5] = 35;
  refuses(context, &cells, "corner 35");
  cells = displaced(7, 5, true);
  cells.corner[4] = -1;
  refuses(context, &cells, "corner -1");
  cells = displaced(7, 5, false);
  for (size_t n = 0; n < cells.points; ++n)
    cells.latitude[n] = n % 2 ? 91.0 : (double)NAN;
  refuses(context, &cells, "none of 24 cells");
  cells = displaced(3, 2, false); /* half a turn from corner to corner */
  refuses(context, &cells, "none of 2 cells");
  cells = displaced(36, 18, false);
  for (size_t n = 0; n < cells.points; ++n) {
    cells.longitude[n] = 0.1 * (double)(n * 37 % 101);
    cells.latitude[n] = 0.1 * (double)(n * 53 % 97);
  }
  refuses(context, &cells, "its cells lie on each other");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(grids_are_smooth_everywhere),
      cmocka_unit_test(a_grid_ends_where_it_ends),
      cmocka_unit_test(cells_are_smooth_everywhere),
      cmocka_unit_test(threads_make_the_same),
      cmocka_unit_test(sides_belong_to_both),
      cmocka_unit_test(coasts_lie_half_way),
      cmocka_unit_test(what_is_no_mesh_is_refused),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
