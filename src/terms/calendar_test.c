/* Days and dates of each calendar. */
#include "base/context_test.h"
#include "terms/calendar.h"

enum { CALENDARS = FG__CALENDAR_360_DAYS + 1 };

/* Days between dates, from cftime 1.6.2 with a year 0. */
static void days_between_dates(void **state)
{
  (void)state;
  static const struct {
    fg__date from, to;
    int64_t days[CALENDARS]; /* standard, Gregorian, Julian, noleap, all_leap, 360_day */
  } cases[] = {
      {{1000, 3, 1}, {2017, 2, 5}, {371422, 371428, 371435, 371181, 372197, 366094}},
      {{1582, 10, 4}, {1582, 10, 16}, {2, 12, 12, 12, 12, 12}},
      {{-44, 3, 15}, {1900, 3, 1}, {710019, 710017, 710032, 709546, 711490, 699826}},
      {{1850, 1, 1}, {2100, 12, 30}, {91674, 91674, 91676, 91613, 91864, 90359}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    for (int c = 0; c < CALENDARS; ++c)
      assert_int_equal(fg__calendar_day((fg__calendar)c, cases[i].to) -
                           fg__calendar_day((fg__calendar)c, cases[i].from),
                       cases[i].days[c]);
}

static bool is_next(fg__calendar calendar, fg__date a, fg__date b)
{
  if (calendar == FG__CALENDAR_STANDARD && a.year == 1582 && a.month == 10 && a.day == 4)
    return b.year == 1582 && b.month == 10 && b.day == 15;
  if (b.day != 1)
    return a.year == b.year && a.month == b.month && b.day == a.day + 1;
  return a.day >= 28 && a.day <= 31 &&
         (b.month == 1 ? a.month == 12 && b.year == a.year + 1
                       : b.month == a.month + 1 && b.year == a.year);
}

/* Over years before and after 0, centuries and the reform. */
static void dates_follow_one_another(void **state)
{
  (void)state;
  for (int c = 0; c < CALENDARS; ++c) {
    const fg__calendar calendar = (fg__calendar)c;
    const int64_t first = fg__calendar_day(calendar, (fg__date){-450, 2, 17});
    const int64_t last = fg__calendar_day(calendar, (fg__date){2450, 2, 17});
    fg__date before = fg__calendar_date(calendar, first - 1);
    for (int64_t day = first; day <= last; ++day) {
      const fg__date date = fg__calendar_date(calendar, day);
      if (!is_next(calendar, before, date) || fg__calendar_day(calendar, date) != day)
        fail_msg("calendar %d: %d-%d-%d after %d-%d-%d", c, (int)date.year, date.month,
                 date.day, (int)before.year, before.month, before.day);
      before = date;
    }
  }
}

/* CF conventions, section 4.4.2. */
static void lengths_of_years(void **state)
{
  (void)state;
  static const struct {
    int64_t year;
    int days[CALENDARS];
  } cases[] = {
      {1582, {355, 365, 365, 365, 366, 360}}, {1600, {366, 366, 366, 365, 366, 360}},
      {1900, {365, 365, 366, 365, 366, 360}}, {1500, {366, 365, 366, 365, 366, 360}},
      {2004, {366, 366, 366, 365, 366, 360}}, {2005, {365, 365, 365, 365, 366, 360}},
      {-4, {366, 366, 366, 365, 366, 360}},   {-100, {366, 365, 366, 365, 366, 360}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    for (int c = 0; c < CALENDARS; ++c)
      assert_int_equal(
          fg__calendar_day((fg__calendar)c, (fg__date){cases[i].year + 1, 1, 1}) -
              fg__calendar_day((fg__calendar)c, (fg__date){cases[i].year, 1, 1}),
          cases[i].days[c]);
}

static void names(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    fg__calendar calendar;
  } cases[] = {
      {"", FG__CALENDAR_STANDARD},
      {"Gregorian", FG__CALENDAR_STANDARD},
      {"standard", FG__CALENDAR_STANDARD},
      {"proleptic_gregorian", FG__CALENDAR_GREGORIAN},
      {"gregorian_proleptic", FG__CALENDAR_GREGORIAN},
      {"no_leap", FG__CALENDAR_NOLEAP},
      {"julian", FG__CALENDAR_JULIAN},
      {"365_day", FG__CALENDAR_NOLEAP},
      {"NOLEAP", FG__CALENDAR_NOLEAP},
      {"366_day", FG__CALENDAR_ALL_LEAP},
      {"all_leap", FG__CALENDAR_ALL_LEAP},
      {"360_day", FG__CALENDAR_360_DAYS},
  };
  fg__calendar found;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    assert_true(fg__calendar_find(&found, cases[i].name));
    assert_int_equal(found, cases[i].calendar);
  }
  assert_false(fg__calendar_find(&found, "none"));
  assert_false(fg__calendar_find(&found, "360_days"));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(days_between_dates),
      cmocka_unit_test(dates_follow_one_another),
      cmocka_unit_test(lengths_of_years),
      cmocka_unit_test(names),
  };
  return cmocka_run_group_tests_name("interpret/time/calendar", tests, NULL, NULL);
}
