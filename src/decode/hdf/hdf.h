/* VTKHDF and XDMF files: grids as VTK has them, whose numbers are in HDF5 files. What
 * these files say becomes pieces and arrays of decode/vtk, which makes a dataset of them;
 * HDF5 is read as NetCDF-4 is (decode/netcdf), with its checks. */
#ifndef FG__HDF_H
#define FG__HDF_H

#include "decode/vtk/vtk.h"

/* A file with numbers. */
typedef struct fg__hdf_file {
  char *path;        /* NULL: that which was opened first, whose source is not ours */
  fg__source source; /* of another */
  fg__dataset data;  /* of HDF5 */
} fg__hdf_file;

/* What fg__vtk.held is. */
typedef struct fg__hdf {
  fg__hdf_file **file;
  size_t count, capacity;
  double room; /* how many more numbers may be read at once from now on */
} fg__hdf;

/* Sets vtk->held. MEMORY. */
fg_status fg__hdf_begin(fg__hdf **out, fg__vtk *vtk);

/* Opens a file that the one at vtk->path names, or (name NULL) `source`; each once. Of
 * one that is no HDF5 only the source is opened. UNSUPPORTED (out of the folder),
 * FILE_ACCESS, FILE_FORMAT, MEMORY. */
fg_status fg__hdf_open(fg__hdf_file **out, fg__vtk *vtk, const char *name,
                       const fg__source *source);

/* The variable of that whole name, "group/name", or NULL. */
const fg__variable *fg__hdf_find(const fg__dataset *data, const char *name);

/* How many numbers a variable has. FILE_FORMAT where they are none, or more than its file
 * can hold. */
fg_status fg__hdf_count(size_t *out, const fg__variable *variable);

/* Numbers [first, first + count) of a variable in the order in which they lie, which are
 * there. FILE_FORMAT, MEMORY. */
fg_status fg__hdf_read(double *out, const fg__variable *variable, size_t first,
                       size_t count);

/* Adds an array that is a part of a variable: its numbers from `first` on. */
fg_status fg__hdf_add_array(fg__vtk *vtk, const fg__variable *variable, const char *name,
                            fg__vtk_place place, int components, size_t first);

#endif
