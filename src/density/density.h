/* What a density holds: of a grid that ranks divide each rank has u, labels and mask of
 * its block; other nodes are gathered as regions. A process alone has one block. */
#ifndef FG__DENSITY_H
#define FG__DENSITY_H

#include "grid/exchange/regions.h"

typedef struct fg__density_block {
  fg__partition partition; /* of the grid's nodes */
  bool masked;             /* some cell of the grid is not active */
  float *u;                /* [the block's nodes] x fastest */
  int *label;              /* [the same] as components.h labels */
  unsigned char *active;   /* [cells whose lowest corners the block owns]; NULL unless
                              masked */
  int count, debris;       /* clusters of the grid and smaller ones, on every rank */
  double *area;            /* [count] in cells */
} fg__density_block;

const fg__density_block *fg__density_block_of(const fg_density *density);

/* The partition of a grid, and arrays for u, labels and mask of this rank's block.
 * MEMORY.
 */
fg_status fg__density_block_create(fg__density_block *out, fg_context *context,
                                   const fg__partition *partition, bool masked);
void fg__density_block_clear(fg__density_block *block);

/* Makes a density of a block, which it takes over: arrays.u and .active are not read.
 * MEMORY. */
fg_status fg__density_create(fg_density **out, fg_context *context,
                             const fg_density_arrays *arrays, fg__density_block *block);

typedef enum fg__density_kind {
  FG__DENSITY_U,     /* float a node */
  FG__DENSITY_LABEL, /* int a node */
  FG__DENSITY_ACTIVE /* a byte a cell, of which there is one less than nodes along a
                        natural axis */
} fg__density_kind;

/* Gives ranks their regions of the whole grid (regions.h). Collective. MEMORY. */
fg_status fg__density_fill(const fg_density *density, fg_context *context,
                           fg__density_kind kind, const fg__region *region, int count,
                           void *const out[]);

#endif
