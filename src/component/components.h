/* Connected components of the set {u > 0} on a grid of nodes: plain arrays in, labels,
 * sizes and a count out. The evolution counts clusters after every step; the stages after
 * it label the same components, so that a cluster is the same for both.
 *
 * Connectivity. Two positive nodes are neighbours along an axis and an active
 * cell adjoins the edge between them; or they face each other across a face of an active
 * cell (in 2D the cell itself) whose bilinear density is positive at its saddle point. So
 * the components are those of {u > 0} on the faces of the active cells. Opposite corners
 * of a 3D cell meet through its faces only, never through its inside. A node without an
 * active cell is outside. (Where u is 1 everywhere, these are the subdomains that a mask
 * separates.)
 *
 * Size. A positive node takes, in each active cell round it, the share u / sum |u| over
 * the cell's corners: a cell that is positive throughout counts whole, and the shares of
 * u and -u add up to one, so that a flat interface has no bias at any angle. Shares are
 * added in whole steps of 2^-24 cells: the sums depend on no order.
 *
 * A grid in boxes. Several boxes of nodes, each with a ring of one ghost node, together
 * give the same components, numbers and sizes as the whole grid, whatever the boxes:
 *   1. fg__components_cut finds the pieces of components that lie in each box;
 *   2. pieces are numbered 1, 2, ... over all boxes (any order of boxes: a box needs the
 *      number of pieces of those before it) and fg__components_number writes the numbers
 *      of the box's outermost nodes to an array laid out like its u;
 *   3. the ring of that array is exchanged between boxes and ranks like that of u: 4
 *      bytes a ghost node, only copied;
 *   4. fg__components_pairs lists the pairs of numbers that meet across the box's
 * boundary;
 *   5. all pieces (16 bytes each, in the order of their numbers) and all pairs (8 bytes
 *      each, in any order) are brought together, on every rank alike or on one that
 *      passes on the result, and fg__components_merge gives each number its label. */
#ifndef FG__COMPONENTS_H
#define FG__COMPONENTS_H

#include "base/context.h"

/* A whole grid in one plain array. */
typedef struct fg__component_grid {
  int nodes[3];                /* nodes[2] is at most 1 in 2D */
  bool periodic[3];            /* then the repeated last node is left out */
  const float *u;              /* a value a node, x fastest; NULL: 1 everywhere */
  const unsigned char *active; /* a byte a cell, 0 = masked; nodes[k] - 1 cells along an
                                  axis, nodes[k] when periodic; NULL: all active */
  double debris_area; /* components smaller than this, in cells, are debris; in 3D a
                         volume */
} fg__component_grid;

/* A box of a grid. On each side where the grid goes on (into another box, or across a
 * periodic boundary unless the box spans the whole period), u and active reach one node
 * and one cell further, edges and corners of the ring included. */
typedef struct fg__component_box {
  int grid_nodes[3];
  bool periodic[3];
  int first[3], nodes[3]; /* nodes first[k] ... first[k] + nodes[k] - 1 of the grid */
  const float *u;         /* node (0, 0, 0) of the box; NULL: 1 everywhere */
  ptrdiff_t row, plane;   /* from a row of u to the next, from a plane to the next */
  const unsigned char *active; /* the cell whose lowest corner is that node, or NULL */
  ptrdiff_t cell_row, cell_plane;
  double exact_below; /* cells: in 2D without a mask a piece may have a lower bound of its
                         size instead, if that bound is larger; 0: all sizes are exact */
} fg__component_box;

/* The part of a component in a box. */
typedef struct fg__component_piece {
  int64_t first; /* index of its first node in the whole grid, x fastest */
  int64_t size;  /* in 2^-24 cells */
} fg__component_piece;

/* Numbers of two pieces, counted from 1 over all boxes; low < high. */
typedef struct fg__component_pair {
  int low, high;
} fg__component_pair;

/* Result and working memory; zero it before the first use, use it again and again. */
typedef struct fg__components {
  int count;      /* components of at least debris_area */
  int debris;     /* smaller ones */
  int *label;     /* a number a node: 0 outside, 1 ... count in the order of the first
                     nodes (x fastest), -1 debris; only after fg__components_find */
  double *area;   /* [count] in cells; in 3D the volume */
  double covered; /* the share of the active cells that positive nodes stand for, each for
                     the nearest part of the cells round it: a number of cells */

  int piece_count; /* of the box last cut */
  fg__component_piece *piece;
  size_t pair_count; /* of the box last paired */
  fg__component_pair *pair;
  int *piece_label; /* after a merge: of every piece; piece n has number n + 1 */

  struct fg__component_run *run;
  struct fg__component_group *group;
  int *run_of_row, *ends, *root;
  unsigned char *marks, *cells;
  float *shares;
  size_t label_capacity, area_capacity, piece_capacity, pair_capacity,
      piece_label_capacity, run_capacity, run_of_row_capacity, ends_capacity,
      root_capacity, group_capacity, marks_capacity, cells_capacity, shares_capacity;
} fg__components;

/* A whole grid as its one box. */
fg__component_box fg__component_box_of(const fg__component_grid *grid);

/* Labels the components of a whole grid. MEMORY, ARGUMENT (a grid too large for int
 * labels). */
fg_status fg__components_find(fg__components *components, fg_context *context,
                              const fg__component_grid *grid);

/* The same but for `label`; less work. */
fg_status fg__components_count(fg__components *components, fg_context *context,
                               const fg__component_grid *grid);

void fg__components_clear(fg__components *components);

/* `covered` of a box alone, without counting components. Sums of several boxes are exact.
 * MEMORY. */
fg_status fg__components_cover(fg__components *components, fg_context *context,
                               const fg__component_box *box);

/* Finds the pieces of components in a box: `piece`, in the order of their first nodes,
 * and `covered`. MEMORY, ARGUMENT. */
fg_status fg__components_cut(fg__components *components, fg_context *context,
                             const fg__component_box *box);

/* Writes the numbers of the box's pieces, before + 1 and on, to an array laid out like u,
 * 0 at nodes outside; to the outermost nodes of the box alone, or to all of them. */
void fg__components_number(const fg__components *components, const fg__component_box *box,
                           int before, bool all, int *number);

/* Lists the pairs of pieces that meet across the box's boundary, each pair once; of two
 * boxes the one whose piece has the higher number lists it. MEMORY. */
fg_status fg__components_pairs(fg__components *components, fg_context *context,
                               const fg__component_box *box, const int *number);

/* Joins pieces into components: sets `count`, `debris`, `area` and `piece_label`. `piece`
 * may be the components' own. MEMORY. */
fg_status fg__components_merge(fg__components *components, fg_context *context,
                               const fg__component_piece *piece, int piece_count,
                               const fg__component_pair *pair, size_t pair_count,
                               double debris_area);

/* Writes the labels of a box's nodes, to an array laid out like u: piece_label tells
 * those of its pieces, numbered before + 1 and on. */
void fg__components_label(const fg__components *components, const fg__component_box *box,
                          const int *piece_label, int before, int *label);

/* In 2D: whether a cell is part of the domain; (x, y) may lie one cell beyond the grid.
 */
bool fg__components_cell_active(const fg__component_grid *grid, int x, int y);

/* Whether the bilinear density of a face joins the two corners `a` and `d` > 0 that face
 * each other across it when the other two, `b` and `c`, are not positive. */
bool fg__components_saddle_joins(float a, float b, float c, float d);

#endif
