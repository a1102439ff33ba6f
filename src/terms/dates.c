/* CF conventions, section 4.4: "hours since 1900-01-01 00:00". */
#include "terms/dates.h"

#include "terms/calendar.h"
#include "terms/text.h"
#include "terms/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DAY_SECONDS = 86400, YEAR_DIGITS = 6 };

/* Dates farther from the reference are an error of units, or damage. */
static const double LARGEST_DAYS = 1e8;

/* From 1970 to the year 9999 and a little. */
static const double MOST_SECONDS = 2.5e11;

/* Reads a number of at most `digits` digits; advances. */
static bool read_number(const char **text, int digits, int least, int most, int *out)
{
  int n = 0;
  *out = 0;
  for (; n < digits && fg__is_digit(**text); ++n, ++*text)
    *out = 10 * *out + (**text - '0');
  return n > 0 && *out >= least && *out <= most;
}

/* The same of exactly `digits`. */
static bool read_digits(const char **text, int digits, int least, int most, int *out)
{
  const char *start = *text;
  return read_number(text, digits, least, most, out) && *text - start == digits;
}

/* The digits behind a point, if there is one. */
static double read_fraction(const char **text)
{
  double sum = 0.0, scale = 0.1;
  if (**text != '.')
    return 0.0;
  for (++*text; fg__is_digit(**text); ++*text, scale *= 0.1)
    sum += scale * (**text - '0');
  return sum;
}

/* Parses "15:30", "15:15:42.5", "-6", "-6:00" or "+0530" of a reference date; false for
 * anything else, *seconds 0 where there is nothing. */
static bool read_clock(const char **text, double *seconds)
{
  enum { MOST_DIGITS = 6 };
  const char *at = *text + strspn(*text, " Tt");
  const double sign = *at == '-' ? -1.0 : 1.0;
  int hour = 0, minute = 0, second = 0;
  *seconds = 0.0;
  at += *at == '-' || *at == '+';
  if (!fg__is_digit(*at))
    return true;
  const char *start = at;
  if (!read_number(&at, MOST_DIGITS, 0, 999999, &hour))
    return false;
  if (at - start > 2) {
    minute = hour % 100;
    hour /= 100;
  }
  if (*at == ':' && !(++at, read_number(&at, MOST_DIGITS, 0, 999999, &minute)))
    return false;
  if (*at == ':' && !(++at, read_number(&at, MOST_DIGITS, 0, 999999, &second)))
    return false;
  *seconds = sign * (hour * 3600.0 + minute * 60.0 + second + read_fraction(&at));
  *text = at;
  return !*at || strchr(" +-ZzUG", *at);
}

/* Months in a unit of them; 0: another unit. */
static int months_of(const char *word)
{
  const size_t length = strlen(word);
  return fg__is_one_of("month|months", word, length) ? 1
         : fg__is_one_of("year|years", word, length) ? 12
                                                     : 0;
}

/* Parses the unit, in seconds or in months, and the reference: a date, an optional time
 * of day, and an optional offset from UTC. */
static bool read_reference(const char *units, double *unit, int *months, fg__date *date,
                           double *seconds)
{
  char word[32];
  char since[8];
  int year;
  int used = 0;
  *unit = 0.0;
  *months = 0;
  if (sscanf(units, "%31s %7s %d-%d-%d%n", word, since, &year, &date->month, &date->day,
             &used) != 5 ||
      !fg__is_same(since, "since") ||
      ((*months = months_of(word)) == 0 && !fg__units_seconds(word, unit)) ||
      date->month < 1 || date->month > 12 || date->day < 1 || date->day > 31 ||
      year < -10000 || year > 100000 || !strchr(" Tt", units[used]))
    return false;
  date->year = year;
  const char *rest = units + used;
  double clock, ahead;
  if (!read_clock(&rest, &clock) || !read_clock(&rest, &ahead))
    return false;
  *seconds = clock - ahead;
  rest += strspn(rest, " ");
  return fg__is_one_of("|Z|UTC|GMT", rest, strlen(rest)) &&
         fabs(*seconds) <= 2.0 * DAY_SECONDS;
}

