/* The inner loops of the evolution, on the arrays of a level. solver/kernel/body.h is
 * their one source; it is compiled for two and three dimensions and once for each vector
 * width, and fg__kernel_choose takes the widest that the machine has. Neither widths nor
 * threads change a bit of the results: every node's arithmetic is the same, a sweep keeps
 * its order of colours, products and sums are not fused, and sums over nodes are exact.
 */
#ifndef FG__KERNEL_H
#define FG__KERNEL_H

#include "solver/level.h"

/* The system of one time step, rows divided by the mass (docs/method/README.md):
 *     u + tau L w = p,      w - Psi'(u) - K u = q,
 * L the Laplacian, K = gamma L_A, Psi'(u) = 2 u (u^2 - 1); q = 0 on the finest level.
 * Coarse levels correct it: u += d P v, w += P w, P multilinear and d the shape of a
 * moving interface (solver/kernel/coarse_space.h); changes of u that lead past a minimum
 * are bounded (solver/kernel/stencil.h). In scale * v, written u there, their system has
 * the mass m, the coupling: m u + tau L w = p and m w - (curvature + K) u = q. */

/* The number of quantities that are restricted: the residuals of both equations, the
 * second times d; d; and d J d, J = Psi''(u). */
enum { FG__RESTRICTED = 4 };

/* Sums over nodes, m the relative mass: u after a step, a before it, b before the step's
 * last cycle, c before the step before. */
typedef struct fg__changes {
  double u;          /* m u */
  double change;     /* m (u - a)^2 */
  double correction; /* m (u - b)^2 */
  double product;    /* m (u - a) (a - c) */
} fg__changes;

typedef struct fg__sums {
  double energy; /* m (Psi(u) + u K u / 2), the last times the level's gradient_weight */
  double u;      /* m u */
  double chemical; /* m Psi(u) */
} fg__sums;

/* Every operation is called by all threads, each with its slices, and returns when all
 * are done with their parts; sums are those of the thread's part. */
typedef struct fg__kernel {
  const char *name;
  int dimension;
  /* One collective Gauss-Seidel sweep by colours, a local Newton step for (u, w) at each
   * node. Even planes come before odd ones, in a plane even rows before odd ones, in a
   * row even columns before odd ones. */
  void (*smooth)(const fg__level *level, float tau, const fg__thread *thread);
  void (*smooth_linear)(const fg__level *level, float tau, const fg__thread *thread);
  /* Restricts these quantities to a coarse level's p, q, coupling and shape_curvature;
   * its u and w become 0. find_scale and find_curvature then make the level's system of
   * these. The linear one sweeps first. */
  void (*restrict_residuals)(const fg__level *fine, const fg__level *coarse, float tau,
                             const fg__thread *thread);
  void (*smooth_restrict_linear)(const fg__level *fine, const fg__level *coarse,
                                 float tau, const fg__thread *thread);
  void (*find_scale)(const fg__level *coarse, const fg__thread *thread);
  void (*find_curvature)(const fg__level *coarse, float tau, const fg__thread *thread);
  /* The relaxation that a linear level's sweeps need; find_curvature does it too. */
  void (*find_relaxation)(const fg__level *level, float tau, const fg__thread *thread);
  /* From scale * v to v, ghosts and all: a coarse level's u, before it corrects. */
  void (*unscale)(const fg__level *coarse, const fg__thread *thread);
  /* Adds the coarse level's corrections to the fine u, w; then a sweep; then, where it is
   * named so, the restriction for the next cycle. */
  void (*correct_smooth)(const fg__level *coarse, const fg__level *fine, float tau,
                         const fg__thread *thread);
  void (*correct_smooth_linear)(const fg__level *coarse, const fg__level *fine, float tau,
                                const fg__thread *thread);
  void (*correct_smooth_restrict)(const fg__level *coarse, const fg__level *fine,
                                  float tau, const fg__thread *thread);
  /* w := Psi'(u) + K u, with ghosts, and the energy of u in the same pass. */
  fg__sums (*evaluate)(const fg__level *level, const float *u, float *w,
                       const fg__thread *thread);
  /* p := u - tau L w, without ghosts. */
  void (*explicit_part)(const fg__level *level, const float *u, const float *w, float tau,
                        float *p, const fg__thread *thread);
  /* Subtracts Psi'(u) from w, whole arrays. */
  void (*subtract_potential_derivative)(const fg__level *level, const float *u, float *w,
                                        const fg__thread *thread);
  fg__changes (*changes)(const fg__level *level, const float *u, const float *a,
                         const float *b, const float *c, const fg__thread *thread);
  /* out := now + omega (now - before), whole arrays. */
  void (*extrapolate)(const fg__level *level, const float *now, const float *before,
                      float omega, float *out, const fg__thread *thread);
  /* The same, but between the minima where now is between them. */
  void (*predict)(const fg__level *level, const float *now, const float *before,
                  float omega, float *out, const fg__thread *thread);
  /* Adds an amount to u wherever there is mass; elsewhere u becomes 0. */
  void (*shift)(const fg__level *level, float *u, float amount, const fg__thread *thread);

  /* The same operations for pencils, in parts between which ghosts are exchanged, by one
   * thread. Rows of one parity (1 odd row + 2 odd plane) of a sweep: none is the
   * neighbour of another. */
  void (*smooth_rows_of)(const fg__level *level, float tau, bool linear, int rows);
  /* The quantities to be restricted; their restriction, once their ghosts are filled. */
  void (*find_residuals)(const fg__level *level, float tau, bool linear,
                         float *const out[FG__RESTRICTED]);
  void (*restrict_arrays)(const fg__level *fine, const float *const from[FG__RESTRICTED],
                          const fg__level *coarse);
  /* Adds the coarse level's corrections. */
  void (*correct)(const fg__level *coarse, const fg__level *fine, bool linear);
} fg__kernel;

extern const fg__kernel fg__kernel_2d_generic, fg__kernel_3d_generic;
#if defined(__x86_64__)
extern const fg__kernel fg__kernel_2d_avx2, fg__kernel_2d_avx512;
extern const fg__kernel fg__kernel_3d_avx2, fg__kernel_3d_avx512;
#endif

/* The fastest kernel that runs here, of vectors no wider than `most`. */
const fg__kernel *fg__kernel_choose(int dimension, fg_vectors most);

#endif
