#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/plain_text.h"
#include "picture/ticks.h"

#define MINUS "\xE2\x88\x92"
#define DEGREE "\xC2\xB0"

/* Reads a tick's text back into a number. */
static double read_number(const char *text)
{
  bool negative = strncmp(text, MINUS, strlen(MINUS)) == 0;
  double size = atof(negative ? text + strlen(MINUS) : text);
  return negative ? -size : size;
}

static void texts_read_back_as_positions(void **state)
{
  (void)state;
  static const struct {
    double low, high;
    const char *units;
  } cases[] = {
      {0.13, 0.87, ""},           {-3.7, 12.1, "m"},     {2e5, 9.4e5, "m"},
      {1e-5, 1.7e-4, ""},         {3.1e6, 8.8e6, ""},    {6.5e6, 6.71e6, "m"},
      {1234567.2, 1234567.9, ""}, {-40.0, -39.0, "km"},  {0.0, 3e-4, "m"},
      {-1e8, -1e8 + 7.0, "cm"},   {2.0, 90000.0, "mm"},  {-40.0, -4.0, "-25 hPa"},
      {0.0, 6.0, "2000 m"},       {-6.0, 0.0, "-2000 m"}};
  for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
    double low = cases[c].low, high = cases[c].high, range = high - low;
    fg__tick_axis axis;
    fg__axis_of_numbers(&axis, low, high, range, "x", cases[c].units);
    for (int parts = 2; parts <= 10; ++parts) {
      fg__ticks ticks;
      fg__ticks_fill(&ticks, &axis, fg__ticks_step(&axis, range / parts));
      assert_in_range(ticks.count, 1, parts + 1);
      for (int k = 0; k < ticks.count; ++k) {
        double shown = read_number(ticks.text[k]) / axis.factor + axis.offset;
        assert_true(fabs(shown - ticks.position[k]) < 1e-6 * range);
        assert_true(ticks.position[k] >= low && ticks.position[k] <= high);
        assert_true(strlen(ticks.text[k]) <= 12);
        if (k > 0)
          assert_true(fabs(ticks.position[k] - ticks.position[k - 1] - ticks.step) <
                      1e-6 * range);
      }
    }
  }
}

/* Of pressures from 1000 to 10 hPa, 100 long. */
static void logarithms_have_numbers_of_their_decades(void **state)
{
  (void)state;
  static const struct {
    int parts;
    const char *texts;
  } cases[] = {{2, "1000 100 10"},
               {4, "1000 100 10"},
               {7, "1000 500 200 100 50 20 10"},
               {17, "1000 700 500 300 200 150 100 70 50 30 20 15 10"}};
  fg__tick_axis axis;
  fg__axis_of_numbers(&axis, -150.0, -50.0, 100.0, "level", "-0.02 lg(re 1 hPa)");
  assert_string_equal(axis.label, "level (hPa)");
  for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
    fg__ticks ticks;
    char all[FG__TICK_LIMIT * FG__TICK_BYTES] = "";
    fg__ticks_fill(&ticks, &axis, fg__ticks_step(&axis, 100.0 / cases[c].parts));
    for (int k = 0; k < ticks.count; ++k) {
      snprintf(all + strlen(all), FG__TICK_BYTES, "%s%s", k ? " " : "", ticks.text[k]);
      assert_true(fabs(-0.02 * ticks.position[k] - log10(atof(ticks.text[k]))) < 1e-9);
    }
    assert_string_equal(all, cases[c].texts);
  }
}

static void steps_are_nice_and_large_enough(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_numbers(&axis, 0.0, 1.0, 1.0, "x", "");
  for (double least = 3.3e-7; least < 1e6; least *= 1.17) {
    double step = fg__ticks_step(&axis, least);
    assert_true(step >= least * (1.0 - 1e-5) && step <= 2.6 * least);
    double digit = step / pow(10.0, floor(log10(step * 1.0001)));
    assert_true(fabs(digit - 1.0) < 1e-6 || fabs(digit - 2.0) < 1e-6 ||
                fabs(digit - 5.0) < 1e-6);
    double below = fg__ticks_step_below(&axis, step);
    assert_true(below < 0.6 * step && below > 0.3 * step);
    assert_true(fabs(fg__ticks_step(&axis, below) / below - 1.0) < 1e-6);
  }
}

static void steps_of_degrees_divide_the_circle(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_degrees(&axis, 0.0, 360.0, FG__TICKS_LONGITUDE);
  for (double least = 5.5; least < 180.0; least += 0.7) {
    double step = fg__ticks_step(&axis, least);
    assert_true(step >= least);
    assert_true(fmod(360.0, step) == 0.0);
    assert_true(fg__ticks_step_below(&axis, step) < step);
  }
}

