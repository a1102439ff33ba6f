#include "terms/calendar.h"

#include "terms/text.h"

#include <string.h>

/* The first Gregorian day of the standard calendar, which is 5 October in the Julian
 * one. */
static const fg__date REFORM = {1582, 10, 15};
static const fg__date REFORM_JULIAN = {1582, 10, 5};

bool fg__calendar_find(fg__calendar *out, const char *name)
{
  static const char *const names[] = {
      [FG__CALENDAR_STANDARD] = "|standard|gregorian",
      [FG__CALENDAR_GREGORIAN] = "proleptic_gregorian|gregorian_proleptic", /* ROMS */
      [FG__CALENDAR_JULIAN] = "julian",
      [FG__CALENDAR_NOLEAP] = "noleap|no_leap|365_day|365",
      [FG__CALENDAR_ALL_LEAP] = "all_leap|366_day|366",
      [FG__CALENDAR_360_DAYS] = "360_day|360", /* the second of the IRI Data Library */
  };
  for (int k = 0; k < (int)(sizeof names / sizeof *names); ++k)
    if (fg__is_one_of(names[k], name, strlen(name))) {
      *out = (fg__calendar)k;
      return true;
    }
  return false;
}

static bool is_leap(fg__calendar calendar, int64_t year)
{
  if (calendar == FG__CALENDAR_GREGORIAN)
    return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return calendar == FG__CALENDAR_ALL_LEAP ||
         (calendar == FG__CALENDAR_JULIAN && year % 4 == 0);
}

static int month_length(fg__calendar calendar, int64_t year, int month)
{
  static const int length[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (calendar == FG__CALENDAR_360_DAYS)
    return 30;
  return length[month - 1] + (month == 2 && is_leap(calendar, year));
}

static int64_t floor_divide(int64_t a, int64_t b)
{
  return a / b - (a % b < 0);
}

/* Days from 1 January of year 0 to that of `year`. */
static int64_t days_before(fg__calendar calendar, int64_t year)
{
  const int64_t last = year - 1; /* leap years in 0 ... last, with year 0 */
  switch (calendar) {
  case FG__CALENDAR_360_DAYS:
    return 360 * year;
  case FG__CALENDAR_NOLEAP:
    return 365 * year;
  case FG__CALENDAR_ALL_LEAP:
    return 366 * year;
  case FG__CALENDAR_JULIAN:
    return 365 * year + floor_divide(last, 4) + 1;
  default:
    return 365 * year + floor_divide(last, 4) - floor_divide(last, 100) +
           floor_divide(last, 400) + 1;
  }
}

int64_t fg__calendar_day(fg__calendar calendar, fg__date date)
{
  if (calendar == FG__CALENDAR_STANDARD) {
    const int64_t day = fg__calendar_day(FG__CALENDAR_GREGORIAN, date) -
                        fg__calendar_day(FG__CALENDAR_GREGORIAN, REFORM);
    return day >= 0 ? day
                    : fg__calendar_day(FG__CALENDAR_JULIAN, date) -
                          fg__calendar_day(FG__CALENDAR_JULIAN, REFORM_JULIAN);
  }
  int64_t days = days_before(calendar, date.year) + date.day - 1;
  for (int month = 1; month < date.month; ++month)
    days += month_length(calendar, date.year, month);
  return days;
}

fg__date fg__calendar_date(fg__calendar calendar, int64_t day)
{
  if (calendar == FG__CALENDAR_STANDARD)
    return day >= 0
               ? fg__calendar_date(FG__CALENDAR_GREGORIAN,
                                   day + fg__calendar_day(FG__CALENDAR_GREGORIAN, REFORM))
               : fg__calendar_date(
                     FG__CALENDAR_JULIAN,
                     day + fg__calendar_day(FG__CALENDAR_JULIAN, REFORM_JULIAN));
  /* at or before the day: a year has 360 to 366 days */
  fg__date date = {.year = floor_divide(day, day < 0 ? 360 : 366) - 1, .month = 1};
  while (days_before(calendar, date.year + 1) <= day)
    ++date.year;
  day -= days_before(calendar, date.year);
  while (day >= month_length(calendar, date.year, date.month))
    day -= month_length(calendar, date.year, date.month++);
  date.day = (int)day + 1;
  return date;
}

bool fg__calendar_has(fg__calendar calendar, fg__date date)
{
  const fg__date same = fg__calendar_date(calendar, fg__calendar_day(calendar, date));
  return same.year == date.year && same.month == date.month && same.day == date.day;
}
