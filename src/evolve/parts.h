/* The parts of a domain that a mask separates: each keeps its own mass. */
#ifndef FG__PARTS_H
#define FG__PARTS_H

#include "evolve/level.h"

/* Two nodes are of one part when a chain of active cells joins them. */
typedef struct fg__parts {
  int count;    /* 1 without a mask, or when it separates nothing */
  int *of_node; /* [nodes], x fastest: 0 ... count - 1, -1 where there is no
                   mass; NULL when count is 1 */
  double *mass; /* [count] sum of relative masses */
  double *mean; /* [count] of u, held */
  double *sum;  /* [count] working space */
} fg__parts;

/* Finds the parts of a level and the mean of u in each. MEMORY. */
fg_status fg__parts_create(fg__parts *out, fg_context *context, const fg__level *level,
                           const float *u);
void fg__parts_clear(fg__parts *parts);

/* Shifts u in each part so that its mean is again what it was. Coarse cells reach across
 * narrow walls, so a cycle alone moves some mass through them. */
void fg__parts_restore_means(const fg__parts *parts, const fg__level *level, float *u);

#endif
