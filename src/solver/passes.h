/* Passes over the finest level by all threads of a multigrid: the operations of
 * fg__kernel (kernel/kernel.h), whose sums are over all ranks. Arrays have the shape
 * fg__multigrid_shape. All ranks make the same calls. */
#ifndef FG__PASSES_H
#define FG__PASSES_H

#include "solver/multigrid.h"

/* fg__multigrid_solve. */
void fg__pass_solve(const fg__multigrid *multigrid, double tau, int cycles,
                    float *before);

/* w := Psi'(u) + K u; returns the energy, its chemical part and the sum of u. */
fg__sums fg__pass_evaluate(const fg__multigrid *multigrid, const float *u, float *w);

/* p := u - tau L w, without ghosts. */
void fg__pass_explicit_part(const fg__multigrid *multigrid, const float *u,
                            const float *w, double tau, float *p);

/* w := w - Psi'(u). */
void fg__pass_subtract_potential_derivative(const fg__multigrid *multigrid,
                                            const float *u, float *w);

fg__changes fg__pass_changes(const fg__multigrid *multigrid, const float *u,
                             const float *a, const float *b, const float *c);

/* Adds an amount to u wherever there is mass; elsewhere u becomes 0. */
void fg__pass_shift(const fg__multigrid *multigrid, float *u, double amount);

/* out := now + omega (now - before). */
void fg__pass_extrapolate(const fg__multigrid *multigrid, const float *now,
                          const float *before, double omega, float *out);

/* The same, but between the minima where now is between them. */
void fg__pass_predict(const fg__multigrid *multigrid, const float *now,
                      const float *before, double omega, float *out);

void fg__pass_fill_ghosts(const fg__multigrid *multigrid, float *u);
void fg__pass_copy(const fg__multigrid *multigrid, const float *from, float *to);

#endif
