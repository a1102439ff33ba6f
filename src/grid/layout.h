/* How nodal values lie in memory: the arrays of one box of nodes.
 *
 * A row of nodes is stored as its even columns, then its odd columns, each part padded to
 * whole vectors, so that each colour of a Gauss-Seidel sweep is a contiguous run: column
 * i is at row + i / 2 when even, at row + odd_offset + (i - 1) / 2 when odd. Rows follow
 * each other along y, planes of rows along z. One ghost node lies on each side of a box
 * along every axis (none along z in 2D); array pointers point to node (0, 0, 0). */
#ifndef FG__LAYOUT_H
#define FG__LAYOUT_H

#include <stddef.h>

/* Lanes by which every loop over a row advances: the widest vector of floats. */
enum { FG__LANES = 16 };

/* A node's colour is 1 for odd columns + 2 for odd rows + 4 for odd planes (global
 * indices); sets of colours have bit 1 << colour. */
enum { FG__ALL_COLOURS = 0xff };

typedef struct fg__layout {
  int dimension;
  int nodes[3];         /* without ghosts; nodes[2] = 1 in 2D */
  ptrdiff_t odd_offset; /* from the even to the odd part of a row */
  ptrdiff_t stride;     /* from a row to the next */
  ptrdiff_t plane;      /* from a plane to the next; 0 in 2D */
  ptrdiff_t first;      /* from an array's start to node (0, 0, 0) */
  size_t array_size;    /* floats of one array, ghosts and pads included */
} fg__layout;

/* The layout of a box of nodes; see the top of this file. */
fg__layout fg__layout_of(int dimension, const int nodes[3]);

/* Offset of a column within its row, from -1 to nodes[0]. */
static inline ptrdiff_t fg__column(const fg__layout *layout, int i)
{
  return i % 2 == 0 ? i / 2 : layout->odd_offset + (i - 1) / 2;
}

/* Offset of row (j, k) from node (0, 0, 0); each from -1 to the number of nodes. */
static inline ptrdiff_t fg__row_at(const fg__layout *layout, int j, int k)
{
  return (ptrdiff_t)j * layout->stride + (ptrdiff_t)k * layout->plane;
}

static inline ptrdiff_t fg__node_at(const fg__layout *layout, int i, int j, int k)
{
  return fg__row_at(layout, j, k) + fg__column(layout, i);
}

/* Copies the nodes of row (j, k) of an array to a plain row. */
void fg__row_export(const fg__layout *layout, const float *array, int j, int k,
                    float *plain);

#endif
