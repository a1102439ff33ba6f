#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/angle.h"
#include "base/context_test.h"
#include "terms/dates.h"
#include "terms/units.h"

static void units_are_classified_and_written_shortly(void **state)
{
  (void)state;
  static const struct {
    const char *units;
    fg__quantity quantity;
    const char *label;
  } cases[] = {
      {"m/s", FG__QUANTITY_SPEED, "m/s"},
      {"m s-1", FG__QUANTITY_SPEED, "m/s"},
      {"m s**-1", FG__QUANTITY_SPEED, "m/s"},
      {"m.s^-1", FG__QUANTITY_SPEED, "m/s"},
      {"M/S", FG__QUANTITY_SPEED, "m/s"},
      {"meter second-1", FG__QUANTITY_SPEED, "m/s"},
      {"meters per second", FG__QUANTITY_SPEED, "m/s"},
      {"centimeter/s", FG__QUANTITY_SPEED, "cm/s"},
      {"km h-1", FG__QUANTITY_SPEED, "km/h"},
      {"m day-1", FG__QUANTITY_SPEED, "m/d"},
      {"m·s-1", FG__QUANTITY_SPEED, "m/s"},
      {"m s⁻¹", FG__QUANTITY_SPEED, "m/s"},
      {"m s^{-1}", FG__QUANTITY_SPEED, "m/s"},
      {"s-1 m", FG__QUANTITY_SPEED, "m/s"},
      {"dm/s", FG__QUANTITY_SPEED, "dm/s"},
      {"nautical_miles/hour", FG__QUANTITY_SPEED, "nmi/h"},
      {"knots", FG__QUANTITY_SPEED, "kn"},
      {"kts", FG__QUANTITY_SPEED, "kn"},
      {"°/s", FG__QUANTITY_ANGULAR_SPEED, "°/s"},
      {"degrees/day", FG__QUANTITY_ANGULAR_SPEED, "°/d"},
      {"rad s-1", FG__QUANTITY_ANGULAR_SPEED, "rad/s"},
      {"m", FG__QUANTITY_LENGTH, "m"},
      {"kilometers", FG__QUANTITY_LENGTH, "km"},
      {"degrees", FG__QUANTITY_DEGREES, "°"},
      {"micron", FG__QUANTITY_LENGTH, "µm"},
      {"μm", FG__QUANTITY_LENGTH, "µm"},
      {"DEGREES EAST", FG__QUANTITY_DEGREES_EAST, "°E"},
      {"degrees_east", FG__QUANTITY_DEGREES_EAST, "°E"},
      {"degrees-north", FG__QUANTITY_DEGREES_NORTH, "°N"},
      {"degree_N", FG__QUANTITY_DEGREES_NORTH, "°N"},
      {"millibar", FG__QUANTITY_PRESSURE, "hPa"},
      {"PA", FG__QUANTITY_PRESSURE, "Pa"},
      {"hectopascals", FG__QUANTITY_PRESSURE, "hPa"},
      {"decibar", FG__QUANTITY_PRESSURE, "dbar"},
      {"hours since 1900-01-01", FG__QUANTITY_DATE, "hours since 1900-01-01"},
      {"day as %Y%m%d.%f", FG__QUANTITY_DATE, "day as %Y%m%d.%f"},
      {"", FG__QUANTITY_UNKNOWN, ""},
      {"1", FG__QUANTITY_UNKNOWN, "1"},
      {"degrees_west", FG__QUANTITY_DEGREES_EAST, "°W"},
      {"degree_S", FG__QUANTITY_DEGREES_NORTH, "°S"},
      {"days", FG__QUANTITY_TIME, "days"},
      {"radians", FG__QUANTITY_RADIANS, "radians"},
      {"s-1", FG__QUANTITY_UNKNOWN, "s-1"},
      {"s/m", FG__QUANTITY_UNKNOWN, "s/m"},
      {"m2 s-2", FG__QUANTITY_UNKNOWN, "m2 s-2"},
      {"N m-2", FG__QUANTITY_UNKNOWN, "N m-2"},
      {"m s-2", FG__QUANTITY_UNKNOWN, "m s-2"},
      {"m s", FG__QUANTITY_UNKNOWN, "m s"},
      {"m/", FG__QUANTITY_UNKNOWN, "m/"},
      {"m s-99999999999999999999", FG__QUANTITY_UNKNOWN, "m s-99999999999999999999"},
      {"m per per", FG__QUANTITY_UNKNOWN, "m per per"},
      {"m s-", FG__QUANTITY_UNKNOWN, "m s-"},
      {"m s-1 s-1", FG__QUANTITY_UNKNOWN, "m s-1 s-1"},
      {"m/s/s", FG__QUANTITY_UNKNOWN, "m/s/s"},
      {"\xff\xfe", FG__QUANTITY_UNKNOWN, "\xff\xfe"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char label[FG__UNIT_BYTES];
    const fg__quantity quantity = fg__units_read(cases[i].units, label, sizeof label);
    if (quantity != cases[i].quantity || strcmp(label, cases[i].label) != 0)
      fail_msg("\"%s\" became %d \"%s\"", cases[i].units, (int)quantity, label);
  }
}

/* A unit's size in another, however it is written; 0: they measure different
 * things.
 */
static void units_have_factors(void **state)
{
  static const struct {
    const char *from, *to;
    double factor;
  } cases[] = {
      {"hPa", "bar", 1e-3},
      {"hours", "d", 1.0 / 24.0},
      {"", "m", 1.0},
      {"weird", "WEIRD", 1.0},
      {"weird", "m", 0.0},
      {"m", "hPa", 0.0},
      {"m s-1", "meters per second", 1.0},
      {"m/s", "cm/s", 100.0},
      {"knots", "m/s", 1852.0 / 3600.0},
      {"mph", "mi/h", 1.0},
      {"kph", "km/h", 1.0},
      {"km/h", "m s**-1", 1.0 / 3.6},
      {"degrees_east", "degrees_west", -1.0},
      {"rad", "degrees", 1.0 / FG__RADIANS},
      {"rad", "degrees_east", 0.0},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const double factor = fg__unit_factor(cases[n].from, cases[n].to);
    if (!(fabs(factor - cases[n].factor) <= 1e-12 * fabs(factor)))
      fail_msg("%s in %s is %g", cases[n].from, cases[n].to, factor);
  }
}

static void assert_date(double value, const char *units, const char *calendar,
                        const char *wanted)
{
  char out[FG__UNIT_BYTES] = "";
  const bool known = fg__date_of_number(value, units, calendar, out, sizeof out);
  if (known != (wanted != NULL) || (wanted && strcmp(out, wanted) != 0))
    fail_msg("%g %s (%s) became \"%s\"", value, units, calendar, out);
}

/* Dates from the calendars' definitions and from almanacs. */
static void dates_follow_the_calendar(void **state)
{
  (void)state;
  assert_date(0.0, "days since 1970-01-01", "", "1970-01-01");
  assert_date(16861.0, "days since 1970-01-01", "standard", "2016-03-01");
  assert_date(1452729600.0, "seconds since 1970-01-01 00:00:00 +00:00", "", "2016-01-14");
  assert_date(-1.0, "hours since 2000-03-01", "gregorian", "2000-02-29 23:00");
  assert_date(90.0, "minutes since 1999-12-31T23:00:00Z", "", "2000-01-01 00:30");
  assert_date(1.0, "days since 1900-02-28", "", "1900-03-01");
  /* the conventions' own example: 6 hours behind UTC */
  assert_date(0.0, "seconds since 1992-10-8 15:15:42.5 -6:00", "", "1992-10-08 21:15:43");
  assert_date(0.0, "hours since 2001-03-01 03:00 +05:30", "", "2001-02-28 21:30");
  assert_date(0.0, "hours since 2001-03-01 03:00 +0530", "noleap", "2001-02-28 21:30");
  assert_date(0.0, "hours since 2001-03-01 23 -2", "360_day", "2001-03-02 01:00");
  assert_date(0.0, "hours since 2001-03-01 12:00 UTC", "", "2001-03-01 12:00");
  assert_date(20200115.25, "day as %Y%m%d.%f", "proleptic_gregorian", "2020-01-15 06:00");
  assert_date(20200229.0, "day as %Y%m%d.%f", "", "2020-02-29");
  assert_date(20200229.0, "YYYYMMDD", "", "2020-02-29");
  assert_date(202002.5, "month as %Y%m.%f", "", "2020-02-01");
  assert_date(202002.0, "yyyymm", "", "2020-02-01");
  assert_date(202013.0, "YYYYMM", "", NULL);
  assert_date(1e15, "microseconds since 1970-01-01", "", "2001-09-09 01:46:40");
  assert_date(1e18, "nanoseconds since 1970-01-01", "", "2001-09-09 01:46:40");
  assert_date(3.0, "milliseconds since 2001-03-01T12:00:59.9995Z", "",
              "2001-03-01 12:01");
  assert_date(1.0, "days since 1900-02-28", "julian", "1900-02-29");
  /* the day after 4 October 1582 was 15 October */
  assert_date(1.0, "days since 1582-10-04", "standard", "1582-10-15");
  assert_date(-1.0, "days since 1582-10-15", "gregorian", "1582-10-04");
  assert_date(-1.0, "days since 1582-10-15", "proleptic_gregorian", "1582-10-14");
  /* of years before 1 one calendar alone says which they are */
  assert_date(2451544.5, "days since -4712-01-01 12:00", "julian", NULL);
  assert_date(2451544.5, "days since -4713-11-24 12:00", "proleptic_gregorian",
              "2000-01-01");
  assert_date(-719528.0 - 146097.0 * 20.0, "days since 1970-01-01", "proleptic_gregorian",
              "-8000-01-01");
  assert_date(60.0, "days since 2004-01-01", "noleap", "2004-03-02");
  assert_date(59.0, "days since 2003-01-01", "366_day", "2003-02-29");
  assert_date(59.0, "days since 2003-01-01", "360_day", "2003-02-30");
  assert_date(360.0 * 5.0 - 1.0, "days since 2000-01-01", "360_day", "2004-12-30");
  assert_date(360.0 * 5.0 - 1.0, "days since -900-01-01", "360_day", "-896-12-30");
  assert_date(366.0, "hour since 0000-01-01 00:00:00", "", "16 January (climatology)");
  assert_date(-719528.0, "days since 1970-01-01", "proleptic_gregorian", "0000-01-01");
  /* months and years are those of the calendar */
  assert_date(1.0, "months since 1980-01-01", "", "1980-02-01");
  assert_date(1.5, "months since 1980-01-01", "", "1980-02-15 12:00");
  assert_date(-1.0, "month since 1980-01-16 12:00", "noleap", "1979-12-16 12:00");
  assert_date(0.5, "months since 1980-02-01", "360_day", "1980-02-16");
  assert_date(722.5, "months since 1960-01-01", "360", "2020-03-16");
  assert_date(1.0, "days since 1900-02-28", "JULIAN", "1900-02-29");
  assert_date(17067072.0, "hours since 1-1-1 00:00:0.0", "", "1948-01-01");
  assert_date(1.0, "months since 2001-01-31", "", "2001-02-28"); /* a month's end */
  assert_date(1.0, "months since 2001-01-31", "all_leap", "2001-02-29");
  assert_date(1.0, "years since 2000-02-29", "julian", "2001-02-28");
  assert_date(25.0, "years since 1975-03-01", "", "2000-03-01");
  assert_date(0.5, "years since 1981-01-01", "", "1981-07-01");
  assert_date(2.0, "months since 0000-01-15", "", "15 March (climatology)");
  assert_date(1e9, "months since 1980-01-01", "", NULL);
  assert_date(1.0, "fortnights since 1980-01-01", "", NULL);
}

/* Day by day against the C library, over two centuries and back. */
static void dates_agree_with_the_c_library(void **state)
{
  (void)state;
  for (int day = -36000; day < 47000; day += 17) {
    const time_t seconds = (time_t)day * 86400 + 3 * 3600 + 25 * 60;
    struct tm broken;
    char wanted[64];
    char out[64];
    assert_non_null(gmtime_r(&seconds, &broken));
    assert_true(strftime(wanted, sizeof wanted, "%Y-%m-%d %H:%M", &broken) > 0);
    assert_true(fg__date_of_number(day + 205.0 / 1440.0, "days since 1970-01-01", "", out,
                                   sizeof out));
    assert_string_equal(out, wanted);
  }
}

static void what_is_no_date_is_left_alone(void **state)
{
  (void)state;
  assert_date(1.0, "days since yesterday", "", NULL);
  /* dates that the calendar does not have, and zones that are not known */
  assert_date(20200230.0, "day as %Y%m%d.%f", "", NULL);
  assert_date(20200230.5, "day as %Y%m%d", "360_day", "2020-02-30 12:00");
  assert_date(20200229.0, "day as %Y%m%d.%f", "no_leap", NULL);
  assert_date(20200115.0, "day as %Y%m%d.%f", "of my own", NULL);
  assert_date(1.0, "days since 2001-02-29", "", NULL);
  assert_date(1.0, "days since 2001-02-29", "366_day", "2001-03-01");
  assert_date(1.0, "days since 1582-10-10", "standard", NULL);
  assert_date(1.0, "days since 1582-10-10", "proleptic_gregorian", "1582-10-11");
  assert_date(60.0, "days since 2004-01-01", "no_leap", "2004-03-02");
  assert_date(730000.0, "days since 0000-01-01", "", NULL);
  assert_date(730000.0, "days since 0000-01-01", "noleap", "2000-01-01");
  assert_date(0.0, "hours since 2001-03-01 12:00 EST", "", NULL);
  assert_date(0.0, "hours since 2001-03-01 12:00 GMT+2", "", NULL);
  assert_date(0.0, "hours since 2001-03-01 12:00 GMT", "", "2001-03-01 12:00");
  assert_date(1.0, "fortnights since 1970-01-01", "", NULL);
  assert_date(1.0, "days since 1970-13-01", "", NULL);
  assert_date(1.0, "days since 1970-01-01", "mayan", NULL);
  assert_date(1e30, "days since 1970-01-01", "", NULL);
  assert_date((double)NAN, "days since 1970-01-01", "", NULL);
  assert_date(1.0, "days", "", NULL);
  assert_date(1.0, "days since 1970-01-01 99999999999:00", "", NULL);
  assert_date(1.0, "days since 1970-01-01 00:00:1e999", "", NULL);
  assert_date(1.0, "days since 1970-01-01 00:00:nan", "", NULL);
  assert_date(1.0, "days since 1970-01-01 00:00 -9999999999999999999999", "", NULL);
  assert_date(1.0, "days since 999999999-01-01", "", NULL);
  assert_date(1.0, "days since 1970-01-01#", "", NULL);
  assert_date(1.0, "meters since 1970-01-01", "", NULL);
  assert_date((double)INFINITY, "days since 1970-01-01", "noleap", NULL);
  assert_date(-1e300, "milliseconds since 1970-01-01", "360_day", NULL);
}

/* Texts of files, and seconds from 1970 on; NULL: no date. */
static void texts_are_dates(void **state)
{
  static const char *const texts[][2] = {
      {"2010-07-15_12:00:00", "2010-07-15 12:00"},
      {"2010-07-16T00:00:00.000000", "2010-07-16"},
      {"2010-07-16 00:00:30.5Z", "2010-07-16 00:00:30"},
      {"2001-01-16T12:00", "2001-01-16 12:00"},
      {"2001-01-16", "2001-01-16"},
      {"-0044-03-15  ", "-044-03-15"},
      {"2001-01", NULL},
      {"2010-13-15_12:00:00", NULL},
      {"2010-07-32_12:00:00", NULL},
      {"2010-07-15_24:00:00", NULL},
      {"2010-07-15 12:00:00 noon", NULL},
      {"yesterday", NULL},
      {"", NULL},
  };
  static const struct {
    double seconds;
    const char *wanted;
  } numbers[] = {{0.0, "1970-01-01"},
                 {-60.0, "1969-12-31 23:59"},
                 {951782400.5, "2000-02-29 00:00:00.500"},
                 {951782460.25, "2000-02-29 00:01:00.250"},
                 {-1.0, "1969-12-31 23:59:59"},
                 {1e15, NULL},
                 {(double)NAN, NULL}};
  char out[FG__UNIT_BYTES];
  (void)state;
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n) {
    const bool known = fg__date_of_text(texts[n][0], out, sizeof out);
    if (known != (texts[n][1] != NULL) || (known && strcmp(out, texts[n][1]) != 0))
      fail_msg("%s became \"%s\"", texts[n][0], out);
  }
  for (size_t n = 0; n < sizeof numbers / sizeof *numbers; ++n) {
    const bool known = fg__date_of_seconds(numbers[n].seconds, out, sizeof out);
    if (known != (numbers[n].wanted != NULL) ||
        (known && strcmp(out, numbers[n].wanted) != 0))
      fail_msg("%g became \"%s\"", numbers[n].seconds, out);
  }
}