/* Writes a date, with hours, minutes and seconds as far as `rest` seconds have them. */
static size_t write_date(char *out, size_t size, fg__date d, int64_t rest)
{
  const int hour = (int)(rest / 3600), minute = (int)(rest / 60 % 60);
  int used = snprintf(out, size, "%04lld-%02d-%02d", (long long)d.year, d.month, d.day);
  if (rest > 0 && used > 0 && (size_t)used < size)
    used += snprintf(out + used, size - (size_t)used, " %02d:%02d", hour, minute);
  if (rest % 60 > 0 && used > 0 && (size_t)used < size)
    used += snprintf(out + used, size - (size_t)used, ":%02d", (int)(rest % 60));
  return used < 0 ? 0 : (size_t)used;
}

/* Absolute times of CDI (ICON, ECHAM): the digits of the date, and the part of the day.
 */
static bool write_absolute(char *out, size_t size, double value, fg__calendar calendar)
{
  const double whole = floor(value);
  if (!(whole >= 101.0 && whole <= 99991231.0))
    return false;
  const int64_t digits = (int64_t)whole;
  int64_t seconds = llround((value - whole) * DAY_SECONDS); /* to 1 ms */
  const fg__date date = {digits / 10000, (int)(digits / 100 % 100), (int)(digits % 100)};
  if (date.month < 1 || date.month > 12 || !fg__calendar_has(calendar, date))
    return false;
  seconds = seconds < DAY_SECONDS ? seconds : DAY_SECONDS - 1;
  write_date(out, size, date, seconds);
  return true;
}

/* Moves a date by calendar months, at most to the end of one; the seconds of what is left
 * of a month. UDUNITS takes a month for a twelfth of a mean year, which no file means. */
static double move_by_months(fg__date *date, fg__calendar calendar, double months)
{
  const double whole = floor(months);
  const int64_t sum = date->month - 1 + (int64_t)whole, month = (sum % 12 + 12) % 12;
  date->year += (sum - month) / 12;
  date->month = (int)month + 1;
  while (!fg__calendar_has(calendar, *date))
    --date->day;
  fg__date next = *date;
  next.year += month == 11;
  next.month = (int)((month + 1) % 12) + 1;
  const int64_t days =
      fg__calendar_day(calendar, next) - fg__calendar_day(calendar, *date);
  return (months - whole) * (double)(days * DAY_SECONDS);
}

/* The date a number of seconds after another, and what is left of its day. */
static fg__date date_after(fg__calendar calendar, fg__date from, int64_t seconds,
                           int64_t *rest)
{
  *rest = (seconds % DAY_SECONDS + DAY_SECONDS) % DAY_SECONDS;
  return fg__calendar_date(calendar, fg__calendar_day(calendar, from) +
                                         (seconds - *rest) / DAY_SECONDS);
}

/* Whether all programs mean the same day: no standard or Julian calendar agrees on years
 * before 1 (CF conventions, section 4.4.2), of which year 0 marks a climatology. */
static bool is_reference(fg__calendar calendar, fg__date date)
{
  return fg__calendar_has(calendar, date) &&
         (date.year >= 0 ||
          (calendar != FG__CALENDAR_STANDARD && calendar != FG__CALENDAR_JULIAN));
}

