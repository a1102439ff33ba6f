/* A density at every other node: what an evolution on half as many cells goes on from. */
#ifndef FG__COARSENED_H
#define FG__COARSENED_H

#include "solver/multigrid.h"

typedef struct fg__coarsened {
  fg__partition partition; /* of the even nodes, as the finer mesh shared them out */
  float *values;           /* of this rank's block, x fastest */
} fg__coarsened;

/* Takes the means of `u`, an array of the finest level whose ghosts are filled, with the
 * weights (1/4, 1/2, 1/4) along each axis, times the nodes' masses: without a mask the
 * sum of the nodes' masses times u is conserved. NaN where no node round has mass. `fine`
 * is the partition of the finest level; along each axis its cells are even. Collective.
 * MEMORY. */
fg_status fg__coarsened_create(fg__coarsened *out, fg_context *context,
                               const fg__multigrid *multigrid, const fg__partition *fine,
                               const float *u);
void fg__coarsened_clear(fg__coarsened *coarsened);

/* Brings the values to the blocks of another partition of the same nodes: `out` takes
 * those of the own block, x fastest. Collective. MEMORY. */
fg_status fg__coarsened_deliver(const fg__coarsened *coarsened, fg_context *context,
                                const fg__partition *to, float *out);

/* Gives values to the nodes of a mask's coarser mesh that have mass and no finer node
 * with mass round them: the mean of their neighbours, from node to node, or `mean` where
 * no node near has a value. u and its ghosts are the finest level's. Collective. */
void fg__coarsened_fill_holes(const fg__multigrid *multigrid, double mean);

#endif
