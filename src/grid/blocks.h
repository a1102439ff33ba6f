/* Which blocks (partition.h) a mesh's ranks get. */
#ifndef FG__BLOCKS_H
#define FG__BLOCKS_H

#include "grid/ranks.h"

typedef struct fg__blocks {
  int count[3]; /* along each axis; in 3D as near to a square as can be */
  int unit;     /* blocks begin at multiples of so many cells, a power of two */
} fg__blocks;

/* A block has so many cells at least along the axes that are divided: what a distributed
 * level of the multigrid needs (FG__LEAST_BLOCK_NODES). */
enum { FG__LEAST_BLOCK_CELLS = 4 };

/* Chooses blocks for a mesh of cells[], so that the rank with most to do has least: small
 * units deal the cells out more evenly, large ones leave a coarser level that every rank
 * computes whole. The same on all ranks; not
 * collective. ARGUMENT (there are more ranks than blocks of the least thickness). */
fg_status fg__blocks_choose(fg__blocks *out, fg_context *context, const fg__ranks *ranks,
                            int dimension, const int cells[3]);

#endif