static void expect_texts(const fg__tick_axis *axis, double step,
                         const char *const *expected)
{
  fg__ticks ticks;
  fg__ticks_fill(&ticks, axis, step);
  int count = 0;
  while (expected[count])
    ++count;
  assert_int_equal(ticks.count, count);
  for (int k = 0; k < count; ++k)
    assert_string_equal(ticks.text[k], expected[k]);
}

static void longitudes_cross_the_date_line_and_the_circle(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_degrees(&axis, 148.0, 215.0, FG__TICKS_LONGITUDE);
  expect_texts(&axis, 15.0,
               (const char *const[]){"150" DEGREE "E", "165" DEGREE "E", "180" DEGREE,
                                     "165" DEGREE "W", "150" DEGREE "W", NULL});
  fg__axis_of_degrees(&axis, 300.0, 481.0, FG__TICKS_LONGITUDE);
  expect_texts(&axis, 60.0,
               (const char *const[]){"60" DEGREE "W", "0" DEGREE, "60" DEGREE "E",
                                     "120" DEGREE "E", NULL});
  fg__axis_of_degrees(&axis, -180.0, -178.5, FG__TICKS_LONGITUDE);
  expect_texts(&axis, 0.5,
               (const char *const[]){"180.0" DEGREE, "179.5" DEGREE "W",
                                     "179.0" DEGREE "W", "178.5" DEGREE "W", NULL});
}

static void latitudes_have_their_side(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_degrees(&axis, -35.0, 31.0, FG__TICKS_LATITUDE);
  expect_texts(&axis, 30.0,
               (const char *const[]){"30" DEGREE "S", "0" DEGREE, "30" DEGREE "N", NULL});
}

static void lengths_take_the_unit_that_suits(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_numbers(&axis, -2e5, 3e5, 5e5, "x", "meters");
  assert_string_equal(axis.label, "x (km)");
  expect_texts(
      &axis, 1e5,
      (const char *const[]){MINUS "200", MINUS "100", "0", "100", "200", "300", NULL});
  fg__axis_of_numbers(&axis, 0.0, 0.02, 0.02, "y", "m");
  assert_string_equal(axis.label, "y (mm)");
  fg__axis_of_numbers(&axis, 0.0, 63.0, 63.0, "y", "mm");
  assert_string_equal(axis.label, "y (mm)");
  fg__axis_of_numbers(&axis, 0.0, 3.0, 3e5, "y", "m"); /* shares x's unit */
  assert_string_equal(axis.label, "y (km)");
}

static void unhandy_numbers_lose_a_power_or_an_offset(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_numbers(&axis, 0.0, 7e-5, 7e-5, "x", "");
  assert_string_equal(axis.label, "x (\xC3\x97"
                                  "10" FG__TEXT_RAISE MINUS "5" FG__TEXT_LOWER ")");
  fg__axis_of_numbers(&axis, 5e6, 5e6 + 3.0, 3.0, "x", "furlong");
  assert_string_equal(axis.label, "x " MINUS " 5000000 (furlong)");
  fg__axis_of_numbers(&axis, 0.0, 12.0, 12.0, "", "");
  assert_string_equal(axis.label, "");
}

static void lengths_are_written_with_their_unit(void **state)
{
  (void)state;
  char text[FG__AXIS_BYTES];
  fg__tick_axis axis;
  fg__axis_of_degrees(&axis, 350.0, 400.0, FG__TICKS_LONGITUDE);
  fg__axis_write_length(text, &axis, 20.0);
  assert_string_equal(text, "20" DEGREE);
  fg__axis_of_numbers(&axis, 1e6, 1.4e6, 4e5, "x", "m");
  fg__axis_write_length(text, &axis, 5e4);
  assert_string_equal(text, "50 km");
  fg__axis_of_numbers(&axis, 0.0, 1.0, 1.0, "x", "");
  fg__axis_write_length(text, &axis, 0.05);
  assert_string_equal(text, "0.05");
}

static void too_many_ticks_are_none(void **state)
{
  (void)state;
  fg__tick_axis axis;
  fg__axis_of_numbers(&axis, 0.0, 1.0, 1.0, "x", "");
  fg__ticks ticks;
  fg__ticks_fill(&ticks, &axis, 1e-9);
  assert_int_equal(ticks.count, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts_read_back_as_positions),
      cmocka_unit_test(logarithms_have_numbers_of_their_decades),
      cmocka_unit_test(steps_are_nice_and_large_enough),
      cmocka_unit_test(steps_of_degrees_divide_the_circle),
      cmocka_unit_test(longitudes_cross_the_date_line_and_the_circle),
      cmocka_unit_test(latitudes_have_their_side),
      cmocka_unit_test(lengths_take_the_unit_that_suits),
      cmocka_unit_test(unhandy_numbers_lose_a_power_or_an_offset),
      cmocka_unit_test(lengths_are_written_with_their_unit),
      cmocka_unit_test(too_many_ticks_are_none),
  };
  return cmocka_run_group_tests_name("picture/ticks", tests, NULL, NULL);
}
