/* File formats: a folder each, and one line in the list of registry.c. */
#ifndef FG__FORMAT_H
#define FG__FORMAT_H

#include "base/context.h"
#include "sphere/sphere.h"

typedef struct fg__source fg__source;

/* What a format opens a file to: its handles, the chosen vector. */
typedef struct fg__opener {
  size_t size; /* of the data, zeroed at first */
  fg_status (*open)(void *data, fg_context *context, const fg__source *source,
                    const fg_read_options *options);
  void (*close)(void *data); /* also after a failure */
} fg__opener;

/* That of an input, kept from call to call. */
typedef struct fg__kept {
  void *data; /* NULL: nothing yet */
  const fg__opener *opener;
} fg__kept;

/* A file to read: its bytes are mapped or in memory, so that a reader can be fuzzed. A
 * library that wants to open the file itself may use `path` when `on_disk`. */
struct fg__source {
  const char *path; /* for messages; the file's name when on_disk */
  bool on_disk;
  const unsigned char *bytes;
  size_t size;
  fg__kept *kept; /* for calls whose options differ in time and level alone; NULL: a call
                     keeps nothing */
};

/* What a reader is to read: slab `number` of `count` (field/slab.h), or with a count of 1
 * all. */
typedef struct fg__slab_index {
  int number, count;
} fg__slab_index;

/* Rows along the last axis: [first, first + own) and up to `held` what follows. */
typedef struct fg__rows {
  int first, own, held;
} fg__rows;

/* The rows of a slab; all when there are fewer than slabs: then `slab` becomes that. */
fg__rows fg__rows_of(fg__slab_index *slab, int rows, bool periodic);

/* The field of the arrays of such rows; velocity[k], which is arrays->velocity[k],
 * becomes NULL where the field takes it over. */
fg_status fg__field_of_rows(fg_field **out, fg_context *context,
                            const fg_field_arrays *arrays, float *velocity[3],
                            const fg__slab_index *slab);

/* The rows of a slab of a field that is there whole, or a copy of all of it where it has
 * fewer rows than there are slabs. */
fg_status fg__field_slab_of(fg_field **out, fg_context *context, const fg_field *whole,
                            fg__slab_index slab);

/* The rows of a slab of a longitude-latitude grid that has a sphere's mean spacing and
 * covers what the sphere covers. FILE_FORMAT (its cells have no area), MEMORY. */
fg_status fg__globe_field(fg_field **out, fg_context *context, const fg__sphere *sphere,
                          fg__slab_index slab);

/* Size, bounds and period of that grid, as an inventory has them; the size is 0 x 0 where
 * the cells have no area. */
void fg__globe_describe(fg_inventory_vector *vector, const fg__sphere_extent *extent);

typedef struct fg__format {
  const char *name; /* as `flowgrain info` shows it */
  bool is_absent;   /* this build cannot read it: it lacks `feature` */
  fg_feature feature;
  bool has_dimensions; /* knows the options mesh_from and at */
  const char *files;   /* which ones it reads; NULL: another says it, or none are read */
  bool (*is_mine)(const unsigned char *bytes, size_t size);
  fg_status (*inventory)(fg_inventory *inventory, fg_context *context,
                         const fg__source *source);
  /* The same of the one vector that `read` would give, without its missing share; NULL:
   * found among all by --vars, or the first that can be read. */
  fg_status (*inventory_chosen)(fg_inventory *inventory, fg_context *context,
                                const fg__source *source, const fg_read_options *options);
  /* fg_read_defaults_find; NULL: level 0, and all coordinates are there. */
  fg_status (*defaults)(fg_read_defaults *out, fg_context *context,
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
extern const fg__format fg__format_netcdf;
extern const fg__format fg__format_grib;
extern const fg__format fg__format_vti;
extern const fg__format fg__format_vtk_legacy;
extern const fg__format fg__format_npy;
extern const fg__format fg__format_npz;
extern const fg__format fg__format_table; /* any text: the last */

/* Maps a regular file that can be read and is not empty; or gives the context's bytes, as
 * no file, for "-" (fg_context_set_input). FILE_ACCESS, FILE_FORMAT (empty). */
fg_status fg__source_open(fg__source *out, fg_context *context, const char *path);
void fg__source_close(fg__source *source);

/* Opens a source, or takes what is kept of an earlier call. *out is NULL after a
 * failure; else fg__source_leave ends the call. */
fg_status fg__source_enter(void **out, fg_context *context, const fg__source *source,
                           const fg_read_options *options, const fg__opener *opener);
void fg__source_leave(void *data, const fg__source *source, const fg__opener *opener);

/* Closes what is kept. */
void fg__kept_close(fg__kept *kept);

/* Fails for a second file or a level, where the format has neither; `files`: how its
 * files are called. UNSUPPORTED, ARGUMENT. */
fg_status fg__check_one_file(fg_context *context, const fg__source *source,
                             const fg_read_options *options, const char *files);

/* A number as a velocity: a finite one beyond float becomes the largest float, which is
 * larger than any speed that is accepted. */
float fg__as_velocity(double number);

/* How an input is called in messages. */
const char *fg__input_name(const fg_context *context, const char *input);

/* Finds the format of bytes; NULL when no reader knows them. */
const fg__format *fg__format_find(const unsigned char *bytes, size_t size);

/* Opens a file and finds its format: fg_input_options.format, or the one of its bytes.
 * To be closed even after a failure. FILE_ACCESS, FILE_FORMAT (unknown), ARGUMENT (no
 * such name), UNSUPPORTED (not in this build). */
fg_status fg__source_open_known(fg__source *out, const fg__format **format,
                                fg_context *context, const char *path);

/* Sets the reason why a vector of a file cannot be read, unless one is set already. */
enum { FG__REASON_BYTES = 512 };
void fg__set_unusable(char reason[FG__REASON_BYTES], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The place of a vector's text, n below FG__VECTOR_TEXTS. */
enum { FG__VECTOR_TEXTS = 13 };
const char **fg__vector_text(fg_inventory_vector *vector, int n);

/* Makes an empty inventory of a file in a format of that name. MEMORY. */
fg_status fg__inventory_create(fg_inventory **out, fg_context *context,
                               const char *format);

/* Leaves in an inventory the one vector that options->vars names, or the first that can
 * be read; perhaps none. */
void fg__inventory_choose(fg_inventory *inventory, const fg_read_options *options);

/* Adds a copy of a vector (texts included) to an inventory. MEMORY. */
fg_status fg__inventory_add(fg_inventory *inventory, fg_context *context,
                            const fg_inventory_vector *vector);

#endif
