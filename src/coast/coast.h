/* Land, lakes and borders of countries, from Natural Earth: data that lie in the library.
 */
#ifndef FG__COAST_H
#define FG__COAST_H

#include "base/context.h"

/* By how much the sources are generalised: for maps at 1 to so many millions. */
typedef enum fg__coast_detail {
  FG__COAST_110M,
  FG__COAST_50M,
  FG__COAST_10M
} fg__coast_detail;

typedef enum fg__coast_layer {
  FG__COAST_LAND, /* rings round land, and round inland seas; neither sense is promised */
  FG__COAST_LAKES,  /* rings round lakes, and round islands in them */
  FG__COAST_BORDERS /* open lines between countries */
} fg__coast_layer;

/* Line k runs from start[k] to start[k + 1] - 1; a ring's first point is not repeated.
 * Longitudes and latitudes in degrees; a longitude follows that of the point before by
 * less than 180 degrees, and so goes on beyond 180 where a line crosses the antimeridian:
 * the ring round a pole ends 360 degrees from its beginning. */
typedef struct fg__coast_lines {
  double (*point)[2];
  size_t *start;
  size_t count;
} fg__coast_lines;

/* MEMORY. */
fg_status fg__coast_read(fg__coast_lines *out, fg_context *context, fg__coast_layer layer,
                         fg__coast_detail detail);
void fg__coast_clear(fg__coast_lines *lines);

/* The files of data/ as scripts/coast makes them, and CMake embeds them (coast_data.c):
 * for each layer the number of lines, for each line the number of its points and the
 * points as differences from the one before (from zero for the first), longitude then
 * latitude, in units of 0.002 degrees. All of these are variable-length integers, seven
 * bits a byte, the lowest first; differences are zigzag coded. */
extern const unsigned char fg__coast_110m[], fg__coast_50m[], fg__coast_10m[];
extern const size_t fg__coast_110m_size, fg__coast_50m_size, fg__coast_10m_size;

#endif
