/* The nearest of points in space, by a tree that halves them along their widest side. */
#ifndef FG__POINTS_NEAREST_H
#define FG__POINTS_NEAREST_H

#include <stdbool.h>

#include "base/context.h"

enum { FG__MOST_NEAREST = 17 };

typedef struct fg__point_tree {
  const double *const *position; /* [3][count], borrowed */
  size_t count;
  int *order;          /* [count], points; the middle of a range parts it */
  unsigned char *axis; /* [count], along which it does */
} fg__point_tree;

/* Nearest first; `distance` squared. */
typedef struct fg__nearest_points {
  int wanted, count;
  int point[FG__MOST_NEAREST];
  double distance[FG__MOST_NEAREST];
} fg__nearest_points;

/* MEMORY. To be cleared even after a failure. */
fg_status fg__point_tree_create(fg__point_tree *out, fg_context *context,
                                const double *const position[3], size_t count);
void fg__point_tree_clear(fg__point_tree *tree);

/* Finds the `wanted` points nearest to a place; false where more points have to be looked
 * at than round a place among others: it is far from all, and out is not complete. */
bool fg__point_tree_find(fg__nearest_points *out, const fg__point_tree *tree,
                         const double at[3], int wanted);

#endif
