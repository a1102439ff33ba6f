/* Files that people take for fields, and that no format here reads. */
#ifndef FG__FOREIGN_H
#define FG__FOREIGN_H

#include <stddef.h>

typedef struct fg__foreign {
  const char *name;   /* "compressed by gzip", behind "is" */
  const char *advice; /* what to do about it */
} fg__foreign;

/* What the bytes of a file that has no format here begin; NULL: not known. */
const fg__foreign *fg__foreign_find(const unsigned char *bytes, size_t size);

/* The same of an HDF5 file, which NetCDF's decoder would take. */
const fg__foreign *fg__foreign_hdf5(const unsigned char *bytes, size_t size);

#endif
