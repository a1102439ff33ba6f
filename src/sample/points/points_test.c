#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/mix.h"
#include "sample/points/points.h"

enum { MOST = 4000 };

static double dice(size_t i)
{
  return (double)(fg__mix(i) >> 11) * 0x1p-53;
}

static double area(const double *x, const double *y, const int *c)
{
  return 0.5 * ((x[c[1]] - x[c[0]]) * (y[c[2]] - y[c[0]]) -
                (y[c[1]] - y[c[0]]) * (x[c[2]] - x[c[0]]));
}

/* > 0 when p is inside the circle; exact for small whole numbers. */
static double in_circle(const double *x, const double *y, const int *c, size_t p)
{
  double d[3][3];
  for (int k = 0; k < 3; ++k) {
    d[k][0] = x[c[k]] - x[p];
    d[k][1] = y[c[k]] - y[p];
    d[k][2] = d[k][0] * d[k][0] + d[k][1] * d[k][1];
  }
  return d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]) -
         d[1][2] * (d[0][0] * d[2][1] - d[0][1] * d[2][0]) +
         d[2][2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
}

/* Triangles turn left, fill `hull`, hold no other point in their circles, and no edge
 * is in one direction twice. */
static void check_delaunay(fg_context *context, size_t points, const double *x,
                           const double *y, double hull, size_t expected)
{
  fg__triangles t;
  assert_int_equal(fg__delaunay(&t, context, points, x, y, false), FG_STATUS_OK);
  if (expected > 0)
    assert_int_equal(t.count, expected);
  double sum = 0.0;
  for (size_t i = 0; i < t.count; ++i) {
    const int *c = t.corner + 3 * i;
    const double own = area(x, y, c);
    assert_true(own > 0.0);
    sum += own;
    for (size_t p = 0; p < points; p += 1 + points / 300)
      assert_true(in_circle(x, y, c, p) <= 1e-9);
  }
  assert_true(fabs(sum - hull) <= 1e-9 * hull);
  fg__triangles_clear(&t);
}

static void triangulations_are_delaunays(void **state)
{
  static double x[MOST], y[MOST];
  size_t n = 0;
  for (; n < MOST; ++n) { /* in a square with its corners */
    x[n] = n < 4 ? (double)(n & 1) : dice(2 * n);
    y[n] = n < 4 ? (double)(n >> 1) : dice(2 * n + 1);
  }
  check_delaunay(*state, n, x, y, 1.0, 2 * MOST - 2 - 4);
  for (n = 0; n < 60 * 50; ++n) { /* on a grid, where four are on each circle */
    x[n] = (double)(n * 7 % 3000 % 60);
    y[n] = (double)(n * 7 % 3000 / 60);
  }
  check_delaunay(*state, n, x, y, 59.0 * 49.0, 2 * 59 * 49);
  for (n = 0; n < 300; ++n) { /* two lines, and points of one of them twice */
    x[n] = (double)(n % 100);
    y[n] = n < 100 ? 0.0 : 4096.0;
  }
  check_delaunay(*state, n, x, y, 99.0 * 4096.0, 2 * 99);
  for (n = 0; n < 200; ++n) { /* one line, then a point beside it */
    x[n] = n < 199 ? (double)n : 3.0;
    y[n] = n < 199 ? (double)n : 4.0;
  }
  check_delaunay(*state, n, x, y, 99.0, 198);
  fg__triangles t;
  assert_int_equal(fg__delaunay(&t, *state, 199, x, y, false), FG_STATUS_OK);
  assert_int_equal(t.count, 0);
  fg__triangles_clear(&t);
}

typedef struct given {
  fg__scatter scatter;
  double *x, *y;
  float *u, *v;
} given;

static given make_points(fg_context *context, size_t count)
{
  given g = {.scatter = {.context = context,
                         .path = "points",
                         .count = count,
                         .dimension = 2,
                         .records = "line"}};
  for (int k = 0; k < 2; ++k) {
    g.scatter.position[k] = calloc(count, sizeof(double));
    g.scatter.velocity[k] = calloc(count, sizeof(float));
    assert_non_null(g.scatter.position[k]);
    assert_non_null(g.scatter.velocity[k]);
  }
  g.x = g.scatter.position[0];
  g.y = g.scatter.position[1];
  g.u = g.scatter.velocity[0];
  g.v = g.scatter.velocity[1];
  return g;
}

