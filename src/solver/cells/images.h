/* Layout of cell values round a box of nodes, and the images beyond its sides: tensors
 * (cells.h) and element matrices (elements.h) alike. */
#ifndef FG__CELL_IMAGES_H
#define FG__CELL_IMAGES_H

#include <stdbool.h>
#include <stddef.h>

#include "grid/box.h"

/* Cell (i, j, k) lies between nodes (i, j, k) and (i + 1, j + 1, k + 1); indices run from
 * -1 to count - 1 along each axis (from 0 to 0 along z in 2D), count the number of
 * nodes. */
typedef struct fg__cell_layout {
  int dimension;
  int nodes[3];         /* 1 along z in 2D */
  ptrdiff_t row, plane; /* from a cell to the next along y and z */
  ptrdiff_t origin;     /* from an array's start to cell (0, 0, 0) */
  size_t size;          /* cells of an array */
} fg__cell_layout;

fg__cell_layout fg__cell_layout_of(int dimension, const int nodes[3]);

/* Copies a cell from its image, all its values; a mirror image is flipped along `axis`.
 * to, from: from cell (0, 0, 0). */
typedef void fg__copy_cell(const void *cells, ptrdiff_t to, ptrdiff_t from, int axis,
                           bool mirrored);

/* Fills what lies beyond the sides of a box of a level of so many cells: mirrored at
 * natural boundaries, wrapped round where the box is all of a period. The cells of other
 * boxes are there already. */
void fg__cell_images_fill(const fg__cell_layout *layout, const fg__box *box,
                          const int level_cells[3], const bool periodic[3],
                          fg__copy_cell *copy, const void *cells);

#endif
