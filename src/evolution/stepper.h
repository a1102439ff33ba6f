/* Time steps of the density, and their step control. */
#ifndef FG__STEPPER_H
#define FG__STEPPER_H

#include "evolution/theta.h"
#include "solver/passes.h"
#include "solver/subdomain/mass.h"
#include "solver/subdomain/subdomains.h"

typedef struct fg__stepper {
  fg__multigrid multigrid;
  fg__theta theta;            /* its alpha 0: implicit */
  bool second_order;          /* backward differences over two steps, not one */
  double accuracy;            /* eta */
  int cycles;                 /* a step, or a substep of the theta scheme */
  double residual;            /* to which it is solved instead; 0: `cycles` are made */
  double cell_volume;         /* hx hy (hz), units of the longest side */
  double total_mass;          /* sum of the nodes' relative masses */
  double mean;                /* of u, conserved */
  fg__mass_constraint masses; /* of each subdomain */
  fg__subdomains subdomains;  /* those of few nodes; the theta scheme has none */
  double first_tau, most_tau;

  int64_t accepted, rejected, cycles_spent;
  double time, tau;     /* tau: the next step to try */
  double last_tau;      /* the last accepted one */
  double tau_limit;     /* lowered by a rejected attempt, relaxed by accepted steps */
  double energy, mass;  /* of the current u, units of the longest side */
  double chemical;      /* the double well's part of the energy */
  double increment;     /* rms of the last step's change */
  double persistence;   /* share of the last change that the predictor continues */
  double residual_left; /* the last attempt's, of its worst substep */
  bool solved;          /* the last attempt is, as far as is asked for */
  bool history;         /* `previous` is the density one step before `current` */
  int64_t quiet_steps;  /* steps in a row that are quiet (fg__stepper_stationary) */

  /* Arrays of the finest level. A step is computed in the level's own u, which then
   * becomes current: the three are passed round, never copied. */
  float *current, *previous, *first_iterate;
  float *scratch[2]; /* of residuals */
  void *memory;
} fg__stepper;

typedef struct fg__stepper_description {
  double cell_volume;         /* units of the longest side */
  double first_tau, most_tau; /* steps start with one and never exceed the other */
  double accuracy;
  int cycles;
  double residual;         /* over that of the first guess, below which a step is solved;
                              0: it takes the cycles that are given */
  bool second_order;       /* implicit: backward differences over two steps, not one */
  fg__splitting splitting; /* its alpha 0: implicit */
  bool coarser;            /* u is that of a finer mesh */
} fg__stepper_description;

/* Takes over a multigrid hierarchy (cleared with the stepper), for the theta scheme as
 * theta.h wants it; the density starts as what the finest u holds, with ghosts, and its
 * mean is kept. MEMORY. */
fg_status fg__stepper_create(fg__stepper *out, fg_context *context,
                             fg__multigrid *multigrid,
                             const fg__stepper_description *description);
void fg__stepper_clear(fg__stepper *stepper);

/* The means of `current`, in each of several subdomains, are those to be kept
 * (fg__mass_constraint_hold), also after a checkpoint's density was loaded. Collective.
 */
void fg__stepper_hold_means(fg__stepper *stepper);

/* One accepted step; `current` is the new density. Collective. NO_CONVERGENCE. */
fg_status fg__stepper_advance(fg__stepper *stepper, fg_context *context);

/* Many steps in a row changed almost nothing although time went on. */
bool fg__stepper_stationary(const fg__stepper *stepper);

#endif
