#include <string.h>

#include "base/context_test.h"
#include "picture/plain_text.h"
#include "picture/units.h"

#define POWER(digits) FG__TEXT_RAISE digits FG__TEXT_LOWER
#define MINUS "\xE2\x88\x92"

static void spellings_of_one_unit_agree(void **state)
{
  (void)state;
  static const char *const spellings[] = {
      "m s-1",          "m/s",          "m s**-1",
      "m.s-1",          "m s^-1",       "m*s^-1",
      "m sec-1",        "meter/second", "meters per second",
      "metre second-1", "(m/s)",        "[m s-1]",
      " m/s ",          "m\xC2\xB7s-1", "Meters/Second"};
  for (size_t k = 0; k < sizeof spellings / sizeof *spellings; ++k) {
    char out[FG__UNITS_BYTES];
    fg__units_write(out, spellings[k]);
    assert_string_equal(out, "m s" POWER(MINUS "1"));
  }
}

static void other_products_are_written(void **state)
{
  (void)state;
  static const char *const pairs[][2] = {
      {"cm/s", "cm s" POWER(MINUS "1")},
      {"kg m-2 s-1", "kg m" POWER(MINUS "2") " s" POWER(MINUS "1")},
      {"m2 s**-2", "m" POWER("2") " s" POWER(MINUS "2")},
      {"1/s", "s" POWER(MINUS "1")},
      {"knots", "kn"},
      {"Pa/s", "Pa s" POWER(MINUS "1")},
      {"%", "%"},
      {"1", ""},
      {"", ""},
  };
  for (size_t k = 0; k < sizeof pairs / sizeof *pairs; ++k) {
    char out[FG__UNITS_BYTES];
    fg__units_write(out, pairs[k][0]);
    assert_string_equal(out, pairs[k][1]);
  }
}

static void what_is_no_product_stays(void **state)
{
  (void)state;
  static const char *const odd[] = {"m/", "3 apples", "m^", "s-1000", "hours since 1900"};
  for (size_t k = 0; k < sizeof odd / sizeof *odd; ++k) {
    char out[FG__UNITS_BYTES];
    fg__units_write(out, odd[k]);
    assert_string_equal(out, odd[k]);
  }
}

/* Nothing from a file leaves the buffer or is no text. */
static void any_bytes_give_a_short_text(void **state)
{
  (void)state;
  uint32_t seed = 12345;
  static const char alphabet[] = "ms-1^*/. \xC2\xB7%29\001\002k(";
  for (int run = 0; run < 20000; ++run) {
    char in[300], out[FG__UNITS_BYTES];
    seed = seed * 1664525U + 1013904223U;
    size_t length = seed >> 8 & 255;
    for (size_t k = 0; k < length; ++k) {
      seed = seed * 1664525U + 1013904223U;
      in[k] = run & 1 ? alphabet[(seed >> 10) % (sizeof alphabet - 1)]
                      : (char)(1 + (seed >> 10) % 255);
    }
    in[length] = '\0';
    fg__units_write(out, in);
    assert_non_null(memchr(out, '\0', sizeof out));
    char again[FG__UNITS_BYTES];
    fg__text_clean(again, sizeof again, out);
    assert_int_equal(strlen(again), strlen(out)); /* UTF-8: nothing to replace */
  }
}

static void lengths_are_known(void **state)
{
  (void)state;
  assert_true(fg__units_metres("m") == 1.0);
  assert_true(fg__units_metres("kilometers") == 1e3);
  assert_true(fg__units_metres("mm") == 1e-3);
  assert_true(fg__units_metres("m s-1") == 0.0);
  assert_true(fg__units_metres("") == 0.0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spellings_of_one_unit_agree),
      cmocka_unit_test(other_products_are_written),
      cmocka_unit_test(what_is_no_product_stays),
      cmocka_unit_test(any_bytes_give_a_short_text),
      cmocka_unit_test(lengths_are_known),
  };
  return cmocka_run_group_tests_name("picture/units", tests, NULL, NULL);
}
