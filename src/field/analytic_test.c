#include <math.h>
#include <string.h>

#include "base/context_test.h"

enum { NODES = 201 }; /* samples at multiples of 0.005, so every core lies on one */

static fg_context *context_of(void)
{
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  return context;
}

static fg_field *field_of(fg_context *context, const char *name)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, context, name, NODES), FG_STATUS_OK);
  return field;
}

static void velocity_at(const char *name, double x, double y, double velocity[2])
{
  fg_context *context = context_of();
  fg_field *field = field_of(context, name);
  const fg_field_arrays *contents = fg_field_contents(field);
  size_t i = (size_t)lround(x * (NODES - 1)), j = (size_t)lround(y * (NODES - 1));
  assert_true(fabs(contents->axis[0][i] - x) < 1e-12);
  assert_true(fabs(contents->axis[1][j] - y) < 1e-12);
  velocity[0] = (double)contents->velocity[0][j * NODES + i];
  velocity[1] = (double)contents->velocity[1][j * NODES + i];
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void assert_velocity(const char *name, double x, double y, double u, double v,
                            double tolerance)
{
  double velocity[2];
  velocity_at(name, x, y, velocity);
  assert_true(fabs(velocity[0] - u) <= tolerance);
  assert_true(fabs(velocity[1] - v) <= tolerance);
}

static void fields_have_their_words(void **state)
{
  (void)state;
  fg_context *context = context_of();
  fg_field *field = field_of(context, "vortex3");
  const fg_field_arrays *contents = fg_field_contents(field);
  assert_int_equal(contents->dimension, 2);
  assert_int_equal(contents->size[0], NODES);
  assert_int_equal(contents->size[1], NODES);
  assert_string_equal(contents->axis_name[0], "x");
  assert_string_equal(contents->axis_name[1], "y");
  assert_string_equal(contents->axis_units[0], "");
  assert_string_equal(contents->velocity_units, "");
  assert_string_equal(contents->title, "vortex3 (analytic)");
  assert_true(contents->scale == FG_SCALE_PLAIN);
  assert_true(contents->axis[0][NODES - 1] == 1.0);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void special_points_have_values_found_by_hand(void **state)
{
  (void)state;
  /* cos and sin of 25 degrees from a table */
  assert_velocity("uniform", 0.13, 0.87, 0.90630779, 0.42261826, 1e-7);
  /* right of the middle a positive rotation goes up, above it to the left */
  assert_velocity("vortex", 0.9, 0.5, 0.0, 0.4, 1e-7);
  assert_velocity("vortex", 0.5, 0.6, -0.1, 0.0, 1e-7);
  assert_velocity("saddle", 0.9, 0.6, 0.4, -0.1, 1e-7);
  /* at the first core (0.28, 0.30) the others give, with d = (-0.46, -0.04) and
   * |d|^2 + 0.0064 = 0.2196: (-0.04, 0.46) / 0.2196; with d = (-0.20, -0.44) and 0.24:
   * (0.44, -0.20) / 0.24 */
  assert_velocity("vortex3", 0.28, 0.30, -0.04 / 0.2196 + 0.44 / 0.24,
                  0.46 / 0.2196 - 0.20 / 0.24, 1e-6);
  /* at (1/2, 1/2) both cosines of the first roll's derivatives vanish but cos 2 pi / 2 */
  assert_velocity("benard", 0.5, 0.5, 0.0, 0.0, 1e-6);
  /* psi_y at (1/2, 0) = pi sin(3 pi / 2) = -pi */
  assert_velocity("benard", 0.5, 0.0, -3.14159265, 0.0, 1e-6);
  /* at (1/4, 1/2): psi_y = -pi / 2, -psi_x = -3 pi cos(3 pi / 4) = 3 pi / sqrt 2 */
  assert_velocity("benard", 0.25, 0.5, -1.57079633, 6.66432441, 1e-6);
}

static void rolls_do_not_cross_the_walls(void **state)
{
  (void)state;
  fg_context *context = context_of();
  fg_field *field = field_of(context, "benard");
  const fg_field_arrays *contents = fg_field_contents(field);
  for (size_t k = 0; k < NODES; ++k) {
    assert_true(contents->velocity[0][k * NODES] == 0.0f);
    assert_true(contents->velocity[0][k * NODES + NODES - 1] == 0.0f);
    assert_true(contents->velocity[1][k] == 0.0f);
    assert_true(contents->velocity[1][(NODES - 1) * NODES + k] == 0.0f);
  }
  fg_field_destroy(field);
  fg_context_destroy(context);
}

/* Net flow out of, and circulation round, a box of samples by the trapezoidal rule, whose
 * error here is far below the tolerances (h = 0.005, the fields vary over 0.08). */
static void round_trip(const fg_field_arrays *contents, const size_t box[4],
                       double *outflow, double *circulation)
{
  double h = 1.0 / (NODES - 1);
  *outflow = *circulation = 0.0;
  for (size_t i = box[0]; i <= box[1]; ++i) {
    double weight = i == box[0] || i == box[1] ? 0.5 * h : h;
    size_t low = box[2] * NODES + i, high = box[3] * NODES + i;
    *outflow +=
        weight * (double)(contents->velocity[1][high] - contents->velocity[1][low]);
    *circulation +=
        weight * (double)(contents->velocity[0][low] - contents->velocity[0][high]);
  }
  for (size_t j = box[2]; j <= box[3]; ++j) {
    double weight = j == box[2] || j == box[3] ? 0.5 * h : h;
    size_t left = j * NODES + box[0], right = j * NODES + box[1];
    *outflow +=
        weight * (double)(contents->velocity[0][right] - contents->velocity[0][left]);
    *circulation +=
        weight * (double)(contents->velocity[1][right] - contents->velocity[1][left]);
  }
}

static void every_field_is_free_of_divergence(void **state)
{
  (void)state;
  static const size_t boxes[][4] = {
      {0, 200, 0, 200}, {11, 90, 37, 163}, {120, 177, 3, 80}};
  fg_context *context = context_of();
  static const char *const names[] = {"uniform", "vortex", "saddle", "vortex3", "benard"};
  for (size_t n = 0; n < 5; ++n) {
    fg_field *field = field_of(context, names[n]);
    for (size_t b = 0; b < 3; ++b) {
      double outflow, circulation;
      round_trip(fg_field_contents(field), boxes[b], &outflow, &circulation);
      assert_true(fabs(outflow) < 2e-3);
    }
    fg_field_destroy(field);
  }
  fg_context_destroy(context);
}

static void circulation_is_curl_times_area(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    double curl;
  } cases[] = {{"uniform", 0.0}, {"vortex", 2.0}, {"saddle", 0.0}};
  const size_t box[4] = {11, 90, 37, 163};
  double area = (90 - 11) * (163 - 37) * 0.005 * 0.005;
  fg_context *context = context_of();
  for (size_t c = 0; c < 3; ++c) {
    fg_field *field = field_of(context, cases[c].name);
    double outflow, circulation;
    round_trip(fg_field_contents(field), box, &outflow, &circulation);
    assert_true(fabs(circulation - cases[c].curl * area) < 1e-6);
    fg_field_destroy(field);
  }
  fg_context_destroy(context);
}

static void vortices_turn_the_way_of_their_sign(void **state)
{
  (void)state;
  /* boxes of half width 0.08 round each core */
  static const size_t boxes[][4] = {
      {40, 72, 44, 76}, {132, 164, 52, 84}, {80, 112, 132, 164}};
  static const double sign[] = {1.0, -1.0, 1.0};
  fg_context *context = context_of();
  fg_field *field = field_of(context, "vortex3");
  for (size_t b = 0; b < 3; ++b) {
    double outflow, circulation;
    round_trip(fg_field_contents(field), boxes[b], &outflow, &circulation);
    /* a core of radius a holds half its circulation 2 pi within a circle of radius a */
    assert_true(sign[b] * circulation > 3.14159);
    assert_true(sign[b] * circulation < 6.28319);
  }
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static fg_field *volume_of(fg_context *context, const char *name, int nodes)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, context, name, nodes), FG_STATUS_OK);
  assert_int_equal(fg_field_contents(field)->dimension, 3);
  return field;
}

