/* Times as dates: "hours since 1900-01-01 00:00" (CF conventions, section 4.4). */
#include "file/number_text.h"
#include "interpret/time/calendar.h"
#include "interpret/time/dates.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const int64_t SECONDS_PER_DAY = 86400;

/* Dates farther from the reference are an error of units, or damage. */
static const double LARGEST_DAYS = 1e8;

/* Parses "15:30", "15:15:42.5", "-6", "-6:00" or "+0530"; false when there is none. */
static bool read_clock(const char **text, double *seconds)
{
  const char *at = *text + strspn(*text, " Tt");
  const double sign = *at == '-' ? -1.0 : 1.0;
  at += *at == '-' || *at == '+';
  if (!isdigit((unsigned char)*at))
    return false;
  char *end;
  long hour = strtol(at, &end, 10);
  long minute = 0;
  double second = 0.0;
  if (end - at > 2) {
    minute = hour % 100;
    hour /= 100;
  }
  if (*end == ':')
    minute = strtol(end + 1, &end, 10);
  if (*end == ':')
    second = strtod(end + 1, &end);
  *text = end;
  *seconds = sign * ((double)hour * 3600.0 + (double)minute * 60.0 + second);
  return isfinite(*seconds);
}

/* Months in a unit of them; 0: another unit. */
static int months_of(const char *word)
{
  const size_t length = strlen(word);
  const size_t single = length - (length > 0 && tolower(word[length - 1]) == 's');
  return single == 5 && strncasecmp(word, "month", single) == 0  ? 1
         : single == 4 && strncasecmp(word, "year", single) == 0 ? 12
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
      strcasecmp(since, "since") != 0 ||
      ((*months = months_of(word)) == 0 && !fg__units_seconds(word, unit)) ||
      date->month < 1 || date->month > 12 || date->day < 1 || date->day > 31 ||
      year < -10000 || year > 100000 || !strchr(" Tt", units[used]))
    return false;
  date->year = year;
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return false;
  const char *rest = units + used;
  double clock = 0.0;
  double ahead = 0.0;
  if (read_clock(&rest, &clock))
    read_clock(&rest, &ahead);
  fg__number_locale_end(&locale);
  *seconds = clock - ahead;
  return fabs(*seconds) <= 2.0 * (double)SECONDS_PER_DAY;
}

/* Writes a date, with hours, minutes and seconds as far as `rest` seconds have them. */
static void write_date(char *out, size_t size, fg__date d, int64_t rest)
{
  const int hour = (int)(rest / 3600), minute = (int)(rest / 60 % 60);
  int used = snprintf(out, size, "%04lld-%02d-%02d", (long long)d.year, d.month, d.day);
  if (rest > 0 && used > 0 && (size_t)used < size)
    used += snprintf(out + used, size - (size_t)used, " %02d:%02d", hour, minute);
  if (rest % 60 > 0 && used > 0 && (size_t)used < size)
    snprintf(out + used, size - (size_t)used, ":%02d", (int)(rest % 60));
}

/* Absolute times of CDI (ICON, ECHAM): the digits of the date, and the part of the day.
 */
static bool write_absolute(char *out, size_t size, double value)
{
  const double whole = floor(value);
  if (!(whole >= 101.0 && whole <= 99991231.0))
    return false;
  const int64_t digits = (int64_t)whole;
  int64_t seconds = llround((value - whole) * (double)SECONDS_PER_DAY); /* to 1 ms */
  const fg__date date = {digits / 10000, (int)(digits / 100 % 100), (int)(digits % 100)};
  if (date.month < 1 || date.month > 12 || date.day < 1 || date.day > 31)
    return false;
  seconds = seconds < SECONDS_PER_DAY ? seconds : SECONDS_PER_DAY - 1;
  write_date(out, size, date, seconds);
  return true;
}

/* Moves a date by calendar months; the seconds of what is left of a month. UDUNITS takes
 * a month for a twelfth of a mean year, which no file means. */
static double move_by_months(fg__date *date, fg__calendar calendar, double months)
{
  const double whole = floor(months);
  const int64_t sum = date->month - 1 + (int64_t)whole, month = (sum % 12 + 12) % 12;
  date->year += (sum - month) / 12;
  date->month = (int)month + 1;
  fg__date next = *date;
  next.year += month == 11;
  next.month = (int)((month + 1) % 12) + 1;
  const int64_t days =
      fg__calendar_day(calendar, next) - fg__calendar_day(calendar, *date);
  return (months - whole) * (double)(days * SECONDS_PER_DAY);
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
  fg__date reference;
  if (strcasecmp(units, FG__ABSOLUTE_DATES) == 0)
    return write_absolute(out, size, value);
  if (!fg__calendar_find(&kind, calendar) ||
      !read_reference(units, &unit, &months, &reference, &offset) ||
      !(fabs(value) * months <= LARGEST_DAYS / 31.0))
    return false;
  const bool is_climatology = reference.year == 0;
  double elapsed =
      months > 0 ? move_by_months(&reference, kind, value * months) : value * unit;
  if (!(fabs(elapsed += offset) <= LARGEST_DAYS * (double)SECONDS_PER_DAY))
    return false;
  const int64_t seconds = llround(elapsed);
  const int64_t rest = (seconds % SECONDS_PER_DAY + SECONDS_PER_DAY) % SECONDS_PER_DAY;
  const fg__date d = fg__calendar_date(kind, fg__calendar_day(kind, reference) +
                                                 (seconds - rest) / SECONDS_PER_DAY);
  /* COARDS: a reference in year 0 marks a climatology, whose year means nothing */
  if (is_climatology && d.year <= 1)
    snprintf(out, size, "%d %s (climatology)", d.day, month_name[d.month - 1]);
  else
    write_date(out, size, d, rest);
  return true;
}

bool fg__date_of_text(const char *text, char *out, size_t size)
{
  int year, month, day, hour, minute, second, used = 0;
  char parting;
  const int count = sscanf(text, "%4d-%2d-%2d%c%2d:%2d:%2d%n", &year, &month, &day,
                           &parting, &hour, &minute, &second, &used);
  if (count != 7 || !strchr("_ Tt", parting) || year < 0 || month < 1 || month > 12 ||
      day < 1 || day > 31 || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      second < 0 || second > 59)
    return false;
  used += text[used] == '.' ? 1 + (int)strspn(text + used + 1, "0123456789") : 0;
  used += text[used] == 'Z';
  if (text[used + (int)strspn(text + used, " ")])
    return false;
  write_date(out, size, (fg__date){year, month, day},
             (int64_t)hour * 3600 + minute * 60 + second);
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
  if (!(whole <= LARGEST_DAYS * (double)SECONDS_PER_DAY) ||
      fabs(fabs(value) * unit - whole) > 1e-6)
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
