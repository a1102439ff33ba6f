#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/context_test.h"
#include "read/format.h"

static const fg_axis_value monthly[] = {
    {0.0, "days since 1982-01-16 12:00", "1982-01-16 12:00"},
    {30.0, "days since 1982-01-16 12:00", "1982-02-15 12:00"},
    {59.5, "days since 1982-01-16 12:00", "1982-03-17"},
    {90.0, "days since 1982-01-16 12:00", "1982-04-16 12:00"},
    {90.25, "days since 1982-01-16 12:00", "1982-04-16 18:00"},
    {150.0, "days since 1982-01-16 12:00", "1982-06-15 12:00"},
};
enum { MONTHLY = sizeof monthly / sizeof *monthly };

/* Pressures descend, and one is rounded to 24 bits. */
static const fg_axis_value pressures[] = {{1000.0, "hPa", "1000 hPa"},
                                          {850.0, "hPa", "850 hPa"},
                                          {500.00001, "hPa", "500 hPa"},
                                          {300.0, "hPa", "300 hPa"},
                                          {10.0, "m", "10 m above ground"}};
enum { PRESSURES = sizeof pressures / sizeof *pressures };

typedef struct expectation {
  const char *text;
  const char *indices; /* as "0 3"; "near" before the nearest, "+" before several */
} expectation;

static void expect(const expectation *expected, size_t cases, const char *what,
                   const fg_axis_value *values, int count)
{
  for (size_t k = 0; k < cases; ++k) {
    fg_selection found;
    char words[256];
    fg_context *context = NULL;
    assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
    if (fg_selection_find(&found, context, what, expected[k].text, values, count))
      fail_msg("%s: %s", expected[k].text, fg_context_message(context));
    snprintf(words, sizeof words, "%s%s", found.several ? "+" : "",
             found.nearest ? "near" : "");
    for (int n = 0; n < found.count; ++n) {
      const size_t used = strlen(words);
      snprintf(words + used, sizeof words - used, "%s%d", used ? " " : "",
               found.index[n]);
    }
    if (strcmp(words, expected[k].indices) != 0)
      fail_msg("%s gives '%s', not '%s'", expected[k].text, words, expected[k].indices);
    fg_selection_clear(&found);
    fg_context_destroy(context);
  }
}

static void dates_indices_and_values_of_times(void **state)
{
  static const expectation expected[] = {
      {"5", "5"},
      {"1982-02", "1"},
      {"1982-04-16", "3"},
      {"1982-04-16T18", "4"},
      {"1982-04-16 18:00Z", "4"},
      {"1982-05-10", "near 4"}, /* 24 days after, and 36 before the next */
      {"1982-05-31", "near 5"},
      {"1981-12-20", "near 0"}, /* within a spacing of the first */
      {"59.5", "2"},
      {"all", "+ 0 1 2 3 4 5"},
      {"1:3", "+ 1 2 3"},
      {"4:", "+ 4 5"},
      {"2,0,2", "+ 0 2"},
      {"1982-02:1982-04", "+ 1 2 3 4"},
      {"1982-02-15T12:00:1982-04-16T17:59", "+ 1 2 3"},
      {"1982-03-17/1982-03-17", "+ 2"},
      {":1982-02-15", "+ 0 1"},
      {"1982-01-16T12:00,1982-06", "+ 0 5"},
      {"1982-01-16_12:00:00,1982-06", "+ 0 5"},
  };
  (void)state;
  expect(expected, sizeof expected / sizeof *expected, "time", monthly, MONTHLY);
}

/* Units of time as words, in either number (CROCO: "second"). */
static void times_with_units_in_words(void **state)
{
  static const fg_axis_value elapsed[] = {
      {0.0, "second", "0 s"}, {259200.0, "second", "3 d"}, {518400.0, "second", "6 d"}};
  static const expectation expected[] = {
      {"3d", "1"}, {"6 days", "2"}, {"72 hour", "1"}, {"4d", "near 1"}};
  (void)state;
  expect(expected, sizeof expected / sizeof *expected, "time", elapsed, 3);
}

/* Dates of texts have no numbers (WRF). */
static void dates_without_numbers(void **state)
{
  static const fg_axis_value texts[] = {{(double)NAN, "", "2010-07-15 12:00"},
                                        {(double)NAN, "", "2010-07-16"},
                                        {(double)NAN, "", "2010-07-16 00:00:30"}};
  static const expectation expected[] = {{"2010-07-16", "1"}};
  (void)state;
  expect(expected, 1, "time", texts, 3);
}

