/* Units in files ("m s**-1", "centimeter/s", "degrees_north") and on axis labels ("m/s",
 * "cm/s", "°N"). */
#ifndef FG__TERMS_UNITS_H
#define FG__TERMS_UNITS_H

#include "base/context.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum fg__quantity {
  FG__QUANTITY_UNKNOWN = 0, /* no units, or unknown ones */
  FG__QUANTITY_SPEED,
  FG__QUANTITY_ANGULAR_SPEED,
  FG__QUANTITY_PRESSURE_TENDENCY,
  FG__QUANTITY_TIME,
  FG__QUANTITY_RADIANS,
  FG__QUANTITY_LENGTH,
  FG__QUANTITY_DEGREES,
  FG__QUANTITY_DEGREES_EAST,
  FG__QUANTITY_DEGREES_NORTH,
  FG__QUANTITY_PRESSURE,
  FG__QUANTITY_DATE /* "hours since ..." */
} fg__quantity;

enum { FG__UNIT_BYTES = 256 };

typedef struct fg__unit {
  fg__quantity quantity;
  double factor; /* of one in the SI unit; of a date that of its steps, 0: months or days
                    of a calendar; below 0: west or south is positive */
  char label[FG__UNIT_BYTES]; /* on an axis; of an unknown unit its text */
} fg__unit;

/* The other unit of dates, which CDI writes (ICON, ECHAM): the number 20200115.25. */
#define FG__ABSOLUTE_DATES "day as %Y%m%d.%f|day as %Y%m%d|YYYYMMDD|%Y%m%d"
#define FG__ABSOLUTE_MONTHS "month as %Y%m.%f|month as %Y%m|YYYYMM|%Y%m"

void fg__unit_read(fg__unit *out, const char *text);

/* Writes units as on an axis label, and returns what they measure. */
fg__quantity fg__units_read(const char *text, char *label, size_t size);

/* The seconds of a unit of time ("hours"); false for any other unit. */
bool fg__units_seconds(const char *text, double *out);

/* The factor from one unit to the other, in any case and number, "hPa" to "bar", "hours"
 * to "d"; from no unit 1. 0: they measure different things, or one is not known. */
double fg__unit_factor(const char *from, const char *to);

/* The units that a column's name implies, "kn" of METAR's sknt and wind_speed_kt,
 * "degrees_west" of longitude_W; "": none. */
const char *fg__units_of_name(const char *name);

/* ARGUMENT: longitudes and latitudes that are in degrees fill the globe in radians. */
fg_status fg__check_degrees(fg_context *context, const char *path,
                            const double *longitude, const double *latitude,
                            size_t count);

/* Whether those between these ends do. */
bool fg__fill_radians(const double longitude[2], const double latitude[2]);

/* Whether a word is a unit that stands behind a name without brackets: "X mm". */
bool fg__is_unit_in_name(const char *word);

#endif
