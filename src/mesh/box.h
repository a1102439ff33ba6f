/* Boxes of nodes: bricks of a level's uniform grid. */
#ifndef FG__BOX_H
#define FG__BOX_H

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

static inline long fg__box_count(const fg__box *box)
{
  return (long)box->nodes[0] * box->nodes[1] * box->nodes[2];
}

/* What two boxes have in common; empty when they have nothing. */
fg__box fg__box_intersection(const fg__box *a, const fg__box *b);

/* Writes what is left of `box` without `hole`, which must lie in it, as at most 6 boxes;
 * returns how many. */
int fg__box_without(fg__box out[6], const fg__box *box, const fg__box *hole);

/* Merges disjoint boxes that share a whole side, in place, first along x, then y, then z;
 * sorts what comes out by plane, row and column, and returns its number. The result does
 * not depend on the order of the boxes given. */
int fg__boxes_merge(fg__box *box, int count);

/* Boxes that come one by one; starts as zeroes, its box is freed by the caller. Both
 * return false when there is no memory. */
typedef struct fg__box_list {
  fg__box *box;
  size_t count, capacity;
} fg__box_list;

bool fg__box_list_add(fg__box_list *list, const fg__box *box);

/* Takes the nodes of `hole` out of every box of the list. */
bool fg__box_list_take_out(fg__box_list *list, const fg__box *hole);

#endif
