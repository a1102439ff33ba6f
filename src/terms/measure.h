/* Axes that are drawn on another scale than they are measured on, as those of vertical
 * sections are. Their units say which, as UDUNITS has them: of "-25 hPa" a coordinate of
 * 2 is -50 hPa, of "-0.2 lg(re 1 hPa)" it is 10^-0.4 hPa. */
#ifndef FG__MEASURE_H
#define FG__MEASURE_H

#include <stdbool.h>

enum { FG__MEASURE_BYTES = 256 };

typedef struct fg__measure {
  double factor; /* of the measured value, or of its decimal logarithm; 1: as drawn */
  bool logarithmic;
  char units[FG__MEASURE_BYTES]; /* of what is measured; cut to the buffer */
} fg__measure;

fg__measure fg__measure_of(const char *units);

/* From a coordinate to what is measured there, and back. */
double fg__measure_value(const fg__measure *measure, double coordinate);
double fg__measure_coordinate(const fg__measure *measure, double value);

#endif