bool fg__date_of_number(double value, const char *units, const char *calendar, char *out,
                        size_t size)
{
  static const char *const month_name[] = {
      "January", "February", "March",     "April",   "May",      "June",
      "July",    "August",   "September", "October", "November", "December"};
  fg__calendar kind;
  double unit, offset;
  int months;
  int64_t rest;
  fg__date reference;
  if (!fg__calendar_find(&kind, calendar))
    return false;
  if (fg__is_one_of(FG__ABSOLUTE_DATES, units, strlen(units)))
    return write_absolute(out, size, value, kind);
  if (fg__is_one_of(FG__ABSOLUTE_MONTHS, units, strlen(units)))
    return write_absolute(out, size, 100.0 * floor(value) + 1.0, kind);
  if (!read_reference(units, &unit, &months, &reference, &offset) ||
      !is_reference(kind, reference) || !(fabs(value) * months <= LARGEST_DAYS / 31.0))
    return false;
  const bool is_climatology = reference.year == 0;
  double elapsed =
      months > 0 ? move_by_months(&reference, kind, value * months) : value * unit;
  if (!(fabs(elapsed += offset) <= LARGEST_DAYS * DAY_SECONDS))
    return false;
  const fg__date d = date_after(kind, reference, llround(elapsed), &rest);
  /* COARDS: a reference in year 0 marks a climatology, whose year means nothing; where
     the calendar has no such year, later dates are a year apart between programs */
  if (is_climatology && d.year > 1 &&
      (kind == FG__CALENDAR_STANDARD || kind == FG__CALENDAR_JULIAN))
    return false;
  if (is_climatology && d.year <= 1)
    snprintf(out, size, "%d %s (climatology)", d.day, month_name[d.month - 1]);
  else
    write_date(out, size, d, rest);
  return true;
}

bool fg__date_of_seconds(double seconds, char *out, size_t size)
{
  const double whole = floor(seconds);
  int64_t rest;
  if (!(fabs(seconds) < MOST_SECONDS))
    return false;
  const fg__date d =
      date_after(FG__CALENDAR_GREGORIAN, (fg__date){1970, 1, 1}, (int64_t)whole, &rest);
  size_t used = write_date(out, size, d, rest);
  if (seconds <= whole)
    return true;
  if (rest % 60 == 0 && used < size)
    used += (size_t)snprintf(out + used, size - used, rest == 0 ? " 00:00:00" : ":00");
  if (used < size)
    snprintf(out + used, size - used, ".%03d", (int)floor(1000.0 * (seconds - whole)));
  return true;
}

bool fg__duration(double value, const char *units, char *out, size_t size)
{
  static const struct {
    int64_t seconds;
    const char *label;
  } parts[] = {{86400, "d"}, {3600, "h"}, {60, "min"}, {1, "s"}};
  double unit;
  if (!fg__units_seconds(units, &unit))
    return false;
  const double whole = nearbyint(fabs(value) * unit);
  if (!(whole <= LARGEST_DAYS * DAY_SECONDS) || fabs(fabs(value) * unit - whole) > 1e-6)
    return false;
  int64_t rest = (int64_t)whole;
  size_t used = 0;
  for (int k = 0; k < 4 && used < size; ++k) {
    const int64_t count = rest / parts[k].seconds;
    rest -= count * parts[k].seconds;
    const bool is_zero = whole == 0.0 && (k == 3 || (double)parts[k].seconds <= unit);
    if (count > 0 || (is_zero && used == 0))
      used += (size_t)snprintf(out + used, size - used, "%s%s%lld %s", used ? " " : "",
                               used == 0 && value < 0.0 ? "-" : "", (long long)count,
                               parts[k].label);
  }
  return true;
}

/* A date as text: the day, the second after its beginning, and how long what is named is.
 */
typedef struct written_date {
  fg__date date;
  double second, length;
} written_date;

/* Four digits of a year at least, perhaps after a minus. */
static bool read_year(const char **text, int64_t *year)
{
  const char *at = *text + (**text == '-');
  const int digits = (int)strspn(at, "0123456789");
  int found;
  if (digits < 4 || digits > YEAR_DIGITS || !read_digits(&at, digits, 0, 999999, &found))
    return false;
  *year = **text == '-' ? -found : found;
  *text = at;
  return true;
}

/* Hours, minutes and seconds: the greatest, and how long each is. */
static const int MOST_OF_CLOCK[] = {24, 59, 60};
static const double CLOCK_UNIT[] = {3600.0, 60.0, 1.0};

