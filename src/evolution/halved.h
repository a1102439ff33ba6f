/* A density at every other node: what an evolution on half as many cells goes on from. */
#ifndef FG__HALVED_H
#define FG__HALVED_H

#include "solver/multigrid.h"

typedef struct fg__halved {
  fg__partition partition; /* of the even nodes, as the finer mesh shared them out */
  float *values;           /* of this rank's block, x fastest */
} fg__halved;

/* Takes the means of `u`, an array of the finest level whose ghosts are filled, with the
 * weights (1/4, 1/2, 1/4) along each axis: without a mask the sum of the nodes' masses
 * times u stays what it is. `fine` shares out the finest level; along each axis its cells
 * are even. Collective. MEMORY. */
fg_status fg__halved_create(fg__halved *out, fg_context *context,
                            const fg__multigrid *multigrid, const fg__partition *fine,
                            const float *u);
void fg__halved_clear(fg__halved *halved);

/* Brings the values to the blocks of another partition of the same nodes: `out` takes
 * those of the own block, x fastest. Collective. MEMORY. */
fg_status fg__halved_deliver(const fg__halved *halved, fg_context *context,
                             const fg__partition *to, float *out);

#endif
