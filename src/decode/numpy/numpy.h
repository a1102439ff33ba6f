/* Arrays of NumPy as a dataset: a .npy file has one, a .npz file, a ZIP archive, some by
 * name. In the order a file passes through the parts: zip, header, file. */
#ifndef FG__NUMPY_H
#define FG__NUMPY_H

#include "decode/openers.h"

enum { FG__NPY_RANK = 4, FG__NPY_ARRAYS = 256, FG__NPY_NAME = 64 };

typedef struct fg__npy_array {
  char name[FG__NPY_NAME]; /* "": it holds no numbers */
  fg__type type;           /* of numbers that have half precision FLOAT32 */
  size_t item;             /* bytes of a number */
  bool is_bool, is_complex, swapped;
  int rank;
  size_t shape[FG__NPY_RANK];
  size_t stride[FG__NPY_RANK]; /* in numbers */
  size_t header;               /* bytes before the first number */
  const unsigned char *data;   /* the numbers; NULL: not loaded yet */
  unsigned char *owned;        /* those of a compressed entry */
  size_t entry;                /* of the archive */
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

/* header.c. What the header of an array says: `size` bytes of `all` that the array has.
 * FILE_FORMAT, UNSUPPORTED (types, ranks). */
fg_status fg__npy_header(fg__npy_array *out, fg_context *context, const char *path,
                         const unsigned char *bytes, size_t size, size_t all);

#endif
