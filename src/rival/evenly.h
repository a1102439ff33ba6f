/* Evenly spaced streamlines, after Jobard and Lefer, "Creating Evenly-Spaced Streamlines
 * of Arbitrary Density", Visualization in Scientific Computing 1997. */
#ifndef FG__RIVAL_EVENLY_H
#define FG__RIVAL_EVENLY_H

#include "icon/streamline.h"
#include "rival/domain.h"

/* d_test in separations: how near a line may come to others while it goes on. */
#define FG__EVENLY_TEST 0.5

/* Shorter lines, in separations, are specks. */
#define FG__EVENLY_SHORTEST 1.0

/* The part of the streamline through a seed between two arc lengths from there. */
typedef struct fg__evenly_line {
  double seed[2];
  double from, to; /* from <= 0 <= to */
} fg__evenly_line;

typedef struct fg__evenly {
  double separation; /* d_sep, input coordinates */
  fg__evenly_line *line;
  size_t capacity;
  int count;
} fg__evenly;

/* Places lines, in the order in which they are found: every seed is at least a separation
 * from all lines before it, every line stays d_test away from those and from itself. All
 * zero at first, or one to use again. MEMORY, STOPPED. */
fg_status fg__evenly_place(fg__evenly *out, fg_context *context, const fg__domain *domain,
                           double separation);
void fg__evenly_clear(fg__evenly *evenly);

/* Finds a separation that gives about `count` lines, and places them. As above. */
fg_status fg__evenly_search(fg__evenly *out, fg_context *context,
                            const fg__domain *domain, int count);

/* The streamline that a line is part of, as far as `reach` either way from the seed and
 * one step more; arc length is 0 at its upstream end, *at_seed at the seed. MEMORY. */
fg_status fg__evenly_trace(fg__streamline *out, fg_context *context,
                           const fg__domain *domain, const double seed[2], double reach,
                           double *at_seed);

#endif
