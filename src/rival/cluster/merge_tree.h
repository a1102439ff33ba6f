/* Discrete clustering from the bottom up: the whole hierarchy of merges, after Telea and
 * van Wijk, "Simplified Representation of Vector Fields", IEEE Visualization 1999. */
#ifndef FG__RIVAL_MERGE_TREE_H
#define FG__RIVAL_MERGE_TREE_H

#include "rival/domain.h"

/* How unlike two clusters are (docs/method/rival-discrete.md). */
typedef struct fg__merge_weights {
  double position;   /* share of position in the error, direction has the rest; [0, 1] */
  double elongation; /* difference along the flow counts this many times less; >= 1 */
} fg__merge_weights;

/* One cluster: a cell, or two clusters that were merged. */
typedef struct fg__merge_node {
  int parent;         /* -1: none */
  int child[2];       /* -1: a cell */
  int size;           /* cells */
  double error;       /* of the merge that made it; 0 for a cell */
  double position[2]; /* mean of its cells; where an axis closes, of one way to lay them
                         side by side */
  double vector[2];   /* mean of its cells' directions */
} fg__merge_node;

/* Nodes are numbered in the order of their making: cells first (all valid ones, x
 * fastest), then merges. Without neighbours left several roots remain: one for each part
 * of the domain that masks separate. */
typedef struct fg__merge_tree {
  int cells, nodes;
  int *raster; /* [cells] their places in the domain */
  fg__merge_node *node;
} fg__merge_tree;

/* Merges, as long as there are neighbours, the two most alike. MEMORY, STOPPED. */
fg_status fg__merge_tree_create(fg__merge_tree *out, fg_context *context,
                                const fg__domain *domain,
                                const fg__merge_weights *weights);
void fg__merge_tree_clear(fg__merge_tree *tree);

/* The error between two clusters, as the tree's merges are ranked by. */
double fg__merge_error(const fg__merge_node *a, const fg__merge_node *b,
                       const fg__domain *domain, const fg__merge_weights *weights);

/* Undoes the last merges until `count` clusters are there: label[cell of the raster] is
 * its cluster from 1, in the order of first cells, or 0. Parts of the domain below a
 * twentieth of a cluster's fair share are left out, and where there are more other parts
 * than `count`, the smallest. *found is `count`, unless there are too few cells;
 * *left_out the clusters without a number. MEMORY. */
fg_status fg__merge_tree_cut(const fg__merge_tree *tree, fg_context *context, int count,
                             int *label, int *found, int *left_out);

#endif
