/* Arrays of NumPy: a .npy file has one, a .npz file, a ZIP archive, some by name. In the
 * order a file passes through the parts: zip, header, file, choice, field. */
#ifndef FG__NPY_H
#define FG__NPY_H

#include "read/format.h"
#include "sample/points/points.h"

enum { FG__NPY_RANK = 4, FG__NPY_ARRAYS = 256, FG__NPY_NAME = 64 };

typedef enum fg__npy_kind {
  FG__NPY_FLOAT,
  FG__NPY_SIGNED,
  FG__NPY_UNSIGNED,
  FG__NPY_BOOL,
  FG__NPY_COMPLEX
} fg__npy_kind;

typedef struct fg__npy_array {
  char name[FG__NPY_NAME];
  fg__npy_kind kind;
  size_t item; /* bytes of a number */
  bool swapped;
  int rank;
  size_t shape[FG__NPY_RANK];
  size_t stride[FG__NPY_RANK]; /* in numbers */
  size_t count;
  const unsigned char *data; /* count * item bytes; NULL: not loaded yet */
  unsigned char *owned;      /* those of a compressed entry */
  size_t entry;              /* of the archive */
} fg__npy_array;

/* zip.c. An entry of an archive, whose bytes are where they are said to be. */
typedef struct fg__zip_entry {
  char name[FG__NPY_NAME];
  const unsigned char *bytes;
  size_t stored, size; /* bytes in the file, and what they become */
  bool deflated;
  uint32_t checksum;
} fg__zip_entry;

typedef struct fg__zip {
  size_t count;
  fg__zip_entry entry[FG__NPY_ARRAYS];
} fg__zip;

/* Lists the entries whose names end in .npy, without that. FILE_FORMAT (damaged, entries
 * that overlap), UNSUPPORTED (encrypted, other compressions, more than FG__NPY_ARRAYS).
 */
fg_status fg__zip_list(fg__zip *out, fg_context *context, const fg__source *source);

/* The first `size` bytes of an entry, or fewer when it has fewer: *got. FILE_FORMAT
 * (damaged; the checksum is compared when all are read), MEMORY. */
fg_status fg__zip_extract(unsigned char *out, size_t size, size_t *got,
                          fg_context *context, const char *path,
                          const fg__zip_entry *entry);

/* header.c. What the header of an array says: `size` bytes of `all` that the array has;
 * *header becomes its length. FILE_FORMAT, UNSUPPORTED (types, ranks). */
fg_status fg__npy_header(fg__npy_array *out, size_t *header, fg_context *context,
                         const char *path, const unsigned char *bytes, size_t size,
                         size_t all);

typedef struct fg__npy_file {
  fg_context *context;
  const char *path;
  fg__zip zip;
  size_t count;
  fg__npy_array array[FG__NPY_ARRAYS];
} fg__npy_file;

bool fg__is_npy(const unsigned char *bytes, size_t size);
bool fg__is_npz(const unsigned char *bytes, size_t size);

/* file.c. Reads the headers of all arrays. *out is cleared even after a failure. */
fg_status fg__npy_open(fg__npy_file **out, fg_context *context, const fg__source *source);
void fg__npy_close(fg__npy_file *file);

/* Makes an array's numbers ready. FILE_FORMAT, MEMORY. */
fg_status fg__npy_load(fg__npy_file *file, fg__npy_array *array);

/* Number `index` in memory; of complex ones two follow each other. */
double fg__npy_value(const fg__npy_array *array, size_t index);

/* Which array has what; NULL: none. */
typedef struct fg__npy_choice {
  fg__npy_array *velocity[3]; /* one array of vectors: the first alone */
  int component_axis;         /* of one array of vectors; -1: complex, or several */
  bool table;                 /* rows of x, y, u, v */
  int dimension;
  fg__npy_array *position[3];
  fg__npy_array *mask;
  bool mask_hides; /* numbers that are not 0 hide, as in numpy.ma; else the others */
  bool geographic;
  const char *found_by;
} fg__npy_choice;

/* choice.c. ARGUMENT, UNSUPPORTED. */
fg_status fg__npy_choose(fg__npy_choice *out, fg__npy_file *file,
                         const fg_read_options *options);

/* field.c. Makes the field of a choice; *between is how points were interpolated; with
 * `sphere`, and scattered longitudes and latitudes, the field on the sphere instead. */
fg_status fg__npy_field(fg_field **out, fg__scatter_between *between, fg__sphere **sphere,
                        fg__npy_file *file, const fg__npy_choice *choice,
                        const fg_read_options *options, fg__slab_index slab);

#endif