static void durations_have_parts(void **state)
{
  (void)state;
  static const struct {
    double value;
    const char *units, *wanted;
  } times[] = {{259200.0, "second", "3 d"},
               {95400.0, "s", "1 d 2 h 30 min"},
               {0.0, "hours", "0 h"},
               {0.0, "ms", "0 s"},
               {-1.5, "days", "-1 d 12 h"},
               {1e9, "seconds", "11574 d 1 h 46 min 40 s"},
               {0.5, "s", NULL},
               {3.0, "m", NULL},
               {1e300, "s", NULL},
               {(double)NAN, "s", NULL}};
  for (size_t n = 0; n < sizeof times / sizeof *times; ++n) {
    char out[FG__UNIT_BYTES] = "";
    const bool known = fg__duration(times[n].value, times[n].units, out, sizeof out);
    if (known != (times[n].wanted != NULL) ||
        (known && strcmp(out, times[n].wanted) != 0))
      fail_msg("%g %s became \"%s\"", times[n].value, times[n].units, out);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(units_are_classified_and_written_shortly),
      cmocka_unit_test(units_have_factors),
      cmocka_unit_test(dates_follow_the_calendar),
      cmocka_unit_test(texts_are_dates),
      cmocka_unit_test(dates_agree_with_the_c_library),
      cmocka_unit_test(what_is_no_date_is_left_alone),
      cmocka_unit_test(durations_have_parts),
  };
  return cmocka_run_group_tests_name("terms/units", tests, NULL, NULL);
}
