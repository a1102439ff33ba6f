/* The residual of a step's nonlinear system, which the reference mode iterates on. */
#ifndef FG__RESIDUAL_H
#define FG__RESIDUAL_H

#include "solver/subdomain/subdomains.h"

/* The largest of p - u - tau L (Psi'(u) + K u) over the nodes, without those that the
 * subdomains have solved; of a linear level without Psi'. `w` and `rest` are overwritten.
 * Infinite where some value is not a number. Collective. */
double fg__residual(const fg__multigrid *multigrid, const fg__subdomains *subdomains,
                    double tau, float *w, float *rest);

#endif
