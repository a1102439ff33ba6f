/* A density that several ranks share: each has u, labels and mask of its block, and
 * whoever needs more asks for a region. */
#ifndef FG__DENSITY_SHARE_H
#define FG__DENSITY_SHARE_H

#include "grid/exchange/regions.h"
#include "solver/spread_clusters.h"

typedef struct fg__density_share {
  fg__partition partition; /* of the whole grid's nodes */
  fg__spread_clusters own; /* u, labels (in `number`) and mask; `whole` says the same
                              on every rank */
  bool masked;             /* some cell of the grid is not active */
} fg__density_share;

typedef enum fg__share_kind {
  FG__SHARE_U,     /* float a node */
  FG__SHARE_LABEL, /* int a node, as component/components.h labels */
  FG__SHARE_ACTIVE /* a byte a cell, of which there is one less than nodes along a natural
                      axis */
} fg__share_kind;

/* Copies u, a level's array whose ghosts are filled, and labels its clusters; `scratch`
 * is another array of that level. Sizes as fg_density_arrays has them. Collective.
 * MEMORY. */
fg_status fg__density_share_create(fg__density_share **out, fg_context *context,
                                   const fg__spread *finest, const float *u,
                                   float *scratch, double debris_cells, bool masked);
void fg__density_share_destroy(fg__density_share *share); /* NULL-safe */

/* Gives ranks their regions of the whole grid (grid/exchange/regions.h). Collective.
 * MEMORY. */
fg_status fg__density_share_fill(fg__density_share *share, fg_context *context,
                                 fg__share_kind kind, const fg__region *region, int count,
                                 void *const out[]);

/* The share of a density, or NULL: this rank has it whole. */
fg__density_share *fg__density_share_of(const fg_density *density);

/* Makes a density of a share, which it takes over: arrays.u and .active are not read.
 * MEMORY. */
fg_status fg__density_create_shared(fg_density **out, fg_context *context,
                                    const fg_density_arrays *arrays,
                                    fg__density_share *share);

#endif