static void assert_velocity_3d(const fg_field *field, const double at[3],
                               const double expected[3])
{
  double velocity[3];
  assert_true(fg_field_velocity(field, at, velocity));
  for (int k = 0; k < 3; ++k)
    assert_true(fabs(velocity[k] - expected[k]) < 1e-6);
}

static void volumes_have_values_found_by_hand(void **state)
{
  (void)state;
  fg_context *context = context_of();
  fg_field *vortex = volume_of(context, "vortex3d", 11);
  assert_velocity_3d(vortex, (double[]){0.5, 0.5, 0.7}, (double[]){0.0, 0.0, 0.6});
  /* 0.6 e^-0.48 = 0.37127003 at a distance of 0.2 */
  assert_velocity_3d(vortex, (double[]){0.7, 0.5, 0.1}, (double[]){0.0, 0.2, 0.37127003});
  assert_velocity_3d(vortex, (double[]){0.5, 0.3, 1.0}, (double[]){0.2, 0.0, 0.37127003});
  fg_field_destroy(vortex);

  fg_field *abc = volume_of(context, "abc", 13);
  assert_velocity_3d(abc, (double[]){0.0, 0.0, 0.0}, (double[]){1.0, 1.0, 1.0});
  /* X = pi / 2, Y = pi, Z = pi / 6 */
  assert_velocity_3d(abc, (double[]){0.25, 0.5, 1.0 / 12.0},
                     (double[]){0.5 - 1.0, 1.0 + 0.8660254, 0.0 + 0.0});
  fg_field_destroy(abc);
  fg_context_destroy(context);
}

