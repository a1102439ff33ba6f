#include "field/made_test.h"

#include <math.h>

enum { SIDE = 200 };

/* Speeds 1 to 200, a row each; the last column is missing, and fast. */
static fg_field *make_rows(fg_scale scale)
{
  static double x[SIDE], y[SIDE];
  static float u[SIDE * SIDE], v[SIDE * SIDE];
  for (int n = 0; n < SIDE; ++n) {
    x[n] = 0.5 * n;
    y[n] = -89.55 + 0.9 * n;
  }
  for (int n = 0; n < SIDE * SIDE; ++n) {
    const float row = (float)(n / SIDE + 1);
    u[n] = n % SIDE == SIDE - 1 ? 1e6F : -0.6F * row;
    v[n] = n % SIDE == SIDE - 1 ? NAN : 0.8F * row;
  }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {SIDE, SIDE, 0},
                                  .axis = {x, y, NULL},
                                  .velocity = {u, v, NULL},
                                  .scale = scale};
  return field_made(NULL, &arrays);
}

static void a_twentieth_of_the_area_is_beyond_either_end(void **state)
{
  (void)state;
  double range[2];
  fg_field *field = make_rows(FG_SCALE_PLAIN);
  assert_int_equal(fg_field_speed_range(range, NULL, field), FG_STATUS_OK);
  assert_true(fabs(range[0] - 10.0) < 1e-4 && fabs(range[1] - 190.0) < 1e-4);
  fg_field_destroy(field);
  /* of the sphere, 5 % lies beyond asin(0.9) = 64.16 degrees: of rows 29 to 172 */
  field = make_rows(FG_SCALE_GEO);
  assert_int_equal(fg_field_speed_range(range, NULL, field), FG_STATUS_OK);
  assert_true(fabs(range[0] - 29.0) <= 1.0 && fabs(range[1] - 172.0) <= 1.0);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_twentieth_of_the_area_is_beyond_either_end),
  };
  return cmocka_run_group_tests_name("field/speed_range", tests, NULL, NULL);
}
