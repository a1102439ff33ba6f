/* How the nodes of one level are shared out: disjoint boxes of nodes, each owned by a
 * rank.
 *
 * Every rank knows the boxes of all: 24 bytes a box and level. A rank has one box to a
 * handful (pieces of a Morton curve), so that 1000 ranks take some 100 kB a level and one
 * MPI_Allgatherv when the mesh is made; plans (exchange.h) are found by comparing own
 * boxes with all boxes.
 *
 * Levels coarsen by halving: node i of a level is node 2 i of the finer one, and a rank
 * owns on the coarser level what it owns of these nodes on the finer. Where that leaves
 * boxes too small, or not aligned, the level is replicated: every rank holds it whole,
 * and all compute the same (bit for bit). The distributed partition of that level still
 * serves to bring values there and back (gather.h). */
#ifndef FG__PARTITION_H
#define FG__PARTITION_H

#include "mesh/box.h"
#include "mesh/ranks.h"

typedef struct fg__partition {
  int dimension;
  int cells[3]; /* of the level's whole grid; 1 along z in 2D */
  int nodes[3]; /* cells + 1, or cells where periodic; 1 along z in 2D */
  bool periodic[3];
  const fg__ranks *ranks; /* that share it */
  int count;              /* boxes of all ranks */
  fg__box *box;           /* [count], those of rank 0 first */
  int *first_of_rank;     /* [ranks->count + 1]: where a rank's boxes begin in box */
} fg__partition;

/* Makes the partition of a level with the boxes that this rank owns; they are copied, in
 * their order. Each node of the level belongs to one box. Collective. MEMORY. */
fg_status fg__partition_create(fg__partition *out, fg_context *context,
                               const fg__ranks *ranks, int dimension, const int cells[3],
                               const bool periodic[3], const fg__box *own, int own_count);

/* The next coarser level, of the nodes with even indices. Along each axis the cells of
 * the whole must be even. Boxes left without a node vanish. Not collective. MEMORY. */
fg_status fg__partition_coarsen(fg__partition *out, fg_context *context,
                                const fg__partition *fine);

/* Boxes of a level are worked on while they have so many nodes a side. */
enum { FG__LEAST_BOX_NODES = 4 };

/* True when the level is good to work on as it is shared, and to be coarsened: its cells
 * are even along each axis, every box has `least_nodes` or more and begins at even
 * indices, so that an even column of a box is even everywhere. (A box may end anywhere.)
 * The same on all ranks; not collective. */
bool fg__partition_is_workable(const fg__partition *partition, int least_nodes);
void fg__partition_clear(fg__partition *partition);

/* The cells whose lower corners a box owns, as if they were nodes. */
fg__box fg__box_cells(const fg__partition *partition, const fg__box *box);

/* The boxes of this rank, borrowed. */
static inline const fg__box *fg__own_boxes(const fg__partition *partition, int *count)
{
  const int *first = &partition->first_of_rank[partition->ranks->rank];
  *count = first[1] - first[0];
  return partition->box + first[0];
}

#endif
