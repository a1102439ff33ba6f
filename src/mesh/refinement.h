/* Where a level of an adaptive mesh ends and where a finer one begins.
 *
 * A level that does not cover the domain ends at nodes whose values are not its own: they
 * follow from the next coarser level by multilinear interpolation (hanging nodes, and
 * nodes that both levels have). Its boxes own some of these nodes, those at their lower
 * sides; others are ghosts without an owner (fg__exchange_uncovered). What a box has to
 * interpolate is found among the nodes and ghosts of the box of half as many nodes:
 *
 *     fg__partition_coarsen(&half, context, &mesh->level[n]);
 *     fg__exchange_create_between(&coarse_values, context, &mesh->level[n + 1], &half,
 *                                 FG__NODES_AND_GHOSTS, 2);
 *
 * has no uncovered nodes, since level n + 1 covers level n and a ring round it; node i of
 * a box is at node i / 2 of its half. */
#ifndef FG__REFINEMENT_H
#define FG__REFINEMENT_H

#include "mesh/exchange.h"
#include "mesh/mesh.h"

/* Nodes on the border of the level that own boxes own, given the level's ghosts without
 * an owner: nodes with a cell beside them that the level does not cover. Disjoint bricks
 * in local indices, to be freed by the caller. MEMORY. */
fg_status fg__border_nodes(fg__uncovered **out, int *count, fg_context *context,
                           const fg__partition *level, const fg__uncovered *uncovered,
                           int uncovered_count);

typedef enum fg__cell_kind {
  FG__CELL_OUTSIDE = 0, /* the level does not cover it */
  FG__CELL_LEAF,        /* of a leaf of this level */
  FG__CELL_REFINED      /* the next finer level covers it as well */
} fg__cell_kind;

/* Kinds of the cells round the nodes of a box of a level (of any rank): cells -1 ...
 * nodes - 1 along each axis (0 along z in 2D), x fastest, so nodes + 1 (1) of them. Cells
 * beyond the domain's natural borders are mirror images, beyond periodic ones the other
 * end's. */
void fg__cell_kinds(unsigned char *out, const fg__mesh *mesh, int level,
                    const fg__box *box);

#endif
