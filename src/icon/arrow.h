/* The shape of an arrow, and the arrow that fits a streamline's part inside a cluster. */
#ifndef FG__ARROW_H
#define FG__ARROW_H

#include "icon/streamline.h"

/* Proportions, in body widths, chosen by eye on some thousand arrows from 3 to 150 cells
 * long: the same for all of them, so that they read as one family. */
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
  double turning; /* largest angle between two of its tangents, radians */
  double wiggle;  /* angle turned to and fro beyond that, radians */
} fg__arrow;

/* Work arrays of fg__arrow_fit, to be kept between calls; all zero at first. */
typedef struct fg__arrow_station {
  double s, position[2], tangent[2], turning;
  double curvature, wiggle; /* wiggle: angle turned so far, to either side, radians */
  double body_limit, head_limit; /* largest half widths; negative: nothing fits */
} fg__arrow_station;

typedef struct fg__arrow_workspace {
  fg__arrow_station *station;
  size_t capacity;
  int count;
} fg__arrow_workspace;

/* No arrow on a line of this length is wider. */
double fg__arrow_widest(double length, double spacing);

/* The distance map at a point, bilinear; the nearest node's side outside the window. */
double fg__distance_at(const fg__window *window, const double *distance,
                       const double position[2]);

/* Finds the longest and widest arrow on the streamline whose whole outline lies in the
 * window's cluster and does not meet itself. `spacing` is that of the density, the
 * yardstick of margins and of readability: shorter than 3 or with a head narrower
 * than 1.2 spacings gives width 0. The outline needs no more than the free way to both
 * sides of the centreline, because it bends with it, head included. `distance` is the
 * window's distance map. MEMORY. */
fg_status fg__arrow_fit(fg__arrow *out, fg_context *context,
                        const fg__streamline *streamline, const fg__window *window,
                        const double *distance, double spacing,
                        fg__arrow_workspace *workspace);
void fg__arrow_workspace_clear(fg__arrow_workspace *workspace);

/* The centreline from tail to tip, dense enough to be drawn as straight pieces and to
 * follow the flow within half a degree. *points is allocated: free it. MEMORY. */
fg_status fg__arrow_centerline(double (**points)[3], int *count, fg_context *context,
                               const fg__streamline *streamline, const fg__arrow *arrow,
                               double spacing);

#endif
