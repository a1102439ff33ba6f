#include "interpret/time_words.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { YEAR_DIGITS = 6, DAY_SECONDS = 86400 };

/* From 1970 to the year 9999 and a little. */
static const double MOST_SECONDS = 2.5e11;

/* Reads a number of exactly so many digits; advances. */
static bool read_digits(const char **text, int digits, int least, int most, int *out)
{
  *out = 0;
  for (int k = 0; k < digits; ++k, ++*text) {
    if (!isdigit((unsigned char)**text))
      return false;
    *out = 10 * *out + (**text - '0');
  }
  return *out >= least && *out <= most;
}

/* Four digits at least, perhaps after a minus. */
static bool read_year(const char **text, int *year)
{
  const char *at = *text + (**text == '-');
  const int digits = (int)strspn(at, "0123456789");
  if (digits < 4 || digits > YEAR_DIGITS || !read_digits(&at, digits, 0, 999999, year))
    return false;
  *year = **text == '-' ? -*year : *year;
  *text = at;
  return true;
}

/* The time of day after the date, as far as it goes; how long what it names is. */
static bool read_clock(const char **text, double *second, double *length)
{
  int part = 0;
  static const int most[] = {24, 59, 60};
  static const double unit[] = {3600.0, 60.0, 1.0};
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && **text != ':')
      break;
    *text += k > 0;
    if (!read_digits(text, 2, 0, most[k], &part))
      return false;
    *second += unit[k] * part;
    *length = unit[k];
  }
  if (*length <= 1.0 && **text == '.') {
    double scale = 0.1;
    for (++*text; isdigit((unsigned char)**text); ++*text, scale *= 0.1)
      *second += scale * (**text - '0');
  }
  return true;
}

/* Reads as far as a date goes. */
static bool read_period(fg__period *out, const char **text, bool needs_day)
{
  int year, month, day = 1;
  double second = 0.0, length = 31.0 * DAY_SECONDS;
  if (!read_year(text, &year) || *(*text)++ != '-' ||
      !read_digits(text, 2, 1, 12, &month))
    return false;
  const bool has_day = **text == '-';
  if (needs_day && !has_day)
    return false;
  if (has_day) {
    ++*text;
    length = DAY_SECONDS;
    if (!read_digits(text, 2, 1, 31, &day))
      return false;
  }
  if (has_day && **text && strchr("Tt _", **text) && isdigit((unsigned char)(*text)[1])) {
    ++*text;
    if (!read_clock(text, &second, &length))
      return false;
    *text += **text == 'Z' || **text == 'z';
  }
  const double days = (12.0 * year + month - 1) * 31.0 + day - 1;
  out->key = days * DAY_SECONDS + second;
  out->end_key = out->key + length;
  out->seconds = (double)fg__day_number(year, month, day) * DAY_SECONDS + second;
  return true;
}

bool fg__period_read(fg__period *out, const char *text)
{
  return read_period(out, &text, false) && !*text;
}

fg__period fg__period_of_year(int year)
{
  const double length = 12.0 * 31.0 * DAY_SECONDS; /* as read_period counts months */
  return (fg__period){.key = year * length,
                      .end_key = (year + 1.0) * length,
                      .seconds = (double)fg__day_number(year, 1, 1) * DAY_SECONDS};
}

bool fg__period_read_start(fg__period *out, const char *words)
{
  return read_period(out, &words, true) && (!*words || *words == ' ');
}

int64_t fg__day_number(int64_t year, int64_t month, int64_t day)
{
  const int64_t y = month <= 2 ? year - 1 : year;
  const int64_t era = (y >= 0 ? y : y - 399) / 400;
  const int64_t of_era = y - era * 400;
  const int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

fg_status fg__time_write(char out[FG__TIME_BYTES], fg_context *context, double time)
{
  char number[FG__NUMBER_BYTES];
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(context, "a locale", sizeof locale);
  fg__number_write(number, time);
  fg__number_locale_end(&locale);
  snprintf(out, FG__TIME_BYTES, "t = %s", number);
  return FG_STATUS_OK;
}

fg_status fg__date_write(char out[FG__TIME_BYTES], fg_context *context, double seconds)
{
  struct tm date;
  const double whole = floor(seconds);
  if (!(fabs(seconds) < MOST_SECONDS) || !gmtime_r(&(time_t){(time_t)whole}, &date))
    return fg__time_write(out, context, seconds);
  size_t used = strftime(out, FG__TIME_BYTES, "%Y-%m-%d", &date);
  if (date.tm_hour + date.tm_min + date.tm_sec > 0 || seconds > whole)
    used += strftime(out + used, FG__TIME_BYTES - used, " %H:%M", &date);
  if (date.tm_sec > 0 || seconds > whole)
    used += strftime(out + used, FG__TIME_BYTES - used, ":%S", &date);
  if (seconds > whole)
    snprintf(out + used, FG__TIME_BYTES - used, ".%03d",
             (int)floor(1000.0 * (seconds - whole)));
  return FG_STATUS_OK;
}
