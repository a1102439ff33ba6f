/* Boxes of nodes: bricks of a level's uniform grid. */
#ifndef FG__BOX_H
#define FG__BOX_H

#include <stdint.h>

#include <stdbool.h>
#include <stddef.h>

/* Nodes [first, first + nodes) along each axis, in global indices of the level; [0, 1)
 * along z in 2D. */
typedef struct fg__box {
  int first[3];
  int nodes[3];
} fg__box;

static inline bool fg__box_is_empty(const fg__box *box)
{
  return box->nodes[0] <= 0 || box->nodes[1] <= 0 || box->nodes[2] <= 0;
}

static inline int64_t fg__box_count(const fg__box *box)
{
  return (int64_t)box->nodes[0] * box->nodes[1] * box->nodes[2];
}

/* The box's nodes with even indices, as nodes of the grid with half as many cells along
 * each axis; empty when it has none. */
fg__box fg__box_halved(const fg__box *fine);

/* What two boxes have in common; empty when they have nothing. */
fg__box fg__box_intersection(const fg__box *a, const fg__box *b);

#endif
