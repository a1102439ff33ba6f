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
} fg__dataset_format;

/* The functions of fg__format. options: NULL for all vectors. */
fg_status fg__dataset_inventory(fg_inventory *inventory, fg_context *context,
                                const fg__dataset_format *format,
                                const fg__source *source, const fg_read_options *options);
fg_status fg__dataset_defaults(fg_read_defaults *out, fg_context *context,
                               const fg__dataset_format *format, const fg__source *source,
                               const fg_read_options *options);
fg_status fg__dataset_read(fg_field **out, fg_context *context,
                           const fg__dataset_format *format, const fg__source *source,
                           const fg_read_options *options, fg__slab_index slab);
fg_status fg__dataset_sphere(fg__sphere **out, fg_context *context,
                             const fg__dataset_format *format, const fg__source *source,
                             const fg_read_options *options);

/* Defines these functions of a fg__format for a fg__dataset_format. */
#define FG__DATASET_HOOKS(format)                                                        \
  static fg_status inventory_hook(fg_inventory *inventory, fg_context *context,          \
                                  const fg__source *source)                              \
  {                                                                                      \
    return fg__dataset_inventory(inventory, context, &(format), source, NULL);           \
  }                                                                                      \
  static fg_status chosen_hook(fg_inventory *inventory, fg_context *context,             \
                               const fg__source *source, const fg_read_options *options) \
  {                                                                                      \
    return fg__dataset_inventory(inventory, context, &(format), source, options);        \
  }                                                                                      \
  static fg_status defaults_hook(fg_read_defaults *out, fg_context *context,             \
                                 const fg__source *source,                               \
                                 const fg_read_options *options)                         \
  {                                                                                      \
    return fg__dataset_defaults(out, context, &(format), source, options);               \
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
