/* Exodus II files: finite elements in blocks, with values at nodes and of elements at
 * several times, in NetCDF. Source: Sjaardema et al., EXODUS: A Finite Element Data
 * Model, SAND92-2137. */
#ifndef FG__EXODUS_H
#define FG__EXODUS_H

#include "decode/netcdf/netcdf.h"

enum { FG__EXODUS_NODES = 27, FG__EXODUS_NAME = 256 };

/* How an element of the file becomes a cell of VTK's. */
typedef struct fg__exodus_shape {
  const char *begins;                  /* the element's name, large letters */
  int nodes;                           /* of the element; 0: any number */
  int type;                            /* vtkCellType.h */
  int taken;                           /* nodes that the cell has */
  signed char order[FG__EXODUS_NODES]; /* the cell's nodes; all 0: as they come */
} fg__exodus_shape;

/* NULL: there is none of that name and number of nodes. */
const fg__exodus_shape *fg__exodus_shape_find(const char *name, size_t nodes);

typedef struct fg__exodus_block {
  const fg__variable *nodes; /* its elements' nodes, [cells][nodes] from 1 */
  int number;                /* in the names of its variables, from 1 */
  char name[FG__EXODUS_NAME];
  size_t cells, per_cell;
  const fg__exodus_shape *shape;
} fg__exodus_block;

/* The decoder's state. */
typedef struct fg__exodus {
  fg__dataset file; /* as NetCDF has it */
  size_t points, dimension, times;
  size_t time;             /* the chosen one */
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

/* blocks.c. Adds the cells of all chosen blocks to the dataset's topology. */
fg_status fg__exodus_add_cells(fg__dataset *data, const fg__exodus *e);

#endif
