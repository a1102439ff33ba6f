/* How ranks share the nodes of one level: a block of nodes each, which together divide
 * the outer axes: slabs in 2D (along y), slabs (along z) or pencils (along y and z) in
 * 3D. A row along x is never cut. Every rank knows the blocks of all: 24 bytes a rank and
 * level.
 *
 * Ranks are numbered as MPI numbers those of a Cartesian topology whose axes are z and y:
 * neighbours along y follow each other. Where there are more ranks than blocks, the last
 * ones are idle: their blocks are empty and have no neighbours.
 *
 * Levels coarsen by halving: node i of a level is node 2 i of the finer one, and a rank
 * owns on the coarser level what it owns of these nodes on the finer. Where that leaves
 * blocks too thin, or not aligned, the level is replicated: every rank holds it whole,
 * and all compute the same (bit for bit). The distributed partition of that level still
 * serves to bring values there and back (exchange/gather.h). */
#ifndef FG__PARTITION_H
#define FG__PARTITION_H

#include "grid/box.h"
#include "grid/ranks.h"

typedef struct fg__partition {
  int dimension;
  int cells[3]; /* of the level's whole grid; 1 along z in 2D */
  int nodes[3]; /* cells + 1, or cells where periodic; 1 along z in 2D */
  bool periodic[3];
  const fg__ranks *ranks; /* that share it */
  int blocks[3];          /* along each axis, all together one a rank that is not idle */
  fg__box *block;         /* [ranks->count] of each rank */
} fg__partition;

/* Makes the partition of a level into so many blocks along each axis, which begin at
 * multiples of `unit` nodes and are as even as that allows. Not collective. MEMORY. */
fg_status fg__partition_create(fg__partition *out, fg_context *context,
                               const fg__ranks *ranks, int dimension, const int cells[3],
                               const bool periodic[3], const int blocks[3], int unit);

/* The same partition once more. Not collective. MEMORY. */
fg_status fg__partition_copy(fg__partition *out, fg_context *context,
                             const fg__partition *from);

/* The next coarser level, of the nodes with even indices. Along each axis the cells of
 * the whole must be even. Not collective. MEMORY. */
fg_status fg__partition_coarsen(fg__partition *out, fg_context *context,
                                const fg__partition *fine);

/* Levels are distributed while blocks have so many nodes a side. */
enum { FG__LEAST_BLOCK_NODES = 4 };

/* True when the level can be distributed and coarsened: its cells are even along each
 * axis, every block that is not empty has `least_nodes` or more a side and begins at even
 * indices, so that an even row of a block is even everywhere. (A block may end anywhere.)
 * The same on all ranks; not collective. */
bool fg__partition_is_workable(const fg__partition *partition, int least_nodes);
void fg__partition_clear(fg__partition *partition);

/* The cells whose lower corners a block owns, as if they were nodes. */
fg__box fg__block_cells(const fg__partition *partition, const fg__box *block);

/* The block of this rank, borrowed. */
static inline const fg__box *fg__own_block(const fg__partition *partition)
{
  return &partition->block[partition->ranks->rank];
}

/* Whether this rank has no block. */
static inline bool fg__is_idle(const fg__partition *partition)
{
  return fg__box_is_empty(fg__own_block(partition));
}

enum { FG__NOBODY = -1 };

/* The rank whose block lies so many blocks further along each axis, across a periodic
 * boundary too; FG__NOBODY beyond another, and for an idle rank. */
int fg__block_neighbour(const fg__partition *partition, int rank, const int steps[3]);

#endif
