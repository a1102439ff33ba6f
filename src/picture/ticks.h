/* Where an axis or a key carries ticks, and what is written beside them. */
#ifndef FG__TICKS_H
#define FG__TICKS_H

#include <stdbool.h>

enum { FG__TICK_LIMIT = 24, FG__TICK_BYTES = 40, FG__AXIS_BYTES = 320 };

typedef enum fg__tick_style {
  FG__TICKS_NUMBER,
  FG__TICKS_LOGARITHM, /* of a number, whose decimal logarithm is coordinate * factor */
  FG__TICKS_LONGITUDE,
  FG__TICKS_LATITUDE
} fg__tick_style;

/* How the coordinates from low to high are written: as (coordinate - offset) * factor,
 * with a label that says so. */
typedef struct fg__tick_axis {
  fg__tick_style style;
  double low, high;
  double factor;
  double offset;
  char label[FG__AXIS_BYTES]; /* "x (km)"; "" none */
  char units[FG__AXIS_BYTES]; /* after a number: "km", "×10^3 m"; "" none */
} fg__tick_axis;

typedef struct fg__ticks {
  int count;
  double step;                     /* coordinates */
  double position[FG__TICK_LIMIT]; /* coordinates, ascending, inside [low, high] */
  char text[FG__TICK_LIMIT][FG__TICK_BYTES];
} fg__ticks;

/* An axis of numbers, on the scale of its units (terms/measure.h): lengths in the unit
 * that suits `extent` (the larger extent of the axes that share it), a power of ten or an
 * offset in the label instead of long numbers.
 */
void fg__axis_of_numbers(fg__tick_axis *out, double low, double high, double extent,
                         const char *name, const char *units);

/* Degrees of longitude or latitude. */
void fg__axis_of_degrees(fg__tick_axis *out, double low, double high,
                         fg__tick_style style);

/* The smallest nice step that is at least `least`, coordinates: 1, 2, 5 times a power of
 * ten as the axis is written; divisors of a right angle for degrees. */
double fg__ticks_step(const fg__tick_axis *axis, double least);

/* The largest nice step below `step`. */
double fg__ticks_step_below(const fg__tick_axis *axis, double step);

/* Fills in the multiples of `step`; count stays 0 when they are more than FG__TICK_LIMIT.
 */
void fg__ticks_fill(fg__ticks *out, const fg__tick_axis *axis, double step);

/* Writes a difference of coordinates with its unit: "20°", "200 km", "0.2". */
void fg__axis_write_length(char out[FG__AXIS_BYTES], const fg__tick_axis *axis,
                           double length);

#endif
