/* No solid crosses a periodic boundary: a picture of the domain ends there. */
#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "base/vector.h"

enum { N = 48, M = 40, L = 36, MOST = N };

static const double LOW[3] = {-3, 1, 0.5};
static const double SPACING[3] = {0.25, 0.25, 0.3};
static const double HALF[3] = {2.6, 0.9, 1.1}; /* of the grain */
static const double PI = 3.141592653589793;
static const int NODES[3] = {N, M, L};

static double side_of(int k)
{
  return NODES[k] * SPACING[k];
}

/* Depth in an ellipsoid, round the periods; about right near its boundary. */
static double depth_at(const double p[3], const double center[3])
{
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    double away = p[k] - center[k], period = side_of(k);
    away -= period * floor(away / period + 0.5);
    square += away * away / (HALF[k] * HALF[k]);
  }
  return (1.0 - sqrt(square)) * HALF[1];
}

static fg_icons *icons_of(const double center[3], fg_context *context)
{
  static float u[N * M * L], velocity[3][N * M * L];
  double axis[3][MOST];
  for (int k = 0; k < 3; ++k)
    for (int n = 0; n < NODES[k]; ++n)
      axis[k][n] = LOW[k] + SPACING[k] * n;
  for (int n = 0; n < N * M * L; ++n) {
    const double p[3] = {axis[0][n % N], axis[1][n / N % M], axis[2][n / N / M]};
    u[n] = (float)fmax(fmin(depth_at(p, center) / SPACING[1], 1.0), -1.0);
    velocity[0][n] = 3.0F;
    velocity[1][n] = 0.2F;
    velocity[2][n] = -0.3F;
  }
  fg_field_arrays of_field = {.dimension = 3,
                              .size = {N, M, L},
                              .axis = {axis[0], axis[1], axis[2]},
                              .period = {side_of(0), side_of(1), side_of(2)},
                              .velocity = {velocity[0], velocity[1], velocity[2]}};
  fg_density_arrays of_density = {.dimension = 3,
                                  .nodes = {N, M, L},
                                  .origin = {LOW[0], LOW[1], LOW[2]},
                                  .spacing = {SPACING[0], SPACING[1], SPACING[2]},
                                  .periodic = {true, true, true},
                                  .u = u};
  fg_field *field;
  fg_density *density;
  fg_icons *icons;
  assert_int_equal(fg_field_create(&field, context, &of_field), FG_STATUS_OK);
  assert_int_equal(fg_density_create_from_arrays(&density, context, &of_density),
                   FG_STATUS_OK);
  assert_int_equal(fg_icons_create(&icons, context, field, density, NULL), FG_STATUS_OK);
  fg_density_destroy(density);
  fg_field_destroy(field);
  return icons;
}

/* Every vertex of the solids lies in the domain and in the grain; the parts' volumes are
 * no more than the grain's, which is returned in shares of it. */
static double judge(const fg_icons *icons, fg_context *context, const double center[3])
{
  double volume = 0.0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    fg_surface *solid;
    assert_int_equal(icon->cluster, 1);
    assert_int_equal(fg_icon_solid(&solid, context, icon), FG_STATUS_OK);
    assert_true(solid->vertex_count > 0);
    for (int i = 0; i < solid->vertex_count; ++i) {
      for (int k = 0; k < 3; ++k)
        assert_true(solid->vertex[i][k] > LOW[k] &&
                    solid->vertex[i][k] < LOW[k] + side_of(k));
      assert_true(depth_at(solid->vertex[i], center) > -0.05 * SPACING[1]);
    }
    const double *tail = icon->points[0], *tip = icon->points[icon->point_count - 1];
    assert_true(tip[0] - tail[0] > 0.9 * fg__distance(tip, tail));
    fg_surface_destroy(solid);
    volume += icon->area;
  }
  return volume / (4.0 / 3.0 * PI * HALF[0] * HALF[1] * HALF[2]);
}

/* Along the flow: where the boundary leaves a good part on either side, each has an arrow
 * of its own, else the larger has. */
static void a_grain_across_a_boundary_is_cut_there(void **state)
{
  (void)state;
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (int n = 0; n < 12; ++n) {
    double center[3] = {LOW[0] + 0.93 * n + 0.2, 6.1, 6.3};
    double beside = fmin(center[0] - LOW[0], LOW[0] + side_of(0) - center[0]);
    fg_icons *icons = icons_of(center, context);
    assert_int_equal(fg_icons_clusters(icons), 1);
    /* an ellipsoid cut at 0.35 of its half length: a quarter is left */
    if (fabs(beside / HALF[0] - 0.35) > 0.08)
      assert_int_equal(fg_icons_count(icons), beside < 0.35 * HALF[0] ? 2 : 1);
    double share = judge(icons, context, center);
    assert_true(share > 0.6 && share < 1.05);
    fg_icons_destroy(icons);
  }
  fg_context_destroy(context);
}

/* Across the flow, and at an edge and a corner of the domain. */
static void so_is_one_at_an_edge_and_a_corner(void **state)
{
  (void)state;
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (int way = 1; way < 8; ++way) {
    double center[3];
    for (int k = 0; k < 3; ++k)
      center[k] = way >> k & 1 ? LOW[k] + 0.1 : LOW[k] + 0.5 * side_of(k);
    fg_icons *icons = icons_of(center, context);
    assert_in_range(fg_icons_count(icons), 1, 8);
    assert_true(judge(icons, context, center) < 1.2);
    fg_icons_destroy(icons);
  }
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_grain_across_a_boundary_is_cut_there),
      cmocka_unit_test(so_is_one_at_an_edge_and_a_corner),
  };
  return cmocka_run_group_tests_name("icon/solids_boundary", tests, NULL, NULL);
}
