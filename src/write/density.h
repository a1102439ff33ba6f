/* Writing densities, whole or shared. */
#ifndef FG__DENSITY_WRITE_H
#define FG__DENSITY_WRITE_H

#include "write/vti.h"

enum { FG__VTI_HIDDEN_CELL = 32 }; /* vtkDataSetAttributes::HIDDENCELL */

/* Writes a shared density, the same bytes as of the whole one: each rank packs some
 * blocks of every array, and rank 0 writes them as they come. `status` is what this rank
 * met before. Collective. FILE_ACCESS, MEMORY. */
fg_status fg__density_write_shared(fg_context *context, const char *path,
                                   const fg_density *density, const fg__vti_image *image,
                                   fg_status status);

#endif
