/* File formats: a folder each, and one line in the list of registry.c. */
#ifndef FG__FORMAT_H
#define FG__FORMAT_H

#include "decode/source.h"
#include "interpret/inventory.h"
#include "sample/globe.h"
#include "sample/rows.h"

typedef struct fg__format {
  const char *name; /* as `flowgrain info` shows it */
  bool is_absent;   /* this build cannot read it: it lacks `feature` */
  fg_feature feature;
  bool has_dimensions; /* knows the options mesh_from and at */
  const char *files;   /* which ones it reads; NULL: another says it, or none are read */
  bool (*is_mine)(const unsigned char *bytes, size_t size);
  /* options: NULL for all vectors; else the one that `read` would give, without reading
   * samples. */
  fg_status (*inventory)(fg_inventory *inventory, fg_context *context,
                         const fg__source *source, const fg_read_options *options);
  fg_status (*read)(fg_field **out, fg_context *context, const fg__source *source,
                    const fg_read_options *options, fg__slab_index slab);
  /* Vectors whose points lie on no two axes, as a field on the sphere; *out stays NULL
   * where `read` serves. NULL: the format has none. */
  fg_status (*sphere)(fg__sphere **out, fg_context *context, const fg__source *source,
                      const fg_read_options *options);
  /* The file's array of tensors as two fields (tensor_rows.h); *found: there is one. NULL
   * where the format has none. */
  fg_status (*tensors)(fg_field *row[2], bool *found, fg_context *context,
                       const fg__source *source);
} fg__format;

extern const fg__format fg__format_exodus; /* of NetCDF files: before these */
extern const fg__format fg__format_vtkhdf; /* of HDF5: the same */
extern const fg__format fg__format_netcdf;
extern const fg__format fg__format_grib;
extern const fg__format fg__format_vti;
extern const fg__format fg__format_vtk_legacy;
extern const fg__format fg__format_vtk_series;
extern const fg__format fg__format_xdmf;
extern const fg__format fg__format_npy;
extern const fg__format fg__format_npz;
extern const fg__format fg__format_table; /* any text: the last */

/* Fails for a second file or a level, where the format has neither; `files`: how its
 * files are called. UNSUPPORTED, ARGUMENT. */
fg_status fg__check_one_file(fg_context *context, const fg__source *source,
                             const fg_read_options *options, const char *files);

/* Finds the format of bytes; NULL when no reader knows them. */
const fg__format *fg__format_find(const unsigned char *bytes, size_t size);

/* Opens a file and finds its format: fg_input_options.format, or the one of its bytes.
 * To be closed even after a failure. FILE_ACCESS, FILE_FORMAT (unknown), ARGUMENT (no
 * such name), UNSUPPORTED (not in this build). */
fg_status fg__source_open_known(fg__source *out, const fg__format **format,
                                fg_context *context, const char *path);

#endif
