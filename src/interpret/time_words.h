/* Times as words: dates as ISO 8601 writes them, to be compared in any calendar; and
 * numbers. */
#ifndef FG__TIME_WORDS_H
#define FG__TIME_WORDS_H

#include "base/context.h"
#include "file/number_text.h"

#include <stdbool.h>
#include <stdint.h>

/* The month, day, hour, minute or second that a date names. */
typedef struct fg__period {
  double key, end_key; /* of its beginning and of the next one's: they order dates of any
                          calendar whose months have at most 31 days */
  double seconds;      /* of its beginning, from 1970 on, as in the Gregorian calendar */
} fg__period;

/* Reads "1982-07", "1982-07-16", "1982-07-16T12", "...T12:00", "...T12:00:30.5", with a
 * space instead of the T and perhaps a Z behind; false for anything else. */
bool fg__period_read(fg__period *out, const char *text);

/* The period of a year. */
fg__period fg__period_of_year(int year);

/* The same of the date that words begin with, of a day at least. */
bool fg__period_read_start(fg__period *out, const char *words);

/* Days from 1970-01-01 to a day of the proleptic Gregorian calendar; one past the end of
 * its month lies in the next. */
int64_t fg__day_number(int64_t year, int64_t month, int64_t day);

enum { FG__TIME_BYTES = FG__NUMBER_BYTES + 8 };

/* Writes a time that is a number as "t = 2.5". MEMORY (no locale). */
fg_status fg__time_write(char out[FG__TIME_BYTES], fg_context *context, double time);

/* Writes seconds from 1970 on as a date, "1982-07-16", with a clock where it is not
 * midnight, "1982-07-16 12:00[:30[.500]]"; as fg__time_write where no calendar goes. */
fg_status fg__date_write(char out[FG__TIME_BYTES], fg_context *context, double seconds);

#endif
