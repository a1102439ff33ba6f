/* How land.c traces a layer, part by part. */
#ifndef FG__TRACER_H
#define FG__TRACER_H

#include "coast/coast.h"
#include "picture/map/stroke.h"

typedef struct fg__tracer {
  const fg__plane *plane;
  fg__polygons *areas, *lines; /* either may be NULL */
  double step;                 /* degrees between places, at most */
  fg__stroke stroke;
  double (*clipped)[2], (*next)[2]; /* room for `capacity` points */
  size_t capacity;
  bool failed; /* no memory */
} fg__tracer;

/* A ring or an open line of the data. */
typedef struct fg__coast_part {
  const double (*point)[2];
  size_t count;
  bool closed;
  double turn; /* from its beginning to its end: -360, 0 or 360 degrees */
  double low[2], high[2];
} fg__coast_part;

/* Edge n of a part, from its point n to the next; a ring's last leads to its first. */
void fg__part_edge(const fg__coast_part *part, size_t n, double a[2], double b[2]);
size_t fg__part_edges(const fg__coast_part *part);

/* Whether an edge is one of the data's own cut along the antimeridian: no coast. */
bool fg__edge_is_cut(const double a[2], const double b[2]);

/* The first and the last number of turns by which the window shows the part; none: the
 * first is the larger. */
void fg__part_turns(int turns[2], const fg__coast_part *part, const fg__plane *plane);

/* Traces a part on a plane that is cut at a meridian, or of degrees; on an azimuthal one.
 */
void fg__trace_flat(fg__tracer *tracer, const fg__coast_part *part);
void fg__trace_round(fg__tracer *tracer, const fg__coast_part *part);

#endif
