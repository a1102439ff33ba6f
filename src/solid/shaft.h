/* The part of a streamline that a solid arrow takes, and how thick it is. */
#ifndef FG__SHAFT_H
#define FG__SHAFT_H

#include "solid/path.h"

/* Proportions, in widths of the body where the head begins: by eye, from rendered arrows;
 * a cone looks larger than a triangle, so that they are less than in 2D. */
#define FG__SOLID_HEAD_LENGTH 2.6
#define FG__SOLID_HEAD_WIDTH 2.3
#define FG__SOLID_TAIL_WIDTH 0.35

/* An arc of at most 300 degrees: a gap shows where a ring begins and ends. */
#define FG__SOLID_TURNING 5.236

typedef struct fg__shaft {
  double tail, tip; /* by arc length */
  double width;     /* of the body where the head begins; 0: no arrow fits */
  double turning;   /* angles along it added up, radians */
} fg__shaft;

/* What an arrow may be like. */
typedef struct fg__solid_room {
  const fg__volume *volume;
  const double *distance; /* of its nodes, to the border */
  double spacing;         /* of the density: the yardstick of readability */
} fg__solid_room;

/* A path at even steps; all zero at first, to be used again and again. */
typedef struct fg__shaft_stations {
  struct fg__shaft_station *station;
  size_t capacity;
  int count;
  double step;
} fg__shaft_stations;

/* Finds the arrow that is seen best: length times width to the power of 0.4. At each of
 * its points the ball of the arrow's radius lies in the cluster, the radius is below that
 * of the curve, its head is nearly straight, and no part of it comes near another.
 * Shorter than 3 or with a head narrower than 1.2 spacings gives width 0. MEMORY. */
fg_status fg__shaft_fit(fg__shaft *out, fg_context *context, const fg__path *path,
                        const fg__solid_room *room, fg__shaft_stations *stations);
void fg__shaft_stations_clear(fg__shaft_stations *stations);

/* No arrow on a path of this length is wider. */
double fg__shaft_widest(double length);

#endif
