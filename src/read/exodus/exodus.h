/* Exodus II files: finite elements in blocks, with values at nodes and of elements at
 * several times, in NetCDF. Source: Sjaardema et al., EXODUS: A Finite Element Data
 * Model, SAND92-2137. They become what a VTK file of cells is: read/vtk reads the rest.
 */
#ifndef FG__EXODUS_H
#define FG__EXODUS_H

#include "decode/netcdf/netcdf.h"
#include "read/vtk/vtk.h"

enum { FG__EXODUS_NODES = 27, FG__EXODUS_NAME = 256 };

/* How an element of the file becomes a cell of VTK's. */
typedef struct fg__exodus_shape {
  const char *begins;                  /* the element's name, large letters */
  int nodes;                           /* of the element; 0: any number */
  int type;                            /* vtkCellType.h */
  int taken;                           /* nodes that the cell has */
  signed char order[FG__EXODUS_NODES]; /* the cell's nodes; all 0: as they come */
} fg__exodus_shape;

/* NULL: there is none of that name with so many nodes. */
const fg__exodus_shape *fg__exodus_shape_find(const char *name, size_t nodes);

typedef struct fg__exodus_block {
  const fg__variable *nodes; /* its elements' nodes, [cells][nodes] from 1 */
  int number;                /* in the names of its variables, from 1 */
  char name[FG__EXODUS_NAME];
  size_t cells, per_cell;
  const fg__exodus_shape *shape;
} fg__exodus_block;

typedef struct fg__exodus {
  fg__dataset file;
  size_t points, dimension, times;
  fg__exodus_block *block; /* those that are chosen */
  size_t blocks, cells;    /* of these */
} fg__exodus;

/* Length of a dimension; 0 when it is not there. */
size_t fg__exodus_length(const fg__exodus *e, const char *name);

/* Checks that a variable has count[0] * ... numbers and such a rank, before memory for
 * them is allocated; and reads them, which checks again. FILE_FORMAT, MEMORY. */
fg_status fg__exodus_check(const fg__exodus *e, const fg__variable *v,
                           const size_t *first, const size_t *count, int rank);
fg_status fg__exodus_numbers(double *out, const fg__exodus *e, const fg__variable *v,
                             const size_t *first, const size_t *count, int rank);

/* A row of letters as a text without blanks at its end; "" where there is none. */
void fg__exodus_text(char out[FG__EXODUS_NAME], const fg__exodus *e, const char *variable,
                     size_t row);

/* blocks.c. Lists the blocks, of one name or (NULL) all; free e->block. FILE_FORMAT,
 * UNSUPPORTED, ARGUMENT, MEMORY. */
fg_status fg__exodus_blocks(fg__exodus *e, const char *wanted);

/* Adds an array of numbers in memory, with room for them at *bytes, owned by vtk. */
fg_status fg__exodus_add(void **bytes, fg__vtk *vtk, const char *name,
                         fg__vtk_place place, fg__vtk_type type, int components,
                         size_t tuples);

/* blocks.c. Adds the cells of all chosen blocks to the piece that is begun. */
fg_status fg__exodus_add_cells(fg__vtk *vtk, const fg__exodus *e);

/* variables.c. Adds the values at the nodes and of the elements at a time. */
fg_status fg__exodus_add_variables(fg__vtk *vtk, const fg__exodus *e, size_t time);

#endif
