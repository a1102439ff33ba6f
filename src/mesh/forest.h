/* Forests of quadtrees (p4est) and octrees (p8est), from one source: forest_body.h is
 * compiled once for each. Nothing but src/mesh knows of p4est. */
#ifndef FG__FOREST_H
#define FG__FOREST_H

#include "mesh/ranks.h"

/* A leaf of a tree, in units of leaves; 0 along z in 2D. */
typedef struct fg__leaf {
  int first[3];
} fg__leaf;

/* Lays a brick of trees, trees[k] along axis k, closed on itself where periodic, each
 * refined `depth` times all over, shares the leaves out in Morton order, equally, and
 * writes this rank's, in that order; to be freed by the caller. Collective. MEMORY. */
fg_status fg__forest_leaves_2d(fg__leaf **out, int *count, fg_context *context,
                               const fg__ranks *ranks, const int trees[3],
                               const bool periodic[3], int depth);
fg_status fg__forest_leaves_3d(fg__leaf **out, int *count, fg_context *context,
                               const fg__ranks *ranks, const int trees[3],
                               const bool periodic[3], int depth);

#endif
