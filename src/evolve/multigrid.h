/* The multigrid hierarchy and its cycle for the coupled (u, w) system of kernel.h. */
#ifndef FG__MULTIGRID_H
#define FG__MULTIGRID_H

#include "evolve/kernel.h"
#include "mesh/mesh.h"
#include "tensor/tensor.h"

enum { FG__MOST_LEVELS = 16 };

typedef struct fg__multigrid {
  const fg__kernel *kernel;
  fg__team *team;    /* NULL: one thread */
  int level_count;   /* level[0] is the finest */
  int shared_levels; /* large enough for the team; the others are left to one member */
  fg__level level[FG__MOST_LEVELS];
  int coarsest_sweeps;
} fg__multigrid;

/* Builds all levels over a tile, to be worked on by as many threads. MEMORY. */
fg_status fg__multigrid_create(fg__multigrid *out, fg_context *context,
                               const fg__mesh *mesh, const fg__tile *tile,
                               const fg__tensor *tensor, double gamma, int threads);
void fg__multigrid_clear(fg__multigrid *multigrid);

/* One V(1,1) cycle for the step tau, from and to u, w of the finest level, whose p holds
 * the right-hand side. Nonlinear (full approximation) on the finest level; the coarse
 * levels solve linear correction equations with the restricted curvature, at least 0.
 * To be called by every member of the multigrid's team. */
void fg__multigrid_cycle(const fg__multigrid *multigrid, double tau,
                         const fg__share *share);

#endif
