/* The shape of an arrow, and the arrow that looks best on a part of a streamline. */
#ifndef FG__ARROW_H
#define FG__ARROW_H

#include "icon/arc_samples.h"

/* Proportions, in body widths, the same for all arrows, so that they read as one family;
 * taken by eye from pictures of winds and of analytic fields with 12 to 300 arrows. */
#define FG__HEAD_LENGTH 3.0
#define FG__HEAD_WIDTH 2.6
#define FG__TAIL_WIDTH 0.3

/* The same in 3D, by eye from rendered arrows: a cone looks larger than a triangle. */
#define FG__SOLID_HEAD_LENGTH 2.6
#define FG__SOLID_HEAD_WIDTH 2.3
#define FG__SOLID_TAIL_WIDTH 0.35

/* In 2D the head's base is swept back by this share of its length. */
#define FG__HEAD_SWEEP 0.12

/* An arc of at most 300 degrees: a gap shows where a ring begins and ends. */
#define FG__LARGEST_TURNING 5.236

/* An arrow is seen as length times width to this power: its area grows with both, but its
 * length is what shows the flow. */
#define FG__WIDTH_EXPONENT 0.4

/* The part of a streamline that an arrow takes, by arc length, and its body's width. */
typedef struct fg__arrow {
  double tail, tip;
  double width;   /* where the head begins; 0: no arrow fits */
  double turning; /* from tail to tip (fg__streamline_node), radians, not negative */
  double bending; /* penalty in 2D: 1 for an even bend; more for corners, wiggles and
                     hairpins */
} fg__arrow;

/* Finds the arrow on the streamline that is seen best. Shorter than 3 or with a head
 * narrower than 1.2 spacings gives width 0. In 2D it bends evenly, and its outline lies
 * in the interior and does not meet itself. In 3D the ball of the arrow's radius lies in
 * the cluster at each of its points, the radius is below that of the curve, its head is
 * nearly straight, and no part of it comes near another. MEMORY. */
fg_status fg__arrow_fit(fg__arrow *out, fg_context *context,
                        const fg__streamline *streamline, const fg__interior *interior,
                        fg__arc_samples *samples);

/* No arrow on a line of this length is wider. */
double fg__arrow_widest(double length, const fg__interior *interior);

/* The centreline from tail to tip, dense enough to be drawn as straight pieces: in 2D it
 * follows the flow within half a degree, in 3D its pieces are even, no longer than
 * `spacing`, and share the turning at 5 degrees each at most. *points is allocated: free
 * it. MEMORY. */
fg_status fg__arrow_centerline(double (**points)[3], int *count, fg_context *context,
                               const fg__streamline *streamline, const fg__arrow *arrow,
                               double spacing);

/* arrow_solid.c: what these do in 3D. */
fg_status fg__arrow_fit_solid(fg__arrow *out, fg_context *context,
                              const fg__streamline *streamline,
                              const fg__interior *interior, fg__arc_samples *samples);
double fg__arrow_widest_solid(double length);
fg_status fg__arrow_centerline_solid(double (**points)[3], int *count,
                                     fg_context *context,
                                     const fg__streamline *streamline,
                                     const fg__arrow *arrow, double spacing);

#endif
