#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/vector.h"
#include "solid/tube.h"

static const double PI = 3.141592653589793;

enum { POINTS = 60 };

static fg_icon icon_of(const double (*points)[3], int count, double width)
{
  return (fg_icon){.cluster = 1,
                   .point_count = count,
                   .points = points,
                   .width = width,
                   .tail_width = 0.4 * width,
                   .head_length = 2.5 * width,
                   .head_width = 2.2 * width};
}

/* Six times the volume inside, by the triangles' signed tetrahedra. */
static double volume_of(const fg_surface *s)
{
  double sum = 0.0;
  for (int n = 0; n < s->triangle_count; ++n) {
    const int *t = s->triangle[n];
    double across[3];
    fg__cross(s->vertex[s->corner[t[1]]], s->vertex[s->corner[t[2]]], across);
    sum += fg__dot(s->vertex[s->corner[t[0]]], across);
  }
  return sum / 6.0;
}

static int compare_edges(const void *a, const void *b)
{
  return memcmp(a, b, 2 * sizeof(int));
}

/* Every edge has two triangles, which run along it in opposite ways; vertices - edges +
 * faces is 2. */
static void expect_closed(const fg_surface *s)
{
  int edges = 0, count = 3 * s->triangle_count;
  int(*edge)[2] = malloc((size_t)count * sizeof *edge);
  assert_non_null(edge);
  for (int n = 0; n < s->triangle_count; ++n)
    for (int k = 0; k < 3; ++k) {
      edge[3 * n + k][0] = s->corner[s->triangle[n][k]];
      edge[3 * n + k][1] = s->corner[s->triangle[n][(k + 1) % 3]];
    }
  qsort(edge, (size_t)count, sizeof *edge, compare_edges);
  for (int n = 0; n < count; ++n) {
    assert_true(n == 0 || compare_edges(edge[n - 1], edge[n]) != 0);
    const int back[2] = {edge[n][1], edge[n][0]};
    assert_non_null(bsearch(back, edge, (size_t)count, sizeof *edge, compare_edges));
    edges += edge[n][0] < edge[n][1];
  }
  assert_int_equal(s->vertex_count - edges + s->triangle_count, 2);
  free(edge);
}

static void expect_normals(const fg_surface *s)
{
  for (int n = 0; n < s->triangle_count; ++n) {
    const int *t = s->triangle[n];
    double a[3], b[3], face[3];
    fg__subtract(s->vertex[s->corner[t[1]]], s->vertex[s->corner[t[0]]], a);
    fg__subtract(s->vertex[s->corner[t[2]]], s->vertex[s->corner[t[0]]], b);
    fg__cross(a, b, face);
    assert_true(fg__normalise(face));
    for (int k = 0; k < 3; ++k) {
      const float *f = s->normal[t[k]];
      const double normal[3] = {(double)f[0], (double)f[1], (double)f[2]};
      assert_true(fabs(fg__length(normal) - 1.0) < 1e-6);
      assert_true(fg__dot(normal, face) > 0.9); /* a side of 32 is 11 degrees wide */
    }
  }
}

static void a_straight_arrow_has_its_volume(void **state)
{
  (void)state;
  double points[POINTS][3];
  const double along[3] = {2.0 / 7, 3.0 / 7, -6.0 / 7};
  for (int n = 0; n < POINTS; ++n)
    for (int k = 0; k < 3; ++k)
      points[n][k] = 1.0 + k + 4.0 * n / (POINTS - 1) * along[k];
  fg_icon icon = icon_of((const double(*)[3])points, POINTS, 0.3);
  fg_surface *solid;
  assert_int_equal(fg_icon_solid(&solid, NULL, &icon), FG_STATUS_OK);
  expect_closed(solid);
  expect_normals(solid);
  double tail = 0.06, base = 0.15, head = 0.33, cone = 0.75, body = 4.0 - cone;
  double round =
      PI * (body * (tail * tail + tail * base + base * base) + cone * head * head) / 3.0;
  double polygon = 32 * sin(2 * PI / 32) / (2 * PI); /* of 32 sides, in a circle */
  assert_true(fabs(volume_of(solid) / (round * polygon) - 1.0) < 1e-9);
  fg_surface_destroy(solid);
}

static void bent_arrows_are_closed(void **state)
{
  (void)state;
  double points[POINTS][3];
  for (int n = 0; n < POINTS; ++n) {
    double t = 5.0 * n / (POINTS - 1);
    points[n][0] = 10.0 + cos(t);
    points[n][1] = 0.5 * t;
    points[n][2] = sin(t) + 0.1 * t * t;
  }
  for (int count = 2; count <= POINTS; count += 29) {
    fg_icon icon = icon_of((const double(*)[3])points, count, 0.02);
    fg_surface *solid;
    assert_int_equal(fg_icon_solid(&solid, NULL, &icon), FG_STATUS_OK);
    expect_closed(solid);
    assert_true(volume_of(solid) > 0.0);
    if (count == POINTS)
      expect_normals(solid);
    fg_surface_destroy(solid);
  }
}

static void what_has_no_width_has_no_solid(void **state)
{
  (void)state;
  const double points[2][3] = {{0, 0, 0}, {1, 2, 3}};
  fg_icon icon = {.point_count = 2, .points = points};
  fg_surface *solid;
  assert_int_equal(fg_icon_solid(&solid, NULL, &icon), FG_STATUS_OK);
  assert_int_equal(solid->triangle_count, 0);
  fg_surface_destroy(solid);
  icon.point_count = 1;
  assert_int_equal(fg_icon_solid(&solid, NULL, &icon), FG_STATUS_ARGUMENT);
}

/* A number that is linear in the arc length is so on the solid. */
static void values_lie_along_the_line(void **state)
{
  (void)state;
  double points[POINTS][3], value[POINTS];
  const double along[3] = {2.0 / 7, 3.0 / 7, -6.0 / 7};
  for (int n = 0; n < POINTS; ++n) {
    double s = 4.0 * pow((double)n / (POINTS - 1), 1.3);
    for (int k = 0; k < 3; ++k)
      points[n][k] = 1.0 + k + s * along[k];
    value[n] = 3.0 - 2.0 * s;
  }
  fg_icon icon = icon_of((const double(*)[3])points, POINTS, 0.3);
  fg_surface *solid;
  float *at;
  assert_int_equal(fg__solid_with_values(&solid, &at, NULL, &icon, value), FG_STATUS_OK);
  expect_closed(solid);
  for (int n = 0; n < solid->vertex_count; ++n) {
    double s = 0.0;
    for (int k = 0; k < 3; ++k)
      s += along[k] * (solid->vertex[n][k] - 1.0 - k);
    assert_true(fabs((double)at[n] - (3.0 - 2.0 * s)) < 1e-5);
  }
  free(at);
  fg_surface_destroy(solid);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_arrow_has_its_volume),
      cmocka_unit_test(bent_arrows_are_closed),
      cmocka_unit_test(values_lie_along_the_line),
      cmocka_unit_test(what_has_no_width_has_no_solid),
  };
  return cmocka_run_group_tests_name("solid/tube", tests, NULL, NULL);
}
