/* Numbers as text are what printf would write with the fewest of 15 or 17 digits. */
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/decimal.h"

static void assert_text(double number)
{
  char text[FG__NUMBER_BYTES], expected[FG__NUMBER_BYTES];
  snprintf(expected, sizeof expected, "%.15g", number);
  if (strtod(expected, NULL) != number)
    snprintf(expected, sizeof expected, "%.17g", number);
  fg__number_write(text, number);
  if (strcmp(text, expected) != 0)
    fail_msg("%s instead of %s", text, expected);
  if (strtod(text, NULL) != number)
    fail_msg("%s is not %.17g", text, number);
}

/* xorshift64 (Marsaglia 2003). */
static uint64_t draw(uint64_t *state)
{
  *state ^= *state << 13;
  *state ^= *state >> 7;
  *state ^= *state << 17;
  return *state;
}

static void numbers_are_printfs(void **state)
{
  (void)state;
  static const double special[] = {0.0,
                                   -0.0,
                                   1.0,
                                   -1.0,
                                   10.0,
                                   0.1,
                                   0.03,
                                   1e-4,
                                   -1e-4,
                                   9.99e-5,
                                   1e15,
                                   1e-300,
                                   1e300,
                                   0.5,
                                   5e-324,
                                   1e14,
                                   123456789012345.0,
                                   999999999999999.0,
                                   9999999999999998.0,
                                   0.000123456789012345,
                                   1e-5,
                                   179.9999999,
                                   -180.0,
                                   99999.99999999999,
                                   0.30000000000000004,
                                   9.9999999999999995,
                                   0.99999999999999989,
                                   2147483648.0};
  for (size_t k = 0; k < sizeof special / sizeof *special; ++k)
    assert_text(special[k]);
  uint64_t random = 88172645463325252u;
  for (int n = 0; n < 20000; ++n) {
    const double whole = (double)(int64_t)draw(&random);
    for (int places = 1; places < 19; places += 3)
      assert_text(nearbyint(whole * 1e-4) / pow(10.0, places)); /* up to 15 digits */
    assert_text(whole / 9223372036854775808.0 * pow(10.0, (double)(n % 24) - 6.0));
    assert_text(nearbyint(whole * 1e-9) * 1e-7); /* a rounding error off a short one */
    assert_text(ldexp(whole, n % 120 - 120));
    assert_text(nextafter(pow(10.0, n % 24 - 6), n % 2 ? 0.0 : 1e300));
  }
}

static void numbers_are_rounded(void **state)
{
  (void)state;
  char text[FG__NUMBER_BYTES];
  fg__number_round(text, 38.5, 9);
  assert_string_equal(text, "38.5");
  fg__number_round(text, -45.2340011596679688, 9);
  assert_string_equal(text, "-45.2340012");
}

/* Locales that write 2,5 or have a longer point need not be installed. */
static void numbers_are_read_with_a_point(void **state)
{
  (void)state;
  static const char *const other[] = {"C", "de_DE.UTF-8", "de_DE", "ps_AF.UTF-8"};
  const char *end;
  for (size_t n = 0; n < sizeof other / sizeof *other; ++n) {
    setlocale(LC_NUMERIC, other[n]);
    const double number = fg__number_read("2.75e1m", &end);
    setlocale(LC_NUMERIC, "C");
    assert_true(number == 27.5);
    assert_string_equal(end, "m");
  }
  assert_true(fg__number_read("-3 m", &end) == -3.0);
  assert_string_equal(end, " m");
  assert_true(fg__number_read(".5", &end) == 0.5);
  assert_string_equal(end, "");
  fg__number_read("none", &end);
  assert_string_equal(end, "none");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_are_printfs),
                                     cmocka_unit_test(numbers_are_rounded),
                                     cmocka_unit_test(numbers_are_read_with_a_point)};
  return cmocka_run_group_tests_name("base/decimal", tests, NULL, NULL);
}
