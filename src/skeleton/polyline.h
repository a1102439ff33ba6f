/* A line of points that can grow; z = 0 in 2D. */
#ifndef FG__POLYLINE_H
#define FG__POLYLINE_H

#include "base/context.h"

typedef struct fg__polyline {
  double (*point)[3];
  int count;
  bool closed; /* the last point is joined to the first */
  size_t capacity;
} fg__polyline;

/* Adds a point at the end. False when there is no memory. */
bool fg__polyline_add(fg__polyline *line, const double point[3]);

/* Turns the order of the points round. */
void fg__polyline_reverse(fg__polyline *line);

double fg__polyline_length(const fg__polyline *line);

/* Replaces the points by others on the same line, evenly spaced along it by about `step`
 * (at most two thirds more or less, so that they fit); the ends stay. False when there is
 * no memory. */
bool fg__polyline_resample(fg__polyline *line, double step);

void fg__polyline_clear(fg__polyline *line);

#endif