static fg_field *field_of(given *g, fg__scatter_between *between)
{
  const fg_field_arrays words = {.scale = g->scatter.geographic ? FG_SCALE_GEO
                                                                : FG_SCALE_PLAIN};
  fg_field *field = NULL;
  fg_context *context = g->scatter.context;
  if (fg__scatter_field(&field, between, &g->scatter, &words, (fg__slab_index){0, 1}))
    fail_msg("%s", fg_context_message(context));
  fg__scatter_clear(&g->scatter);
  return field;
}

/* Points of an uneven grid in no order, some of them not there. */
static void points_of_a_grid_become_it(void **state)
{
  enum { NX = 12, NY = 9 };
  given g = make_points(*state, (size_t)NX * NY);
  size_t n = 0;
  fg__scatter_between between;
  for (size_t i = 0; i < (size_t)NX * NY; ++i) {
    const size_t place = i * 65 % ((size_t)NX * NY), a = place % NX, b = place / NX;
    if (a > 6 && b > 5) /* a corner */
      continue;
    g.x[n] = 0.1 * (double)(a * a) + (double)a;
    g.y[n] = -0.3 * (double)b;
    g.u[n] = (float)(a + 100 * b);
    g.v[n++] = a == 2 && b == 3 ? NAN : 1.0f;
  }
  g.scatter.count = n;
  fg_field *field = field_of(&g, &between);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(between.cells, 0);
  assert_int_equal(f->size[0], NX);
  assert_int_equal(f->size[1], NY);
  for (size_t i = 0; i < (size_t)NX * NY; ++i) {
    const size_t a = i % NX, b = NY - 1 - i / NX;
    assert_true(f->axis[0][a] == 0.1 * (double)(a * a) + (double)a);
    assert_true(f->axis[1][i / NX] == -0.3 * (double)b);
    const bool here = !(a > 6 && b > 5) && !(a == 2 && b == 3);
    assert_int_equal(f->valid[i] != 0, here);
    if (here)
      assert_true(f->velocity[0][i] == (float)(a + 100 * b));
  }
  fg_field_destroy(field);
}

/* A linear field is kept by interpolation; where a disc has no points nothing is. */
static void scattered_points_are_interpolated_between(void **state)
{
  given g = make_points(*state, MOST);
  size_t n = 0, inside = 0;
  fg__scatter_between between;
  for (size_t i = 0; n < MOST; ++i) {
    const double x = dice(2 * i), y = dice(2 * i + 1);
    if (hypot(x - 0.5, y - 0.5) < 0.1)
      continue;
    g.x[n] = 10.0 * x;
    g.y[n] = 10.0 * y;
    g.u[n] = (float)(1.0 + x);
    g.v[n++] = (float)(2.0 - x - 3.0 * y);
  }
  fg_field *field = field_of(&g, &between);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(between.cells > 2 * MOST - 200 && between.cells < 2 * MOST);
  for (int j = 0; j < f->size[1]; ++j)
    for (int i = 0; i < f->size[0]; ++i) {
      const size_t s = (size_t)j * (size_t)f->size[0] + (size_t)i;
      const double x = 0.1 * f->axis[0][i], y = 0.1 * f->axis[1][j];
      const bool here = f->valid[s] != 0;
      inside += here;
      if (here) {
        assert_true(fabs((double)f->velocity[0][s] - 1.0 - x) < 1e-5);
        assert_true(fabs((double)f->velocity[1][s] - 2.0 + x + 3.0 * y) < 1e-5);
      }
      const double from = hypot(x - 0.5, y - 0.5);
      if (from < 0.07)
        assert_false(here);
      if (from > 0.14 && fmin(fmin(x, y), 1.0 - fmax(x, y)) > 0.05)
        assert_true(here);
    }
  assert_true(inside > 0);
  fg_field_destroy(field);
}

/* Stations all round the globe: solid-body rotation about a tilted axis, known at every
 * place, the poles and the antimeridian too. */
