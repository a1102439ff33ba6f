/* A streamline at even steps, with the room that an arrow finds beside it. */
#ifndef FG__STATIONS_H
#define FG__STATIONS_H

#include "icon/streamline.h"

typedef struct fg__station {
  double s; /* arc length */
  double position[2], tangent[2];
  double turning;  /* angle turned since the first station, radians */
  double room;     /* free way to the nearer side, less the margin; negative: none */
  double bend;     /* angle turned within a width to either side (fg__stations_bend) */
  double bend_sum; /* of squared bends before this station */
  double share;    /* of the way from the tail's width to the full one that fits here */
  int earliest;    /* no arrow ending here begins before this one */
} fg__station;

/* All zero at first; can be used again and again. */
typedef struct fg__stations {
  fg__station *station;
  size_t capacity;
  int count;
  double step;        /* arc length between two of them */
  double bend_window; /* arc length over which bends are taken */
} fg__stations;

/* The place an arrow may take. */
typedef struct fg__room {
  const fg__window *window;
  const double *distance; /* the window's distance map */
  double spacing;         /* of the density: the yardstick of readability */
  double margin;          /* between the outline and the window's zero set */
} fg__room;

/* The distance map is of first order near corners: that many spacings of it are not
 * relied on. */
#define FG__DISTANCE_ERROR 0.75

/* The distance map at a point, bilinear; the nearest node's value outside the window. */
double fg__distance_at(const fg__window *window, const double *distance,
                       const double position[2]);

/* Whether a point lies in the room, margin not counted. */
bool fg__room_has(const fg__room *room, double x, double y);

/* Places stations all along a line and looks to both sides of each, at most `reach` far.
 * MEMORY. */
fg_status fg__stations_place(fg__stations *stations, fg_context *context,
                             const fg__streamline *line, const fg__room *room,
                             double reach);

/* Sets bend and bend_sum for arrows of a width. */
void fg__stations_bend(fg__stations *stations, double width);

void fg__stations_clear(fg__stations *stations);

#endif
