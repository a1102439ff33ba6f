/* Axes on another scale than they are measured on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "terms/measure.h"

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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(units_tell_the_scale),
  };
  return cmocka_run_group_tests_name("terms/measure", tests, NULL, NULL);
}
