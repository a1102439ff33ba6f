/* A run of places in degrees that becomes a loop or a line on the plane. */
#ifndef FG__STROKE_H
#define FG__STROKE_H

#include "picture/map/plane.h"

typedef struct fg__stroke {
  double *longitude, *latitude, *x, *y;
  size_t count, capacity;
  bool failed; /* no memory */
} fg__stroke;

void fg__stroke_add(fg__stroke *stroke, double longitude, double latitude);

/* Adds what lies between the last place and a new one, a place every `step` degrees at
 * least, and the new one. */
void fg__stroke_add_straight(fg__stroke *stroke, double longitude, double latitude,
                             double step);

/* Projects the places, adds them to the polygons, and begins anew. closed: as one loop,
 * of those that have an image; else as lines that end where places have none. Lines of a
 * point and loops of two are left out. */
void fg__stroke_end(fg__stroke *stroke, fg__polygons *out, const fg__plane *plane,
                    bool closed);

/* The shares of an edge that lie in a box, after Liang and Barsky (1984); none: the first
 * is the larger. */
void fg__clip_edge(double share[2], const double a[2], const double b[2],
                   const double low[2], const double high[2]);

void fg__stroke_clear(fg__stroke *stroke);

#endif
