/* Keeps the mean of u in each subdomain, because sweeps do not conserve it. Where one
 * coarse node stands for a subdomain, a correction would put the missing mass where u is
 * between the minima.
 *
 * Subdomains are the components of a density that is 1 everywhere
 * (component/components.h): two nodes are of one subdomain when a chain of active cells
 * joins them, whoever owns them. Sums are exact (level.h), so that the means are the same
 * bits on any ranks. */
#ifndef FG__MASS_H
#define FG__MASS_H

#include "solver/multigrid.h"

/* Nodes of one subdomain that follow each other in memory: even, or odd, columns of a
 * row. */
typedef struct fg__subdomain_run {
  ptrdiff_t at; /* of the first, in arrays of the finest level */
  int nodes;
  int subdomain; /* from 0 */
  float row_mass;
  const float *column_mass, *mass; /* of the first node */
} fg__subdomain_run;

typedef struct fg__mass_constraint {
  int count; /* subdomains; at most 1: only the mean of all is held */
  int run_count;
  fg__subdomain_run *run; /* [run_count] the nodes of this rank's block, by subdomains */
  double *mass;           /* [count] sums of relative masses */
  double *mean;           /* [count] of u, held */
  double *sum;            /* [count] working space, like units */
  uint64_t *units;
  double rounding; /* of the sums */
} fg__mass_constraint;

/* Finds the subdomains of the finest level and the mean of u, an array of it, in each.
 * Collective. MEMORY, ARGUMENT (a block too large for int labels). */
fg_status fg__mass_constraint_create(fg__mass_constraint *out, fg_context *context,
                                     const fg__multigrid *multigrid, const float *u);
void fg__mass_constraint_clear(fg__mass_constraint *masses);

/* Of several subdomains the means of u, rounded to multiples of 2^-20, are those to be
 * kept: a u in which they were restored, as a checkpoint has it, gives the same means
 * again. Returns the mean of all. Collective. */
double fg__mass_constraint_hold(fg__mass_constraint *masses,
                                const fg__multigrid *multigrid, const float *u);

/* Clamps the means to be kept to two bounds; whether any lay beyond. */
bool fg__mass_constraint_bound(fg__mass_constraint *masses, double low, double high);

/* Shifts u in each subdomain so that its mean is again what it was, ghosts included.
 * Collective. */
void fg__mass_constraint_restore(const fg__mass_constraint *masses,
                                 const fg__multigrid *multigrid, float *u);

#endif
