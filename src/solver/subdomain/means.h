/* The mean of u in each part of a domain, held: sweeps do not keep it, and on a coarse
 * level whose one node stands for a part all that is missing would be put where the
 * density is between the wells.
 *
 * The parts are the components of a density that is 1 everywhere
 * (component/components.h): two nodes are of one part when a chain of active cells joins
 * them, whoever owns them. Sums are exact (level.h), so that the means are the same bits
 * on any ranks. */
#ifndef FG__MEANS_H
#define FG__MEANS_H

#include "solver/multigrid.h"

/* Nodes of one part that follow each other in memory: even, or odd, columns of a row. */
typedef struct fg__part_run {
  ptrdiff_t at; /* of the first, in arrays of the finest level */
  int nodes;
  int part; /* from 0 */
  float row_mass;
  const float *column_mass, *mass; /* of the first node */
} fg__part_run;

typedef struct fg__means {
  int count; /* parts; at most 1: no more than the mean of all is to be held */
  int run_count;
  fg__part_run *run; /* [run_count] the nodes of this rank's block, by parts */
  double *mass;      /* [count] sums of relative masses */
  double *mean;      /* [count] of u, held */
  double *sum;       /* [count] working space, like units */
  uint64_t *units;
  double rounding; /* of the sums */
} fg__means;

/* Finds the parts of the finest level and the mean of u, an array of it, in each.
 * Collective. MEMORY, ARGUMENT (a block too large for int labels). */
fg_status fg__means_create(fg__means *out, fg_context *context,
                           const fg__multigrid *multigrid, const float *u);
void fg__means_clear(fg__means *means);

/* Changes the means that are to be held to ones between two bounds; whether any was not.
 */
bool fg__means_bound(fg__means *means, double low, double high);

/* Shifts u in each part so that its mean is again what it was, ghosts included.
 * Collective. */
void fg__means_restore(const fg__means *means, const fg__multigrid *multigrid, float *u);

#endif
