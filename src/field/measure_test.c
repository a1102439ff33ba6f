/* Axes on another scale than they are measured on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/context_test.h"
#include "field/measure.h"
#include "field/region.h"

static void units_tell_the_scale(void **state)
{
  static const struct {
    const char *units, *measured;
    double coordinate, value;
  } rows[] = {
      {"hPa", "hPa", 3.0, 3.0},
      {"", "", 3.0, 3.0},
      {"-25 hPa", "hPa", 2.0, -50.0},
      {"0.001 km", "km", 2.0, 0.002},
      {"1", "1", 2.0, 2.0},
      {"2000 m", "m", 1.5, 3000.0},
      {"0 m", "0 m", 2.0, 2.0},
      {"nan m", "nan m", 2.0, 2.0},
      {"-0.5 lg(re 1 hPa)", "hPa", -4.0, 100.0},
  };
  (void)state;
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    const fg__measure m = fg__measure_of(rows[n].units);
    assert_string_equal(m.units, rows[n].measured);
    assert_true(fg__measure_value(&m, rows[n].coordinate) == rows[n].value);
    assert_true(fg__measure_coordinate(&m, rows[n].value) == rows[n].coordinate);
  }
}

static void regions_are_measured(void **state)
{
  enum { SIDE = 5 };
  static const double axis[2][SIDE] = {{0, 1, 2, 3, 4}, {-40, -30, -20, -10, -4}};
  float velocity[SIDE * SIDE];
  fg_field *field;
  for (int n = 0; n < SIDE * SIDE; ++n)
    velocity[n] = 1.0F;
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {SIDE, SIDE},
                                  .axis = {axis[0], axis[1]},
                                  .velocity = {velocity, velocity},
                                  .axis_name = {"x", "level"},
                                  .axis_units = {"m", "-25 hPa"}};
  const fg__field_region region = {2, {1, 250}, {3, 1000}},
                         beyond = {2, {1, 1100}, {3, 1200}};
  char units[FG__MEASURE_BYTES];
  assert_int_equal(fg_field_create(&field, *state, &arrays), FG_STATUS_OK);
  assert_int_equal(fg__region_cut(&field, *state, "a", &beyond), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(*state),
                         "from level = 1100 to 1200, and the field from 1000 to 100"));
  fg_context_clear(*state);
  assert_int_equal(fg__region_cut(&field, *state, "a", &region), FG_STATUS_OK);
  const fg_field_arrays *cut = fg_field_contents(field);
  assert_int_equal(cut->size[1], 4);
  assert_true(fg_field_measured(field, 1, cut->axis[1][0]) == 1000.0);
  assert_true(fg_field_measured(field, 1, cut->axis[1][3]) == 250.0);
  assert_true(fg_field_measured(field, 0, cut->axis[0][0]) == 1.0);
  fg_field_measured_units(units, sizeof units, field, 1);
  assert_string_equal(units, "hPa");
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(units_tell_the_scale),
      cmocka_unit_test_setup_teardown(regions_are_measured, context_set_up,
                                      context_tear_down),
  };
  return cmocka_run_group_tests_name("field/measure", tests, NULL, NULL);
}
