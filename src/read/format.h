/* File formats: a row of registry.c each, and a folder of decode/ that fills a dataset.
 */
#ifndef FG__FORMAT_H
#define FG__FORMAT_H

#include "decode/openers.h"
#include "interpret/inventory.h"
#include "sample/globe.h"
#include "sample/rows.h"

typedef struct fg__format {
  const char *name;  /* as `flowgrain info` shows it */
  const char *files; /* which ones it reads; NULL: another says it */
  bool (*is_mine)(const unsigned char *bytes, size_t size);
  fg__opener *open; /* NULL: this build cannot read it, for it lacks */
  fg_feature feature;
  bool is_chosen;      /* `open` opens but the time or block that options name */
  bool has_dimensions; /* knows the options mesh_from and at */
  bool has_tensors;    /* its arrays may be tensors */
  const char *alone; /* how its files are called where none can be added; NULL: one can */
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

/* Finds the format of bytes; NULL when no reader knows them. */
const fg__format *fg__format_find(const unsigned char *bytes, size_t size);

/* Opens a file and finds its format: fg_input_options.format, or the one of its bytes.
 * To be closed even after a failure. FILE_ACCESS, FILE_FORMAT (unknown), ARGUMENT (no
 * such name), UNSUPPORTED (not in this build). */
fg_status fg__source_open_known(fg__source *out, const fg__format **format,
                                fg_context *context, const char *path);

/* What is read of a dataset is one for all formats. */

/* Opens a source, with all that is known of it before vectors are chosen; to be ended
 * also after a failure. options: NULL for none. */
fg_status fg__dataset_open(fg__dataset *data, fg_context *context,
                           const fg__format *format, const fg__source *source,
                           const fg_read_options *options);
fg_status fg__dataset_end(fg__dataset *data, fg_status status);

/* `status`, or that of a file which has become shorter while it was read. */
fg_status fg__dataset_check(const fg__dataset *data, fg_status status);

/* What a source holds. options: NULL for all vectors; else the one that is read, without
 * reading samples. */
fg_status fg__dataset_inventory(fg_inventory *inventory, fg_context *context,
                                const fg__format *format, const fg__source *source,
                                const fg_read_options *options);

/* A field of the chosen vector; and one whose points lie on no two axes as a field on the
 * sphere: *out stays NULL where the other serves. */
fg_status fg__dataset_read(fg_field **out, fg_context *context, const fg__format *format,
                           const fg__source *source, const fg_read_options *options,
                           fg__slab_index slab);
fg_status fg__dataset_sphere(fg__sphere **out, fg_context *context,
                             const fg__format *format, const fg__source *source,
                             const fg_read_options *options);

/* tensors.c. A variable of tensors as two fields, rows of the matrix. FILE_FORMAT,
 * UNSUPPORTED, ARGUMENT (not symmetric), MEMORY. */
fg_status fg__dataset_tensors(fg_field *row[2], bool *found, fg_context *context,
                              const fg__format *format, const fg__source *source);

#endif
