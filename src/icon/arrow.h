/* The shape of an arrow, and the arrow that looks best on a part of a streamline. */
#ifndef FG__ARROW_H
#define FG__ARROW_H

#include "icon/stations.h"

/* Proportions, in body widths, the same for all arrows, so that they read as one family;
 * taken by eye from pictures of winds and of analytic fields with 12 to 300 arrows. */
#define FG__HEAD_LENGTH 3.0
#define FG__HEAD_WIDTH 2.6
#define FG__TAIL_WIDTH 0.3

/* The head's base is swept back by this share of its length. */
#define FG__HEAD_SWEEP 0.12

/* An arc of at most 300 degrees: a gap shows where a ring begins and ends. */
#define FG__LARGEST_TURNING 5.236

/* The part of a streamline that an arrow takes, by arc length, and its body's width. */
typedef struct fg__arrow {
  double tail, tip;
  double width;   /* 0: no arrow fits */
  double turning; /* angle between its first and last tangent, radians */
  double unrest;  /* 1 for an even bend; more for corners, wiggles and hairpins */
} fg__arrow;

/* Finds the arrow on the streamline that is seen best, by its length and the root of its
 * width, and is calm; its outline lies in the room and does not meet itself. Shorter than
 * 3 or with a head narrower than 1.2 spacings gives width 0. MEMORY. */
fg_status fg__arrow_fit(fg__arrow *out, fg_context *context,
                        const fg__streamline *streamline, const fg__room *room,
                        fg__stations *stations);

/* No arrow on a line of this length is wider. */
double fg__arrow_widest(double length, double spacing);

/* The centreline from tail to tip, dense enough to be drawn as straight pieces and to
 * follow the flow within half a degree. *points is allocated: free it. MEMORY. */
fg_status fg__arrow_centerline(double (**points)[3], int *count, fg_context *context,
                               const fg__streamline *streamline, const fg__arrow *arrow,
                               double spacing);

#endif
