/* Arrays of a density that fg_density_write has left. */
#ifndef FG__READ_DENSITY_H
#define FG__READ_DENSITY_H

#include "flowgrain/density.h"
#include "read/format.h"

typedef struct fg__density_file {
  fg_density_arrays arrays; /* u and active are those below */
  float *u;                 /* owned */
  unsigned char *active;    /* owned; NULL: every cell is */
} fg__density_file;

/* Reads the density of a field. Clear it also after a failure. FILE_FORMAT, UNSUPPORTED,
 * MEMORY. */
fg_status fg__density_file_read(fg__density_file *out, fg_context *context,
                                const fg__source *source, const fg_field_arrays *field);
void fg__density_file_clear(fg__density_file *file);

#endif