/* The time of day after the date, as far as it goes. */
static bool read_time_of_day(const char **text, written_date *out)
{
  int part = 0;
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && **text != ':')
      break;
    *text += k > 0;
    if (!read_digits(text, 2, 0, MOST_OF_CLOCK[k], &part))
      return false;
    out->second += CLOCK_UNIT[k] * part;
    out->length = CLOCK_UNIT[k];
  }
  if (out->length <= 1.0)
    out->second += read_fraction(text);
  return true;
}

/* Reads a date and time of day without signs between, "20200115", "2020011506",
 * "20200115T0630". */
static bool read_digits_alone(written_date *out, const char **text)
{
  int year, part;
  *out = (written_date){.length = DAY_SECONDS};
  if (!read_digits(text, 4, 0, 9999, &year) ||
      !read_digits(text, 2, 1, 12, &out->date.month) ||
      !read_digits(text, 2, 1, 31, &out->date.day))
    return false;
  out->date.year = year;
  *text += **text && strchr("Tt _", **text) && fg__is_digit((*text)[1]);
  for (int k = 0; k < 3 && fg__is_digit(**text); ++k) {
    if (!read_digits(text, 2, 0, MOST_OF_CLOCK[k], &part))
      return false;
    out->second += CLOCK_UNIT[k] * part;
  }
  *text += **text == 'Z' || **text == 'z';
  return true;
}

/* Reads as far as a date goes. */
static bool read_date(written_date *out, const char **text, bool needs_day)
{
  *out = (written_date){.date = {.day = 1}, .length = 31.0 * DAY_SECONDS};
  if (!read_year(text, &out->date.year) || *(*text)++ != '-' ||
      !read_digits(text, 2, 1, 12, &out->date.month))
    return false;
  const bool has_day = **text == '-';
  if (!has_day)
    return !needs_day;
  ++*text;
  out->length = DAY_SECONDS;
  if (!read_digits(text, 2, 1, 31, &out->date.day))
    return false;
  if (**text && strchr("Tt _", **text) && fg__is_digit((*text)[1])) {
    ++*text;
    if (!read_time_of_day(text, out))
      return false;
    *text += **text == 'Z' || **text == 'z';
  }
  return true;
}

static fg__period period_of(const written_date *d)
{
  const double months = 12.0 * (double)d->date.year + d->date.month - 1;
  const double key = (months * 31.0 + d->date.day - 1) * DAY_SECONDS + d->second;
  const int64_t day = fg__day_number(d->date.year, d->date.month, d->date.day);
  return (fg__period){.key = key,
                      .end_key = key + d->length,
                      .seconds = (double)day * DAY_SECONDS + d->second};
}

bool fg__period_read(fg__period *out, const char *text)
{
  written_date d;
  if (!read_date(&d, &text, false) || *text)
    return false;
  *out = period_of(&d);
  return true;
}

fg__period fg__period_of_year(int year)
{
  return period_of(
      &(written_date){.date = {year, 1, 1}, .length = 12.0 * 31.0 * DAY_SECONDS});
}

bool fg__period_read_start(fg__period *out, const char *words)
{
  written_date d;
  if (!read_date(&d, &words, true) || (*words && *words != ' '))
    return false;
  *out = period_of(&d);
  return true;
}

bool fg__date_of_text(const char *text, char *out, size_t size)
{
  enum { DIGITS = 8 };
  written_date d;
  const bool alone = strspn(text, "0123456789") >= DIGITS;
  if (!(alone ? read_digits_alone(&d, &text) : read_date(&d, &text, true)) ||
      text[strspn(text, " ")] || d.second >= DAY_SECONDS)
    return false;
  write_date(out, size, d.date, (int64_t)d.second);
  return true;
}

int64_t fg__day_number(int64_t year, int64_t month, int64_t day)
{
  const int64_t months = 12 * year + month - 1, past = (months % 12 + 12) % 12;
  const fg__date date = {(months - past) / 12, (int)past + 1, (int)day};
  return fg__calendar_day(FG__CALENDAR_GREGORIAN, date) -
         fg__calendar_day(FG__CALENDAR_GREGORIAN, (fg__date){1970, 1, 1});
}
