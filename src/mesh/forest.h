/* Forests of quadtrees (p4est) and octrees (p8est), from one source: forest_body.h is
 * compiled once for each. The trees form a brick. Nothing but src/mesh knows of p4est. */
#ifndef FG__FOREST_H
#define FG__FOREST_H

#include "mesh/ranks.h"

/* A leaf of a tree, in units of the deepest leaves: it reaches from first to first + side
 * along each axis; along z from 0 to 1 in 2D. */
typedef struct fg__leaf {
  int first[3];
  int side; /* 2^(depth - refinement) */
} fg__leaf;

typedef struct fg__forest fg__forest;

/* The functions of one dimension. */
typedef struct fg__forest_kind {
  /* A brick of trees, trees[k] along axis k, closed on itself where periodic, each
   * refined `refinements` times all over; leaves are shared out in Morton order, equally.
   * depth is the most refinements there will ever be. Collective. MEMORY. */
  fg_status (*create)(fg__forest **out, fg_context *context, const fg__ranks *ranks,
                      const int trees[3], const bool periodic[3], int refinements,
                      int depth);
  void (*destroy)(fg__forest *forest); /* NULL-safe */

  /* Leaves of this rank. */
  int (*leaf_count)(const fg__forest *forest);

  /* Writes them, in Morton order. */
  void (*leaves)(const fg__forest *forest, fg__leaf *out);
} fg__forest_kind;

extern const fg__forest_kind fg__forest_2d, fg__forest_3d;

#endif
