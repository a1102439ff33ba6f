/* Which blocks (partition.h) a mesh's ranks get. */
#ifndef FG__BLOCKS_H
#define FG__BLOCKS_H

#include "grid/ranks.h"

typedef struct fg__blocks {
  int count[3]; /* along each axis */
  int unit;     /* blocks begin at multiples of so many cells, a power of two */
} fg__blocks;

/* A block has so many cells at least along the axes that are divided: what a distributed
 * level of the multigrid needs (FG__LEAST_BLOCK_NODES). */
enum { FG__LEAST_BLOCK_CELLS = 4 };

/* Chooses blocks for a mesh of cells[], so that the rank with most to do has least: slabs
 * are faster than pencils of as many nodes; small units divide cells more evenly, large
 * ones leave a smaller coarse level that every rank computes whole. The same on all
 * ranks; not collective. There are as many blocks as ranks; where so many do not fit, as
 * many as do if the other ranks `may_idle`, else ARGUMENT. */
fg_status fg__blocks_choose(fg__blocks *out, fg_context *context, const fg__ranks *ranks,
                            int dimension, const int cells[3], bool may_idle);

#endif
