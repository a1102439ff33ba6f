/* The multigrid hierarchy and its cycle for the coupled (u, w) system of kernel/kernel.h.
 */
#ifndef FG__MULTIGRID_H
#define FG__MULTIGRID_H

#include "grid/exchange/gather.h"
#include "solver/distributed.h"

enum { FG__MOST_LEVELS = 16 };

/* The levels from fine to coarse: distributed[0] ... distributed[distributed_count - 1]
 * are divided into blocks among several ranks; distributed[distributed_count] is the next
 * one in blocks, and level[0] the same replicated on every rank, which all ranks cycle on
 * alike. Of a process alone no level is distributed, and level[0] is the finest. */
typedef struct fg__multigrid {
  const fg__kernel *kernel;
  const fg__ranks *ranks;
  fg__partition partition; /* of the finest level's nodes */
  int distributed_count;
  fg__distributed distributed[FG__MOST_LEVELS];
  fg__gather *gather; /* between distributed[distributed_count] and level[0]; NULL: none
                         is distributed */

  fg__threads *threads; /* the caller's; NULL: one thread */
  int level_count;
  int threaded_levels; /* large enough for all threads; one thread has the others */
  fg__level level[FG__MOST_LEVELS];
  int coarsest_sweeps;
  bool linear; /* the finest level too */
} fg__multigrid;

/* A mesh of fewer nodes is left to one thread: beside other work several threads would
 * wait longer than they work (docs/design/evolution.md). */
extern const double fg__least_threaded_nodes;

/* Builds all levels over a mesh from the cells round this rank's block, which it takes
 * over. masked: some cell of the mesh is inactive, if not here. threads: will also work
 * on the levels of a process alone (borrowed; NULL: one thread). Collective. MEMORY. */
fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, fg__cells_of_box *cells, bool masked,
                               double gamma, fg__threads *threads);
void fg__multigrid_clear(fg__multigrid *multigrid);

/* The finest level, or this rank's block of it. */
const fg__level *fg__multigrid_finest(const fg__multigrid *multigrid);

/* Nodal arrays of the finest (depth 0) and the next level (depth 1). Arrays are handled
 * by the place of node (0, 0, 0), `first` floats behind their start. */
typedef struct fg__array_shape {
  size_t size;
  ptrdiff_t first;
} fg__array_shape;
fg__array_shape fg__multigrid_shape(const fg__multigrid *multigrid, int depth);

/* The finest level's own density, potential and right-hand side. */
float *fg__multigrid_u(const fg__multigrid *multigrid);
float *fg__multigrid_w(const fg__multigrid *multigrid);
float *fg__multigrid_p(const fg__multigrid *multigrid);

/* Makes another array the finest level's density; the caller owns the former one. */
void fg__multigrid_use(fg__multigrid *multigrid, float *u);

/* Arrays of the finest level's shape that replace the double well when the level is
 * linear. */
typedef struct fg__linear_terms {
  float *zeros, *ones; /* which hold nothing else */
  float *relaxation;   /* of its own */
} fg__linear_terms;

/* Makes the finest level linear too; NULL: nonlinear again. */
void fg__multigrid_linearise(fg__multigrid *multigrid, const fg__linear_terms *instead);

/* K of every level. */
typedef struct fg__energies {
  fg__stencil distributed[FG__MOST_LEVELS], level[FG__MOST_LEVELS];
} fg__energies;

/* Energies that are 0, of an array of zeros of the finest level's shape. */
fg__energies fg__multigrid_no_energies(float *zeros);

/* Gives the levels other energies, and takes theirs. */
void fg__multigrid_exchange_energies(fg__multigrid *multigrid, fg__energies *other);

/* Copies an array of the finest level, by all threads. */
void fg__multigrid_copy(const fg__multigrid *multigrid, const float *from, float *to,
                        const fg__thread *thread);

/* What the gradient part of the finest level's energies is multiplied by. */
void fg__multigrid_weigh_gradient(fg__multigrid *multigrid, double weight);

/* So many cycles for the step tau, from and to u, w of the finest level, whose p holds
 * the right-hand side; `before`, unless NULL, takes a copy of u before the last. The
 * finest level is nonlinear (full approximation) and smoothed after the correction only:
 * the sweep at the end of one cycle prepares the next. Coarse levels are linear, V(1,1),
 * in the space that is found in every cycle (solver/kernel/coarse_space.h). Called by
 * every thread of the multigrid. Collective. */
void fg__multigrid_solve(const fg__multigrid *multigrid, double tau, int cycles,
                         float *before, const fg__thread *thread);

#endif
