/* Times as dates: "hours since 1900-01-01 00:00" in the calendars of the CF conventions
 * (section 4.4.1). */
#include "file/number_text.h"
#include "read/netcdf/netcdf.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef enum calendar_kind {
  GREGORIAN,
  MIXED,
  JULIAN,
  NOLEAP,
  ALLLEAP,
  DAYS360
} calendar_kind;

typedef struct date {
  int64_t year;
  int month; /* 1 ... 12 */
  int day;   /* 1 ... 31 */
} date;

static const int64_t SECONDS_PER_DAY = 86400;

/* Farther dates are no dates: a wrong unit or damage. */
static const double LARGEST_DAYS = 1e8;

static bool find_calendar(const char *name, calendar_kind *out)
{
  static const struct {
    const char *name;
    calendar_kind kind;
  } known[] = {
      {"", MIXED},          {"standard", MIXED},   {"gregorian", MIXED},
      {"julian", JULIAN},   {"noleap", NOLEAP},    {"proleptic_gregorian", GREGORIAN},
      {"365_day", NOLEAP},  {"all_leap", ALLLEAP}, {"366_day", ALLLEAP},
      {"360_day", DAYS360},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strcasecmp(known[i].name, name) == 0) {
      *out = known[i].kind;
      return true;
    }
  return false;
}

static bool is_leap(int64_t year, calendar_kind calendar)
{
  if (calendar == GREGORIAN)
    return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return calendar == ALLLEAP || (calendar == JULIAN && year % 4 == 0);
}

static int month_length(int64_t year, int month, calendar_kind calendar)
{
  static const int length[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (calendar == DAYS360)
    return 30;
  return length[month - 1] + (month == 2 && is_leap(year, calendar));
}

static int64_t floor_divide(int64_t a, int64_t b)
{
  return a / b - (a % b < 0);
}

/* Days from 1 January of year 0 to that of `year`. */
static int64_t days_before(int64_t year, calendar_kind calendar)
{
  const int64_t last = year - 1; /* leap years in 0 ... last, year 0 among them */
  switch (calendar) {
  case DAYS360:
    return 360 * year;
  case NOLEAP:
    return 365 * year;
  case ALLLEAP:
    return 366 * year;
  case JULIAN:
    return 365 * year + floor_divide(last, 4) + 1;
  default:
    return 365 * year + floor_divide(last, 4) - floor_divide(last, 100) +
           floor_divide(last, 400) + 1;
  }
}

static int64_t day_number(date d, calendar_kind calendar)
{
  int64_t days = days_before(d.year, calendar) + d.day - 1;
  for (int month = 1; month < d.month; ++month)
    days += month_length(d.year, month, calendar);
  return days;
}

static date date_of(int64_t days, calendar_kind calendar)
{
  /* not after the day: no year is longer than 366 days, none shorter than 360 */
  date d = {.year = floor_divide(days, days < 0 ? 360 : 366) - 1, .month = 1};
  while (days_before(d.year + 1, calendar) <= days)
    ++d.year;
  days -= days_before(d.year, calendar);
  while (days >= month_length(d.year, d.month, calendar))
    days -= month_length(d.year, d.month++, calendar);
  d.day = (int)days + 1;
  return d;
}

/* The standard calendar is Julian up to 4 October 1582, Gregorian from 15 October, the
 * next day: both count from there. */
static int64_t mixed_day_number(date d)
{
  const date reform = {1582, 10, 15};
  const date old_style = {1582, 10, 5};
  const bool gregorian =
      d.year > 1582 ||
      (d.year == 1582 && (d.month > 10 || (d.month == 10 && d.day >= 15)));
  return gregorian ? day_number(d, GREGORIAN) - day_number(reform, GREGORIAN)
                   : day_number(d, JULIAN) - day_number(old_style, JULIAN);
}

static date mixed_date_of(int64_t days)
{
  const date reform = {1582, 10, 15};
  const date old_style = {1582, 10, 5};
  return days >= 0 ? date_of(days + day_number(reform, GREGORIAN), GREGORIAN)
                   : date_of(days + day_number(old_style, JULIAN), JULIAN);
}

static double unit_seconds(const char *word)
{
  static const struct {
    const char *word;
    double seconds;
  } known[] = {
      {"second", 1},
      {"seconds", 1},
      {"sec", 1},
      {"s", 1},
      {"minute", 60},
      {"minutes", 60},
      {"min", 60},
      {"hour", 3600},
      {"hours", 3600},
      {"hr", 3600},
      {"hrs", 3600},
      {"h", 3600},
      {"day", 86400},
      {"days", 86400},
      {"d", 86400},
      {"msec", 1e-3},
      {"mins", 60},
      {"secs", 1},
      {"milliseconds", 1e-3},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strcasecmp(known[i].word, word) == 0)
      return known[i].seconds;
  return 0.0;
}

static bool read_reference(const char *units, double *unit, date *day, double *seconds)
{
  char word[32];
  char since[8];
  int year;
  int hour = 0;
  int minute = 0;
  double second = 0.0;
  char separator = ' ';
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return false;
  const int found = sscanf(units, "%31s %7s %d-%d-%d%c%d:%d:%lf", word, since, &year,
                           &day->month, &day->day, &separator, &hour, &minute, &second);
  fg__number_locale_end(&locale);
  if (found < 5 || strcasecmp(since, "since") != 0 || day->month < 1 || day->month > 12 ||
      day->day < 1 || day->day > 31 || year < -10000 || year > 100000)
    return false;
  if (separator != ' ' && separator != 'T' && separator != 't')
    return false;
  day->year = year;
  *seconds = hour * 3600.0 + minute * 60.0 + second;
  *unit = unit_seconds(word);
  return *unit > 0.0 && isfinite(*seconds) && fabs(*seconds) <= 2.0 * 86400.0;
}

bool fg__nc_date(double value, const char *units, const char *calendar, char *out,
                 size_t size)
{
  static const char *const month_name[] = {
      "January", "February", "March",     "April",   "May",      "June",
      "July",    "August",   "September", "October", "November", "December"};
  calendar_kind kind;
  double unit;
  date reference;
  double offset;
  if (!find_calendar(calendar, &kind) ||
      !read_reference(units, &unit, &reference, &offset))
    return false;
  const double elapsed = value * unit + offset;
  if (!(fabs(elapsed) <= LARGEST_DAYS * (double)SECONDS_PER_DAY))
    return false;
  const int64_t seconds = llround(elapsed);
  const int64_t days = floor_divide(seconds, SECONDS_PER_DAY);
  const int64_t rest = seconds - days * SECONDS_PER_DAY;
  const date d = kind == MIXED ? mixed_date_of(mixed_day_number(reference) + days)
                               : date_of(day_number(reference, kind) + days, kind);
  /* COARDS: a reference in year 0 marks a climatology, whose year means nothing */
  if (reference.year == 0 && d.year <= 1)
    snprintf(out, size, "%d %s (climatology)", d.day, month_name[d.month - 1]);
  else if (rest == 0)
    snprintf(out, size, "%04lld-%02d-%02d", (long long)d.year, d.month, d.day);
  else
    snprintf(out, size, "%04lld-%02d-%02d %02d:%02d", (long long)d.year, d.month, d.day,
             (int)(rest / 3600), (int)(rest / 60 % 60));
  return true;
}
