/* A box of nodes as rows along x, and what lies beyond its sides. Rows are counted along
 * a middle and an outer axis: y and z in 3D; in 2D y is the outer axis, and the middle
 * one has a single node and a single cell. */
#ifndef FG__COMPONENT_SHAPE_H
#define FG__COMPONENT_SHAPE_H

#include <limits.h>

#include "component/components.h"

typedef enum fg__side {
  FG__SIDE_BOUNDARY, /* nothing */
  FG__SIDE_RING,     /* a ghost node, in memory */
  FG__SIDE_WRAP,     /* the box's own node at the other end */
  FG__SIDE_FLAT      /* 2D, middle axis: the cell, but no node */
} fg__side;

typedef struct fg__shape {
  int nodes[3];
  fg__side low[3], high[3];
  const float *u; /* NULL: positive everywhere */
  ptrdiff_t stride[3];
  const float *ones; /* in place of every row of u when that is NULL */
  const unsigned char *active;
  ptrdiff_t cell_stride[3];
  int64_t first, step[3]; /* index in the whole grid: of node (0, 0, 0), from a node to
                             the next along each axis */
} fg__shape;

fg__shape fg__shape_of(const fg__component_box *box);

enum { FG__NOWHERE = INT_MIN };

/* Where node `index`, from -1 to nodes[axis], lies in memory along an axis. */
static inline int fg__shape_node(const fg__shape *shape, int axis, int index)
{
  int nodes = shape->nodes[axis];
  if (index >= 0 && index < nodes)
    return index;
  fg__side side = index < 0 ? shape->low[axis] : shape->high[axis];
  if (side == FG__SIDE_WRAP)
    return index < 0 ? nodes - 1 : 0;
  return side == FG__SIDE_RING ? index : FG__NOWHERE;
}

/* The same for cell `index`, from -1 to nodes[axis] - 1, between two nodes. */
static inline int fg__shape_cell(const fg__shape *shape, int axis, int index)
{
  int nodes = shape->nodes[axis];
  if (index >= 0 && index < nodes - 1)
    return index;
  fg__side side = index < 0 ? shape->low[axis] : shape->high[axis];
  if (side == FG__SIDE_BOUNDARY)
    return FG__NOWHERE;
  return side == FG__SIDE_WRAP ? nodes - 1 : index;
}

static inline const float *fg__shape_row(const fg__shape *shape, int j, int k)
{
  return shape->ones ? shape->ones
                     : shape->u + j * shape->stride[1] + k * shape->stride[2];
}

/* A run is a stretch of positive nodes in one row, each joined to the next. Union-find
 * works on runs, of which there are some ten times fewer than nodes. */
struct fg__component_run {
  int parent;      /* the run itself at the root; never a later run */
  int first, last; /* nodes of the row */
  int piece;
  int64_t size;
};

/* Rows are counted along the middle axis first; the first run of each is kept, and the
 * end of the last. */
static inline int fg__row_number(const fg__shape *shape, int j, int k)
{
  return k * shape->nodes[1] + j;
}

/* Rows of cells that adjoin something; `count` 0 without a mask: then all are active. */
typedef struct fg__gate {
  const unsigned char *row[4];
  int count;
  bool masked;
} fg__gate;

/* The rows of cells j ... j_last of the middle axis and k ... k_last of the outer one. */
fg__gate fg__gate_of(const fg__shape *shape, int j, int j_last, int k, int k_last);

/* Whether one of the cells x ... x_last in these rows is active. */
bool fg__gate_open(const fg__gate *gate, const fg__shape *shape, int x, int x_last);

/* Nodes first ... last of every row. */
typedef struct fg__component_stretch {
  int first, last;
} fg__component_stretch;

/* Shares that each node of plane k takes of the cells round it in the plane of cells
 * between k and k + 1, over its value (see components.h): nodes[0] numbers a row, of
 * which those of a stretch are written. `space` has room for 3 rows of nodes[0] + 2. */
void fg__share_plane(const fg__shape *shape, int k, fg__component_stretch nodes,
                     float *space, float *shares);

#endif
