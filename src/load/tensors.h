/* Symmetric tensors on a grid, as two fields of vectors: rows of the matrix. */
#ifndef FG__TENSORS_H
#define FG__TENSORS_H

#include "flowgrain/energy.h"
#include "read/format.h"

struct fg_tensors {
  fg_field *row[2]; /* in 2D (xx, xy) and (xy, yy); in 3D (xx, xy, xz), (yy, yz, zz) */
  double greatest;  /* eigenvalue of any sample; the law divides by it */
  fg_energy_law law;
};

/* A tensor array of a VTK file as two fields; *found: there is one. FILE_FORMAT,
 * UNSUPPORTED, ARGUMENT (not symmetric), MEMORY. */
fg_status fg__tensors_of_vtk(fg_field *row[2], bool *found, fg_context *context,
                             const fg__source *source);

#endif
