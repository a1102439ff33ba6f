/* Times as dates and durations in words: of numbers "since" a date, of texts, and as they
 * are asked for. */
#ifndef FG__TERMS_DATES_H
#define FG__TERMS_DATES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes a time as a date of its calendar in UTC, "2014-01-31 03:00[:30]"; false when
 * units or calendar are unknown. */
bool fg__date_of_number(double value, const char *units, const char *calendar, char *out,
                        size_t size);

/* Writes a date that a file has as text in the same form; false when it is none. Texts
 * are those of fg__period_read, of a day at least, and "20200115[T06[30[00]]]". */
bool fg__date_of_text(const char *text, char *out, size_t size);

/* Writes seconds from 1970 on in the same form, with milliseconds where they are no whole
 * number; false beyond the year 9999. */
bool fg__date_of_seconds(double seconds, char *out, size_t size);

/* Writes a time without a known reference date as a duration, "3 d", "1 d 6 h 30 min";
 * false where units are not of time, or the time is no whole number of seconds. */
bool fg__duration(double value, const char *units, char *out, size_t size);

/* The month, day, hour, minute or second that a date names. */
typedef struct fg__period {
  double key, end_key; /* of its beginning and of the next one's: they order dates of any
                          calendar whose months have at most 31 days */
  double seconds;      /* of its beginning, from 1970 on, as in the Gregorian calendar */
} fg__period;

/* Reads "1982-07", "1982-07-16", "1982-07-16T12", "...T12:00", "...T12:00:30.5", with a
 * space or _ instead of the T and perhaps a Z behind; false for anything else. */
bool fg__period_read(fg__period *out, const char *text);

/* The period of a year. */
fg__period fg__period_of_year(int year);

/* The same of the date that words begin with, of a day at least. */
bool fg__period_read_start(fg__period *out, const char *words);

/* Days from 1970-01-01 to a day of the proleptic Gregorian calendar; one past the end of
 * its month lies in the next. */
int64_t fg__day_number(int64_t year, int64_t month, int64_t day);

#endif