/* The axes of abc may change places in turn, and it goes on for ever. */
static void abc_looks_alike_along_its_axes(void **state)
{
  (void)state;
  fg_context *context = context_of();
  fg_field *field = volume_of(context, "abc", 21);
  const fg_field_arrays *contents = fg_field_contents(field);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(contents->size[k], 20);
    assert_true(contents->period[k] == 1.0);
  }
  for (int n = 0; n < 200; ++n) {
    double at[3] = {0.37 * n, 1.0 - 0.73 * n, 0.11 * n * n}, turned[3], far[3];
    double v[3], w[3], x[3];
    for (int k = 0; k < 3; ++k) {
      turned[(k + 1) % 3] = at[k];
      far[k] = at[k] + 3.0 * k - 2.0;
    }
    assert_true(fg_field_velocity(field, at, v));
    assert_true(fg_field_velocity(field, turned, w));
    assert_true(fg_field_velocity(field, far, x));
    for (int k = 0; k < 3; ++k) {
      assert_true(fabs(w[(k + 1) % 3] - v[k]) < 1e-6);
      assert_true(fabs(x[k] - v[k]) < 1e-6);
    }
  }
  fg_field_destroy(field);
  fg_context_destroy(context);
}

/* The curl of abc is 2 pi times itself (Beltrami); central differences of samples err by
 * (2 pi h)^2 / 6 = 0.4 % here. */
static void abc_is_its_own_curl(void **state)
{
  (void)state;
  enum { SIDE = 40 };
  const double h = 1.0 / SIDE;
  fg_context *context = context_of();
  fg_field *field = volume_of(context, "abc", SIDE + 1);
  for (int n = 0; n < SIDE; ++n) {
    const double at[3] = {n * h, (n * 7 % SIDE) * h, (n * 3 % SIDE) * h};
    double gradient[3][3], v[3]; /* [k][c]: d v_c / d x_k */
    for (int k = 0; k < 3; ++k) {
      double ahead[3] = {at[0], at[1], at[2]}, behind[3] = {at[0], at[1], at[2]};
      double before[3];
      ahead[k] += h;
      behind[k] -= h;
      assert_true(fg_field_velocity(field, ahead, gradient[k]));
      assert_true(fg_field_velocity(field, behind, before));
      for (int c = 0; c < 3; ++c)
        gradient[k][c] = (gradient[k][c] - before[c]) / (2.0 * h);
    }
    assert_true(fg_field_velocity(field, at, v));
    assert_true(fabs(gradient[0][0] + gradient[1][1] + gradient[2][2]) < 1e-4);
    for (int c = 0; c < 3; ++c) {
      int k = (c + 1) % 3, l = (c + 2) % 3;
      double curl = gradient[k][l] - gradient[l][k];
      assert_true(fabs(curl - 2.0 * 3.14159265 * v[c]) < 0.06);
    }
  }
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void impossible_requests_are_refused(void **state)
{
  (void)state;
  fg_context *context = context_of();
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, context, "vortex4", 33),
                   FG_STATUS_ARGUMENT);
  assert_null(field);
  assert_non_null(strstr(fg_context_message(context), "vortex4"));
  assert_non_null(strstr(fg_context_hint(context), "benard"));
  fg_context_clear(context);
  assert_int_equal(fg_field_create_analytic(&field, context, "abc", 2),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(context), "3 to 1290"));
  fg_context_clear(context);
  assert_int_equal(fg_field_create_analytic(&field, context, "vortex3d", 1291),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(context), "2 to 1290"));
  fg_context_clear(context);
  static const int nodes[] = {-3, -1, 1, 46341, INT32_MAX};
  for (size_t i = 0; i < 5; ++i) {
    assert_int_equal(fg_field_create_analytic(&field, context, "vortex", nodes[i]),
                     FG_STATUS_ARGUMENT);
    fg_context_clear(context);
  }
  assert_int_equal(fg_field_create_analytic(&field, context, NULL, 33),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(fg_field_create_analytic(NULL, context, "vortex", 33),
                   FG_STATUS_ARGUMENT);
  fg_context_clear(context);
  /* four corners of closed rolls: nothing moves there */
  assert_int_equal(fg_field_create_analytic(&field, context, "benard", 2),
                   FG_STATUS_ARGUMENT);
  assert_null(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_have_their_words),
      cmocka_unit_test(special_points_have_values_found_by_hand),
      cmocka_unit_test(rolls_do_not_cross_the_walls),
      cmocka_unit_test(every_field_is_free_of_divergence),
      cmocka_unit_test(circulation_is_curl_times_area),
      cmocka_unit_test(vortices_turn_the_way_of_their_sign),
      cmocka_unit_test(volumes_have_values_found_by_hand),
      cmocka_unit_test(abc_looks_alike_along_its_axes),
      cmocka_unit_test(abc_is_its_own_curl),
      cmocka_unit_test(impossible_requests_are_refused),
  };
  return cmocka_run_group_tests_name("field/analytic", tests, NULL, NULL);
}
