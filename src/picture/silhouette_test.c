#include "picture/silhouette.h"

#include <math.h>

#include "base/vector.h"
#include "picture/solid_field_test.h"

static const double middle[3] = {4.1, -0.45, 10.8};

static bool everywhere(const double place[3], double velocity[3])
{
  velocity[0] = 1.0 + 0.3 * place[1];
  return true;
}

/* All but a ball. */
static bool round_a_ball(const double place[3], double velocity[3])
{
  velocity[1] = 2.0;
  return fg__distance(place, middle) > 0.31;
}

/* Along an upright vessel, which fills a fortieth of the box, and noise outside. */
static bool in_a_vessel(const double place[3], double velocity[3])
{
  double from_axis = hypot(place[0] - middle[0], place[1] - middle[1]) / 0.13;
  velocity[2] = from_axis < 1.0 ? 4.0 * (1.3 - from_axis) : 0.0;
  velocity[0] = 0.03 * sin(50.0 * place[0] + 31.0 * place[1] * place[2]);
  return true;
}

/* An upright cylinder that touches four sides of a box as high as it. */
static bool in_a_cylinder(const double place[3], double velocity[3])
{
  velocity[2] = 1.0;
  return hypot((place[0] - field_low[0] - 1.0) / 2.0, place[1] - field_low[1] - 0.5) <=
         0.5 + 1e-9;
}

static void a_full_box_has_none(void **state)
{
  (void)state;
  fg_field *field = field_of(everywhere);
  fg_surface *surface;
  assert_int_equal(fg__silhouette_create(&surface, NULL, field), FG_STATUS_OK);
  assert_null(surface);
  fg_field_destroy(field);
}

/* A sixth of the surface's triangles with the middle: the volume inside. */
static double volume_round(const fg_surface *s, const double center[3])
{
  double sum = 0.0;
  for (int n = 0; n < s->triangle_count; ++n) {
    double to[3][3], across[3];
    for (int c = 0; c < 3; ++c)
      fg__subtract(s->vertex[s->corner[s->triangle[n][c]]], center, to[c]);
    fg__cross(to[1], to[2], across);
    sum += fg__dot(to[0], across) / 6.0;
  }
  return sum;
}

static void a_hole_is_shown(void **state)
{
  (void)state;
  fg_field *field = field_of(round_a_ball);
  fg_surface *surface;
  assert_int_equal(fg__silhouette_create(&surface, NULL, field), FG_STATUS_OK);
  assert_non_null(surface);
  for (int n = 0; n < surface->vertex_count; ++n) {
    double radius = fg__distance(surface->vertex[n], middle);
    assert_true(radius > 0.27 && radius < 0.40); /* cells with a missing corner count */
  }
  /* the flow is outside: normals point into the ball */
  double volume = -volume_round(surface, middle);
  assert_true(volume > 4.19 * pow(0.29, 3.0) && volume < 4.19 * pow(0.38, 3.0));
  fg_surface_destroy(surface);
  fg_field_destroy(field);
}

static void what_moves_is_shown_in_noise(void **state)
{
  (void)state;
  fg_field *field = field_of(in_a_vessel);
  fg_surface *surface;
  assert_int_equal(fg__silhouette_create(&surface, NULL, field), FG_STATUS_OK);
  assert_non_null(surface);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (int n = 0; n < surface->vertex_count; ++n) {
    const double *at = surface->vertex[n];
    double radius = hypot(at[0] - middle[0], at[1] - middle[1]);
    assert_true(radius > 0.08 && radius < 0.17); /* open at its ends */
    low = fmin(low, at[2]);
    high = fmax(high, at[2]);
  }
  assert_true(fabs(low - 10.0) < 1e-9 && fabs(high - 11.5) < 1e-9);
  fg_surface_destroy(surface);
  fg_field_destroy(field);
}

/* A vessel with a thinner one beside it, of one sample across and slower. */
static bool in_two_vessels(const double place[3], double velocity[3])
{
  const double apart[2] = {(place[0] - middle[0] - 0.5) / (field_side[0] / 40.0),
                           (place[1] - middle[1]) / (field_side[1] / 40.0)};
  in_a_vessel(place, velocity);
  if (fabs(apart[0]) < 0.5 && fabs(apart[1]) < 0.5)
    velocity[2] = 2.0;
  return true;
}

static void a_thin_branch_is_shown(void **state)
{
  (void)state;
  fg_field *field = field_of(in_two_vessels);
  fg_surface *surface;
  assert_int_equal(fg__silhouette_create(&surface, NULL, field), FG_STATUS_OK);
  double low = HUGE_VAL, high = -HUGE_VAL;
  int count = 0;
  for (int n = 0; n < surface->vertex_count; ++n) {
    const double *at = surface->vertex[n];
    double radius = hypot(at[0] - middle[0] - 0.5, at[1] - middle[1]);
    if (at[0] < middle[0] + 0.3)
      continue;
    assert_true(radius < 2.0 * field_side[0] / 40.0);
    low = fmin(low, at[2]);
    high = fmax(high, at[2]);
    ++count;
  }
  assert_true(count > 100);
  assert_true(fabs(low - 10.0) < 1e-9 && fabs(high - 11.5) < 1e-9);
  fg_surface_destroy(surface);
  fg_field_destroy(field);
}

/* It is open above and below, closed where it only touches the box. */
static void it_is_open_where_the_box_ends_it(void **state)
{
  (void)state;
  fg_field *field = field_of(in_a_cylinder);
  fg_surface *surface;
  assert_int_equal(fg__silhouette_create(&surface, NULL, field), FG_STATUS_OK);
  assert_non_null(surface);
  double farthest[2] = {0.0, 0.0};
  for (int n = 0; n < surface->vertex_count; ++n) {
    const double *at = surface->vertex[n];
    const double to[2] = {(at[0] - field_low[0] - 1.0) / 2.0, at[1] - field_low[1] - 0.5};
    assert_true(hypot(to[0], to[1]) > 0.44 && hypot(to[0], to[1]) < 0.52);
    assert_true(fabs((double)surface->normal[n][2]) < 0.3);
    for (int k = 0; k < 2; ++k)
      farthest[k] = fmax(farthest[k], fabs(to[k]));
  }
  assert_true(farthest[0] > 0.46 && farthest[1] > 0.46);
  fg_surface_destroy(surface);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_full_box_has_none),
      cmocka_unit_test(a_hole_is_shown),
      cmocka_unit_test(what_moves_is_shown_in_noise),
      cmocka_unit_test(a_thin_branch_is_shown),
      cmocka_unit_test(it_is_open_where_the_box_ends_it),
  };
  return cmocka_run_group_tests_name("picture/silhouette", tests, NULL, NULL);
}
