/* Where a level of an adaptive mesh ends and where a finer one begins.
 *
 * A level that does not cover the domain ends at nodes whose values are not its own: they
 * follow from the next coarser level by multilinear interpolation (hanging nodes, and
 * nodes that both levels have). Its boxes own them (closure.h), so kernels compute
 * something there as everywhere, with cells outside of weight 0; a border brings the
 * right values, and brings them back after a sweep. Ghosts beyond (those that
 * fg__exchange_uncovered lists) take part in nothing but products with 0: they must be
 * finite, and 0 in a residual that is restricted.
 *
 * What a box interpolates is found among the nodes and ghosts of its half, the box of
 * every other node: node i of a box is node i / 2 of its half.
 *
 *     fg__partition_coarsen(&half, context, &mesh->level[n]);
 *     fg__exchange_create_between(&coarse_values, context, &mesh->level[n + 1], &half,
 *                                 FG__NODES_AND_GHOSTS, 2);
 *
 * leaves no half's node or ghost uncovered, since level n + 1 covers level n and a ring
 * of a patch round it. */
#ifndef FG__REFINEMENT_H
#define FG__REFINEMENT_H

#include "mesh/exchange.h"
#include "mesh/mesh.h"

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

/* The value of a node by multilinear interpolation: the mean of the 1, 2, 4 or 8 nodes
 * round it on the next coarser level, summed along x, then y, then z. `half` points to
 * node (0, 0, 0) of the half, `node` are local indices of the box, at least 0. */
float fg__interpolated(const fg__layout *half_layout, const float *half,
                       const int node[3]);

/* The border of a level: nodes of own boxes with a cell outside beside them. */
typedef struct fg__border fg__border;

/* MEMORY. Not collective. */
fg_status fg__border_create(fg__border **out, fg_context *context, const fg__mesh *mesh,
                            int level, int most_arrays);
void fg__border_destroy(fg__border *border); /* NULL-safe */
long fg__border_count(const fg__border *border);

/* Gives the border nodes of `count` arrays the values interpolated from the halves'
 * arrays (half[a][b]: of own box b), and remembers them. */
void fg__border_interpolate(fg__border *border, int count, float *const *const half[],
                            float *const *const array[]);

/* Gives border nodes of the colours (exchange.h) the remembered values again. */
void fg__border_restore(const fg__border *border, int count, float *const *const array[],
                        unsigned colours);

#endif
