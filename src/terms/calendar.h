/* The calendars of the CF conventions (section 4.4.2). */
#ifndef FG__TERMS_CALENDAR_H
#define FG__TERMS_CALENDAR_H

#include <stdbool.h>
#include <stdint.h>

typedef enum fg__calendar {
  FG__CALENDAR_STANDARD = 0, /* Julian to 4 October 1582, Gregorian from the day after */
  FG__CALENDAR_GREGORIAN,    /* also before 1582 */
  FG__CALENDAR_JULIAN,
  FG__CALENDAR_NOLEAP,
  FG__CALENDAR_ALL_LEAP,
  FG__CALENDAR_360_DAYS
} fg__calendar;

typedef struct fg__date {
  int64_t year; /* 0 is the year before 1, as in ISO 8601 */
  int month;    /* 1 ... 12 */
  int day;      /* 1 ... 31 */
} fg__date;

/* Finds a calendar by its CF name, "" for the standard one; false when it is not known.
 */
bool fg__calendar_find(fg__calendar *out, const char *name);

/* The number of a day, counted from a fixed day of the calendar. A day past the end of
 * its month lies in the next. */
int64_t fg__calendar_day(fg__calendar calendar, fg__date date);

/* The date of a day's number. */
fg__date fg__calendar_date(fg__calendar calendar, int64_t day);

/* Whether a calendar has a date: 30 February has only that of 360 days. */
bool fg__calendar_has(fg__calendar calendar, fg__date date);

#endif
