/* Forests of quadtrees (p4est) and octrees (p8est), from one source: forest_body.h is
 * compiled once for each. The trees form a brick. Nothing but src/mesh knows of p4est. */
#ifndef FG__FOREST_H
#define FG__FOREST_H

#include "mesh/ranks.h"

/* A leaf of a tree, in units of the deepest leaves: it reaches from first to first + side
 * along each axis; along z from 0 to 1 in 2D. */
typedef struct fg__leaf {
  int first[3];
  int side; /* 2^level */
} fg__leaf;

typedef struct fg__forest fg__forest;

/* The functions of one dimension. */
typedef struct fg__forest_kind {
  /* A brick of trees, trees[k] along axis k, closed on itself where periodic, each
   * refined `depth` times all over, which is the most there will ever be; leaves are
   * shared out in Morton order, equally (with `adaptive` so that sisters, which could be
   * coarsened, stay together). Collective. MEMORY. */
  fg_status (*create)(fg__forest **out, fg_context *context, const fg__ranks *ranks,
                      const int trees[3], const bool periodic[3], int depth,
                      bool adaptive);

  /* Another forest, refined where wanted[l], a level, is finer than this rank's leaf l,
   * and coarsened by one level where all sisters want that; then balanced, so that leaves
   * that touch, be it at a corner, differ by one level at most, and shared out anew. A
   * level is what remains of the depth: 0 is the finest, and a leaf's side 2^level. The
   * leaves do not depend on how many ranks there are. Collective. MEMORY. */
  fg_status (*adapt)(fg__forest **out, fg_context *context, const fg__forest *forest,
                     const signed char *wanted);
  void (*destroy)(fg__forest *forest); /* NULL-safe */

  /* Leaves of this rank. */
  int (*leaf_count)(const fg__forest *forest);

  /* Writes them, in Morton order. */
  void (*leaves)(const fg__forest *forest, fg__leaf *out);
} fg__forest_kind;

extern const fg__forest_kind fg__forest_2d, fg__forest_3d;

#endif
