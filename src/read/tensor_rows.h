/* Symmetric tensors on a grid, as two fields of vectors: rows of the matrix. */
#ifndef FG__TENSOR_ROWS_H
#define FG__TENSOR_ROWS_H

#include "read/format.h"

/* Reads a file's tensors: in 2D rows (xx, xy) and (xy, yy); in 3D (xx, xy, xz) and (yy,
 * yz, zz). A format's own tensors come before components in variables of their own, which
 * are 3 in 2D and 6 in 3D (`dimension`). Statuses as fg_field_read, ARGUMENT (not
 * symmetric). */
fg_status fg__tensor_rows_read(fg_field *row[2], fg_context *context, const char *path,
                               int dimension);

#endif