static void years(void **state)
{
  static const fg_axis_value yearly[] = {{0.0, "days since 1982-01-16", "1982-01-16"},
                                         {28.0, "days since 1982-01-16", "1982-02-13"},
                                         {365.0, "days since 1982-01-16", "1983-01-16"},
                                         {1096.0, "days since 1982-01-16", "1985-01-16"}};
  static const expectation expected[] = {{"1982", "0"},
                                         {"1983", "2"},
                                         {"1984", "near 2"},
                                         {"3", "3"},
                                         {"1982:1983", "+ 0 1 2"},
                                         {"1983:", "+ 2 3"},
                                         {"1985,0", "+ 0 3"},
                                         {"1982:1983-01", "+ 0 1 2"},
                                         {"1982-02:1983", "+ 1 2"}};
  (void)state;
  /* day 1978 of the axis is one of its values, and another year's */
  static const fg_axis_value days[] = {{0.0, "days since 1975-01-01", "1975-01-01"},
                                       {1096.0, "days since 1975-01-01", "1978-01-01"},
                                       {1978.0, "days since 1975-01-01", "1980-06-01"}};
  static const expectation of_days[] = {
      {"1978", "1"}, {"1975:1978", "+ 0 1"}, {"1978.", "2"}, {"1", "1"}};
  expect(of_days, sizeof of_days / sizeof *of_days, "time", days, 3);
  expect(expected, sizeof expected / sizeof *expected, "time", yearly, 4);
}

static void values_of_levels_with_units(void **state)
{
  static const expectation expected[] = {
      {"850hPa", "1"},
      {"85000 Pa", "1"},
      {"850.", "1"},
      {"500hPa", "2"},
      {"0.5bar", "2"},
      {"700hPa", "near 1"},
      {"650hpa", "near 2"},
      {"1000cm", "4"},
      {"10_M_above_ground", "4"},
      {"above_ground", "4"},
      {"300hPa:850hPa", "+ 1 2 3"},
      {"850hPa:300hPa", "+ 1 2 3"},
      {"600hPa:", "+ 0 1"},
      {":600hPa", "+ 2 3"},
      {"3,1000hPa", "+ 0 3"},
      {"1050hPa", "near 0"},
      {"850", "1"}, /* beyond the last index */
      {"4", "4"},
      {"850 millibars", "1"},
  };
  (void)state;
  expect(expected, sizeof expected / sizeof *expected, "level", pressures, PRESSURES);
  static const expectation bare[] = {{"2", "2"}, {"0:1", "+ 0 1"}, {"all", "+ 0 1 2"}};
  expect(bare, 3, "level", NULL, 3);
}

static void refuse(const char *text, const fg_axis_value *values, int count,
                   fg_status status, const char *words)
{
  fg_selection found;
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_selection_find(&found, context, "time", text, values, count),
                   status);
  assert_null(found.index);
  if (!strstr(fg_context_message(context), words))
    fail_msg("%s: \"%s\" lacks \"%s\"", text, fg_context_message(context), words);
  fg_context_destroy(context);
}

static void what_is_not_there_is_refused_with_what_is(void **state)
{
  (void)state;
  refuse("1990-01-01", monthly, MONTHLY, FG_STATUS_UNSUPPORTED,
         "0 is 1982-01-16 12:00, 5 is 1982-06-15 12:00");
  refuse("1990", monthly, MONTHLY, FG_STATUS_UNSUPPORTED,
         "no time 1990: 0 is 1982-01-16");
  refuse("1983:1982", monthly, MONTHLY, FG_STATUS_ARGUMENT, "ends before it begins");
  refuse("6", monthly, MONTHLY, FG_STATUS_UNSUPPORTED, "there are 6");
  refuse("2:6", monthly, MONTHLY, FG_STATUS_UNSUPPORTED, "there are 6");
  refuse("1982-05", monthly + 3, 1, FG_STATUS_UNSUPPORTED, "the only one is 1982-04-16");
  refuse("1982-05:1982-05", monthly, MONTHLY, FG_STATUS_UNSUPPORTED, "0 is 1982");
  refuse("1982-05-01", pressures, PRESSURES, FG_STATUS_UNSUPPORTED,
         "none of them is a date");
  refuse("20s", pressures, PRESSURES, FG_STATUS_UNSUPPORTED, "in such a unit");
  refuse("1.5", NULL, 3, FG_STATUS_UNSUPPORTED, "the indices 0 to 2");
  refuse("hPa", pressures, PRESSURES, FG_STATUS_UNSUPPORTED, "no time hPa");
  refuse("surface", pressures, PRESSURES, FG_STATUS_UNSUPPORTED, "no time surface");
}

/* count 0: as the program checks its options before it reads. */
static void misspelt_wishes_are_known_before_reading(void **state)
{
  static const char *const wrong[] = {"",           "-1",
                                      "1,",         ",1",
                                      "1:1982-01",  ":",
                                      "1982-13-01", "1982-01-16T25:00",
                                      "5:3",        "1982-06:1982-01",
                                      "+2",         "0123456789"};
  (void)state;
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k)
    refuse(wrong[k], NULL, 0, FG_STATUS_ARGUMENT, "'");
  static const expectation good[] = {{"99", ""}, {"300hPa", ""}, {"1982-07-16", ""}};
  expect(good, 3, "time", NULL, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(dates_indices_and_values_of_times),
      cmocka_unit_test(values_of_levels_with_units),
      cmocka_unit_test(times_with_units_in_words),
      cmocka_unit_test(dates_without_numbers),
      cmocka_unit_test(years),
      cmocka_unit_test(what_is_not_there_is_refused_with_what_is),
      cmocka_unit_test(misspelt_wishes_are_known_before_reading),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
