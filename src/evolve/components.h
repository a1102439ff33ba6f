/* Connected components of the set {u > 0} on a grid of nodes: plain arrays in, labels,
 * areas and a count out. The evolution counts clusters after every step; the stages after
 * it label the same components, so that both mean the same thing by a cluster. */
#ifndef FG__COMPONENTS_H
#define FG__COMPONENTS_H

#include "base/context.h"

typedef struct fg__component_grid {
  int nodes[2];
  bool periodic[2];            /* then the repeated last node is left out */
  const float *u;              /* nodes[0] * nodes[1] values */
  const unsigned char *active; /* a byte a cell, 0 = masked; nodes[k] - 1 cells along an
                                  axis, nodes[k] when periodic; NULL: all active */
  double debris_area;          /* components smaller than this, in cells, are debris */
} fg__component_grid;

/* Result and working memory; zero it before the first use, use it again and again. */
typedef struct fg__components {
  int count;    /* components of at least debris_area */
  int debris;   /* smaller ones */
  int *label;   /* a number a node: 0 outside, 1 ... count in the order of the first nodes
                   (x fastest), -1 debris; after fg__components_count: of no meaning */
  double *area; /* [count] in cells: the part of the active cells where the bilinear
                   density is positive, the border in a cell taken as straight */

  unsigned char *positive; /* a byte a node */
  struct fg__run *run;
  size_t positive_capacity, label_capacity, area_capacity, run_capacity, run_count;
} fg__components;

/* Labels the components. Two positive nodes belong together when they are neighbours
 * along an axis and an active cell adjoins the edge between them, or when they face each
 * other across an active cell whose bilinear density is positive at its saddle point. A
 * node without an active cell is outside. MEMORY, ARGUMENT (a grid too large for int
 * labels). */
fg_status fg__components_find(fg__components *components, fg_context *context,
                              const fg__component_grid *grid);

/* The same for `count`, `debris` and `area` only; less work. */
fg_status fg__components_count(fg__components *components, fg_context *context,
                               const fg__component_grid *grid);

void fg__components_clear(fg__components *components);

/* Whether a cell is part of the domain; (x, y) may lie one cell beyond the grid. */
bool fg__components_cell_active(const fg__component_grid *grid, int x, int y);

/* Whether an active cell adjoins the edge from node (x, y) to its next node along `axis`;
 * the edge must exist. */
bool fg__components_edge_active(const fg__component_grid *grid, int x, int y, int axis);

/* Whether the bilinear density of a cell joins the two corners `a` and `d` > 0 that face
 * each other across it when the other two, `b` and `c`, are not positive. */
bool fg__components_saddle_joins(float a, float b, float c, float d);

#endif
