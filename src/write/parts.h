/* Lines of a map's plane as lines in longitude and latitude. */
#ifndef FG__PARTS_H
#define FG__PARTS_H

#include "map/map.h"

/* A line in parts: positions within [-180, 180] and [-90, 90], cut where it crosses the
 * antimeridian. */
typedef struct fg__line_parts {
  double (*position)[2];
  int count, capacity;
  int *first; /* [parts] of each part, among the positions */
  int parts;
  bool moved; /* other numbers than those of the plane, which is in degrees */
} fg__line_parts;

/* Makes the lines of `count` points on a map's plane; map NULL: which are degrees. A
 * point without an image goes to its neighbour's; parts is 0 where no point has one.
 * Clear before and after with fg__parts_clear. MEMORY. */
fg_status fg__parts_find(fg__line_parts *out, fg_context *context, const fg__map *map,
                         const double (*point)[3], int count);
void fg__parts_clear(fg__line_parts *lines);

/* A position in longitude, within [-180, 180], and latitude. NaN: it has no image. */
void fg__parts_position(double out[2], const fg__map *map, const double point[3]);

#endif
