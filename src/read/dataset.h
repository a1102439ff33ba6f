/* Formats whose decoders fill a dataset: what they mean and how they are sampled is one
 * for all. */
#ifndef FG__DATASET_FORMAT_H
#define FG__DATASET_FORMAT_H

#include "dataset/dataset.h"
#include "read/format.h"

typedef struct fg__dataset_format {
  const char *name;
  bool (*is_mine)(const unsigned char *bytes, size_t size);
  /* Adds a file to a dataset, which has to be closed also after a failure. */
  fg_status (*open)(fg__dataset *dataset, fg_context *context, const fg__source *source);
  /* The same where only the time or block that options name is opened (NULL: the first).
   */
  fg_status (*open_chosen)(fg__dataset *dataset, fg_context *context,
                           const fg__source *source, const fg_read_options *options);
  const char *alone; /* how its files are called where none can be added; NULL: one can */
} fg__dataset_format;

/* Opens a source, with all that is known of it before vectors are chosen; to be ended
 * also after a failure. options: NULL for none. */
fg_status fg__dataset_open(fg__dataset *data, fg_context *context,
                           const fg__dataset_format *format, const fg__source *source,
                           const fg_read_options *options);
fg_status fg__dataset_end(fg__dataset *data, fg_status status);

/* `status`, or that of a file which has become shorter while it was read. */
fg_status fg__dataset_check(const fg__dataset *data, fg_status status);

/* The functions of fg__format. options: NULL for all vectors. */
fg_status fg__dataset_inventory(fg_inventory *inventory, fg_context *context,
                                const fg__dataset_format *format,
                                const fg__source *source, const fg_read_options *options);
fg_status fg__dataset_read(fg_field **out, fg_context *context,
                           const fg__dataset_format *format, const fg__source *source,
                           const fg_read_options *options, fg__slab_index slab);
fg_status fg__dataset_sphere(fg__sphere **out, fg_context *context,
                             const fg__dataset_format *format, const fg__source *source,
                             const fg_read_options *options);

/* tensors.c. A variable of tensors as two fields, rows of the matrix. FILE_FORMAT,
 * UNSUPPORTED, ARGUMENT (not symmetric), MEMORY. */
fg_status fg__dataset_tensors(fg_field *row[2], bool *found, fg_context *context,
                              const fg__dataset_format *format, const fg__source *source);

/* Defines these functions of a fg__format for a fg__dataset_format. */
#define FG__DATASET_HOOKS(format)                                                        \
  static fg_status inventory_hook(fg_inventory *inventory, fg_context *context,          \
                                  const fg__source *source,                              \
                                  const fg_read_options *options)                        \
  {                                                                                      \
    return fg__dataset_inventory(inventory, context, &(format), source, options);        \
  }                                                                                      \
  static fg_status read_hook(fg_field **out, fg_context *context,                        \
                             const fg__source *source, const fg_read_options *options,   \
                             fg__slab_index slab)                                        \
  {                                                                                      \
    return fg__dataset_read(out, context, &(format), source, options, slab);             \
  }                                                                                      \
  static fg_status sphere_hook(fg__sphere **out, fg_context *context,                    \
                               const fg__source *source, const fg_read_options *options) \
  {                                                                                      \
    return fg__dataset_sphere(out, context, &(format), source, options);                 \
  }

#endif
