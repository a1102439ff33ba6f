#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/vector.h"

enum { W = 36, H = 30, D = 24, NODES = W * H * D };

static const double SPACING[3] = {0.1, 0.125, 0.15};

typedef double (*depth_of)(double x, double y, double z);

static double ball(double x, double y, double z)
{
  return 1.1 - sqrt(x * x + y * y + z * z);
}

static double ring(double x, double y, double z)
{
  double away = sqrt(x * x + y * y) - 1.0;
  return 0.35 - sqrt(away * away + z * z);
}

/* A shape round the middle of the grid, `shift` nodes further along x and round. */
static fg_surface *surface_of(depth_of depth, int shift, bool debris)
{
  static float u[NODES];
  for (int n = 0; n < NODES; ++n) {
    double x = ((n % W + W - shift) % W - 0.49 * W) * SPACING[0];
    double y = (n / W % H - 0.51 * H) * SPACING[1];
    double z = (n / W / H - 0.48 * D) * SPACING[2];
    u[n] = (float)fmax(fmin(3 * depth(x, y, z), 1.0), -1.0);
  }
  if (debris)
    u[(3 * H + 3) * W + 3] = 0.5F;
  fg_density_arrays arrays = {.dimension = 3,
                              .nodes = {W, H, D},
                              .origin = {5.0, -2.0, 1.0},
                              .spacing = {SPACING[0], SPACING[1], SPACING[2]},
                              .periodic = {true, false, false},
                              .u = u,
                              .debris_area = 0.01};
  fg_density *density;
  fg_surface *surface = NULL;
  assert_int_equal(fg_density_create_from_arrays(&density, NULL, &arrays), FG_STATUS_OK);
  assert_int_equal(fg_density_surface(&surface, NULL, density), FG_STATUS_OK);
  fg_density_destroy(density);
  return surface;
}

static int compare_edges(const void *a, const void *b)
{
  return memcmp(a, b, 2 * sizeof(int));
}

/* Vertices - edges + triangles, of a surface every edge of which has two triangles that
 * run along it in opposite ways. */
static int characteristic(const fg_surface *s)
{
  int count = 3 * s->triangle_count;
  int(*edge)[2] = malloc((size_t)count * sizeof *edge);
  assert_non_null(edge);
  for (int n = 0; n < count; ++n) {
    edge[n][0] = s->corner[s->triangle[n / 3][n % 3]];
    edge[n][1] = s->corner[s->triangle[n / 3][(n + 1) % 3]];
  }
  qsort(edge, (size_t)count, sizeof *edge, compare_edges);
  for (int n = 0; n < count; ++n) {
    const int back[2] = {edge[n][1], edge[n][0]};
    assert_true(n == 0 || compare_edges(edge[n - 1], edge[n]) != 0);
    assert_non_null(bsearch(back, edge, (size_t)count, sizeof *edge, compare_edges));
  }
  free(edge);
  return s->vertex_count - count / 2 + s->triangle_count;
}

static double volume_of(const fg_surface *s)
{
  double sum = 0.0;
  for (int n = 0; n < s->triangle_count; ++n) {
    double across[3];
    const int *t = s->triangle[n];
    fg__cross(s->vertex[s->corner[t[1]]], s->vertex[s->corner[t[2]]], across);
    sum += fg__dot(s->vertex[s->corner[t[0]]], across) / 6.0;
  }
  return sum;
}

static void a_ball_is_a_closed_surface(void **state)
{
  (void)state;
  fg_surface *s = surface_of(ball, 0, true); /* debris is no cluster */
  assert_int_equal(characteristic(s), 2);
  double full = 4.0 / 3.0 * 3.141592653589793 * 1.1 * 1.1 * 1.1;
  assert_true(fabs(volume_of(s) / full - 1.0) < 0.01);
  const double middle[3] = {5.0 + 0.49 * W * SPACING[0], -2.0 + 0.51 * H * SPACING[1],
                            1.0 + 0.48 * D * SPACING[2]};
  for (int n = 0; n < s->corner_count; ++n) {
    double out[3];
    fg__subtract(s->vertex[s->corner[n]], middle, out);
    assert_true(fabs(fg__length(out) - 1.1) < 0.02);
    assert_true(fg__normalise(out));
    const float *f = s->normal[n];
    const double normal[3] = {(double)f[0], (double)f[1], (double)f[2]};
    assert_true(fg__dot(out, normal) > 0.97);
  }
  fg_surface_destroy(s);
}

static void a_ring_has_a_hole(void **state)
{
  (void)state;
  fg_surface *s = surface_of(ring, 0, false);
  assert_int_equal(characteristic(s), 0);
  double full = 2.0 * 3.141592653589793 * 3.141592653589793 * 0.35 * 0.35;
  assert_true(fabs(volume_of(s) / full - 1.0) < 0.06);
  fg_surface_destroy(s);
}

/* Across the seam of a period there are as many triangles. */
static void a_seam_changes_nothing(void **state)
{
  (void)state;
  fg_surface *whole = surface_of(ring, 0, false), *moved = surface_of(ring, W / 2, false);
  assert_int_equal(whole->triangle_count, moved->triangle_count);
  assert_true(moved->vertex_count > whole->vertex_count); /* those at the seam twice */
  for (int n = 0; n < moved->vertex_count; ++n)
    assert_true(moved->vertex[n][0] >= 5.0 && moved->vertex[n][0] <= 5.0 + W * 0.1);
  fg_surface_destroy(whole);
  fg_surface_destroy(moved);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_ball_is_a_closed_surface),
      cmocka_unit_test(a_ring_has_a_hole),
      cmocka_unit_test(a_seam_changes_nothing),
  };
  return cmocka_run_group_tests_name("solid/isosurface", tests, NULL, NULL);
}
