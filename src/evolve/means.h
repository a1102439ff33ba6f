/* The mean of u in each part of a domain, held. Coarse cells reach across the narrow
 * walls of a mask, so a cycle moves some mass through them; each part gets its own back.
 *
 * The parts are the components of a density that is 1 everywhere (components.h): number
 * them with fg__components_find, or box by box. Their masses and means then come from
 * rows of nodes, in any order:
 *   fg__means_create; fg__means_add_row for every row; [sum over ranks: `sum`, `mass`];
 *   fg__means_hold
 * and after each cycle or step
 *   fg__means_begin; fg__means_add_row for every row; [sum over ranks: `sum`];
 *   fg__means_settle; fg__means_shift_row for every row. */
#ifndef FG__MEANS_H
#define FG__MEANS_H

#include "base/context.h"

/* Sums are kept in whole steps of 2^-31, so that they depend on no order. */
typedef struct fg__means {
  int count;
  int64_t *mass; /* [count] sum of relative masses, in steps */
  int64_t *sum;  /* [count] of mass times u, in steps: what ranks add up */
  double *mean;  /* [count] held */
  float *shift;  /* [count] that restores the mean */
} fg__means;

/* Starts with nothing added; a count of 1 needs no such care. MEMORY. */
fg_status fg__means_create(fg__means *out, fg_context *context, int count);
void fg__means_clear(fg__means *means);

/* Takes what was added as the state whose means are held. */
void fg__means_hold(fg__means *means);

/* Forgets what was added to `sum`. */
void fg__means_begin(fg__means *means);

/* Adds `nodes` nodes of a row: part[n] counts from 1, 0 where there is none; mass[n] is
 * the node's relative mass, at most 8. `weigh` adds up the parts' masses as well. */
void fg__means_add_row(fg__means *means, const int *part, const float *mass,
                       const float *u, int nodes, bool weigh);

/* Finds each part's shift from `sum`. */
void fg__means_settle(fg__means *means);

/* Adds to u[n] the shift of its part. */
void fg__means_shift_row(const fg__means *means, const int *part, float *u, int nodes);

#endif
