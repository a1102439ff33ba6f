/* The theta-splitting of Garcke et al. (2000), appendix, after Bristeau, Glowinski and
 * Periaux (1987). A step tau is three substeps of theta, 1 - 2 theta and theta of it. Of
 * the rate -L (K u + Psi'(u)) the first and last take alpha K implicitly, the middle one
 * the rest, which is beta K and Psi', beta = 1 - alpha; each takes the other part
 * explicitly, from the state before it. See docs/method/schemes.md.
 *
 * The multigrid has to be one for beta gamma in place of gamma: its K is the beta K of
 * the middle substep, and alpha K is a multiple of it. With beta = 0 it is one for gamma,
 * whose K is taken away where the scheme needs beta K. */
#ifndef FG__THETA_H
#define FG__THETA_H

#include "solver/passes.h"

enum { FG__THETA_SUBSTEPS = 3 };

typedef struct fg__splitting {
  double theta; /* in (0, 1/2) */
  double alpha; /* in (1/2, 1]; 0: no splitting */
} fg__splitting;

/* theta = 1 - 1 / sqrt 2, the only value of second order for every alpha; alpha = 2 -
 * sqrt 2, which gives all substeps the same alpha theta = beta (1 - 2 theta). */
extern const fg__splitting fg__theta_default;

/* The share of gamma that the multigrid has: beta; 1 where that is 0 and where there is
 * no splitting. */
double fg__theta_held(fg__splitting splitting);

/* The longest step in which linear theory lets no ripple grow in the separated phases
 * (docs/method/schemes.md), to 0.1 %: for all waves whose eigenvalue of L is at most
 * `stiffest`, 4 / h^2 on a mesh, and whose K is that times an interface energy gamma
 * from `least` to `most`. */
double fg__theta_stable_step(fg__splitting splitting, double least, double most,
                             double stiffest);

typedef struct fg__theta {
  fg__splitting splitting;
  fg__linear_terms instead; /* in the linear substeps */
  fg__energies none; /* in place of the multigrid's; while they are taken away: K */
  void *memory;
} fg__theta;

/* For a multigrid of fg__theta_held times gamma, whose energies become those of gamma.
 * Collective. MEMORY. */
fg_status fg__theta_create(fg__theta *out, fg_context *context, fg__multigrid *multigrid,
                           fg__splitting splitting);
void fg__theta_clear(fg__theta *theta);

/* Right-hand side and first guess of a substep, 0 to 2, of a step from the density
 * `start`; then cycles for the returned tau solve it. The finest level's u holds the
 * first substep's guess, and then, with w, what the substep before has left. */
double fg__theta_prepare(fg__theta *theta, fg__multigrid *multigrid, int substep,
                         double tau, const float *start);

/* The share of the step that a substep takes. */
double fg__theta_share(fg__splitting splitting, int substep);

#endif