static void points_on_the_globe_close_round_it(void **state)
{
  static const double axis[3] = {0.48, 0.6, 0.64}, degree = 0.017453292519943295;
  given g = make_points(*state, MOST);
  g.scatter.geographic = true;
  for (size_t i = 0; i < MOST; ++i) {
    const double l = 360.0 * dice(2 * i) - 180.0,
                 p = asin(2.0 * dice(2 * i + 1) - 1.0) / degree;
    const double sl = sin(l * degree), cl = cos(l * degree), sp = sin(p * degree),
                 cp = cos(p * degree);
    g.x[i] = l;
    g.y[i] = p;
    g.u[i] = (float)(axis[2] * cp - (axis[0] * cl + axis[1] * sl) * sp);
    g.v[i] = (float)(axis[0] * sl - axis[1] * cl);
  }
  const fg_field_arrays words = {.scale = FG_SCALE_GEO};
  fg__sphere *sphere = NULL;
  fg__scatter_between between;
  assert_int_equal(fg__scatter_sphere(&sphere, &between, &g.scatter, &words),
                   FG_STATUS_OK);
  assert_non_null(sphere);
  fg__scatter_clear(&g.scatter);
  fg__sphere_extent extent;
  fg__sphere_extent_of(&extent, sphere);
  assert_true(extent.share > 0.99);
  for (size_t i = 0; i < 500; ++i) {
    const double l = i < 20 ? 180.0 : 360.0 * dice(7 * i),
                 p = i % 50 == 0 ? 90.0 : asin(2.0 * dice(7 * i + 1) - 1.0) / degree;
    const double sl = sin(l * degree), cl = cos(l * degree), sp = sin(p * degree),
                 cp = cos(p * degree);
    float u, v;
    fg__sphere_sample(&u, &v, sphere, 1, &l, &p);
    const double du = (double)u - (axis[2] * cp - (axis[0] * cl + axis[1] * sl) * sp);
    const double dv = (double)v - (axis[0] * sl - axis[1] * cl);
    assert_true(hypot(du, dv) < 0.02);
  }
  fg__sphere_destroy(sphere);
}

static void refuse(given *g, fg_status status, const char *words)
{
  fg_field *field = NULL;
  fg__scatter_between between;
  const fg_field_arrays none = {.scale = FG_SCALE_PLAIN};
  fg_context *context = g->scatter.context;
  assert_int_equal(
      fg__scatter_field(&field, &between, &g->scatter, &none, (fg__slab_index){0, 1}),
      status);
  assert_null(field);
  if (!strstr(fg_context_message(context), words))
    fail_msg("\"%s\" lacks \"%s\"", fg_context_message(context), words);
  fg_context_clear(context);
  fg__scatter_clear(&g->scatter);
}

static void places_of_no_area_are_refused(void **state)
{
  given g = make_points(*state, 500);
  for (size_t i = 0; i < 500; ++i) {
    g.x[i] = 0.1 * dice(i) + 1.0;
    g.y[i] = 3.0 * g.x[i];
    g.u[i] = 1.0f;
  }
  refuse(&g, FG_STATUS_UNSUPPORTED, "500 points lie on one line");
  g = make_points(*state, 40);
  for (size_t i = 0; i < 40; ++i) { /* two times in one file */
    g.x[i] = (double)(i % 20 % 5);
    g.y[i] = (double)(i % 20 / 5);
    g.u[i] = (float)i;
  }
  refuse(&g, FG_STATUS_FILE_FORMAT, "20 of 40 points lie where another does");
  g = make_points(*state, 40);
  g.x[7] = HUGE_VAL;
  refuse(&g, FG_STATUS_FILE_FORMAT, "line 7: the point's coordinate 1 is inf");
  g = make_points(*state, 2);
  refuse(&g, FG_STATUS_FILE_FORMAT, "2 points");
  g = make_points(*state, 40);
  for (size_t i = 0; i < 40; ++i)
    g.u[i] = g.v[i] = i == 9 ? -9999.0f : 1.0f;
  refuse(&g, FG_STATUS_FILE_FORMAT, "line 9: both components are -9999");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(triangulations_are_delaunays),
      cmocka_unit_test(points_of_a_grid_become_it),
      cmocka_unit_test(scattered_points_are_interpolated_between),
      cmocka_unit_test(points_on_the_globe_close_round_it),
      cmocka_unit_test(places_of_no_area_are_refused),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
