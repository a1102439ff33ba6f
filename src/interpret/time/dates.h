/* Times as dates, of numbers and of texts. */
#ifndef FG__NETCDF_DATES_H
#define FG__NETCDF_DATES_H

#include "interpret/interpret.h"

/* Writes a time as a date of its calendar in UTC, "2014-01-31 03:00[:30]"; false when
 * units or calendar are unknown. */
bool fg__date_of_number(double value, const char *units, const char *calendar, char *out,
                        size_t size);

/* Converts a date that a file has as text to the same form. Text is
 * "2010-07-16_12:00:00", with a space or T in place of the underscore; fractions of a
 * second and a Z at the end are dropped. False when it is no date. */
bool fg__date_of_text(const char *text, char *out, size_t size);

/* Writes a time without a known reference date as a duration, "3 d", "1 d 6 h 30 min";
 * false where units are not of time, or the time is no whole number of seconds. */
bool fg__duration(double value, const char *units, char *out, size_t size);

/* date_texts.c. The variable with a date as text for each index of a dimension, or
 * NULL. */
const fg__variable *fg__date_texts(const fg__dataset *data, int dimension);

/* The date at one index, "" where the text is no date. Then fg__grid_axis_values of all
 * dates, whose numbers are NaN; NULL where one of the texts is no date. */
fg_status fg__date_text(char *out, size_t size, const fg__variable *texts, size_t index);
fg_status fg__date_values(fg_axis_value **out, char **text, const fg__variable *texts,
                          size_t count);

#endif
