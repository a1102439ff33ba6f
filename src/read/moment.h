/* Dates as ISO 8601 writes them, to be compared in any calendar. */
#ifndef FG__MOMENT_H
#define FG__MOMENT_H

#include <stdbool.h>

/* The month, day, hour, minute or second that a date names. */
typedef struct fg__period {
  double key, end_key; /* of its beginning and of the next one's: they order dates of any
                          calendar whose months have at most 31 days */
  double seconds;      /* of its beginning, from 1970 on, as in the Gregorian calendar */
} fg__period;

/* Reads "1982-07", "1982-07-16", "1982-07-16T12", "...T12:00", "...T12:00:30.5", with a
 * space instead of the T and perhaps a Z behind; false for anything else. */
bool fg__period_read(fg__period *out, const char *text);

/* The same of the date that words begin with, of a day at least. */
bool fg__period_read_start(fg__period *out, const char *words);

#endif
