/* Writing VTK XML image data: inline base64 in zlib blocks, so that the file is XML
 * throughout and every reader of VTK's takes it. */
#ifndef FG__VTI_WRITE_H
#define FG__VTI_WRITE_H

#include "base/context.h"
#include "file/whole_file.h"

#include <stdint.h>

/* The box of an image; points[2] is 0 in 2D, an image in the plane z = 0. Nothing of it
 * may be infinite or NaN. */
typedef struct fg__vti_image {
  int points[3];
  double origin[3], spacing[3];
  const double *time;           /* TimeValue; NULL: none */
  const double *least_area;     /* LeastClusterArea; NULL: none */
  const fg_field_arrays *field; /* whose scale, axes' words, x's period, projection, time
                                   and level in words are told; NULL: none */
} fg__vti_image;

/* An array to be written: float, unsigned char or int, by the size of one and the type's
 * name in VTK. */
typedef struct fg__vti_output {
  const char *name;
  const char *type;  /* "Float32", "UInt8", "Int32" */
  const char *units; /* NULL or "": none */
  const void *data;
  size_t bytes;
  int components;
} fg__vti_output;

/* In this order: open, arrays of points, arrays of cells, close. `vectors` and `scalars`
 * are the active ones of the points, or NULL. All texts are UTF-8, whatever is in them is
 * escaped. Numbers are written in the thread's locale: see number_text.h. */
void fg__vti_write_open(FILE *stream, const fg__vti_image *image, const char *vectors,
                        const char *scalars);
fg_status fg__vti_write_array(FILE *stream, fg_context *context,
                              const fg__vti_output *array);
void fg__vti_write_cells(FILE *stream);
void fg__vti_write_close(FILE *stream);

/* This machine's, as a file's attribute byte_order names it. */
const char *fg__vti_byte_order(void);

/* What an array is written of, for writers that have it in parts: its compressed blocks,
 * and after the sizes of all blocks their bytes as one text. */
enum {
  FG__VTI_BLOCK = 32768,  /* bytes of a block: VTK's own default */
  FG__VTI_ENCODED = 12288 /* encoded in one go: a multiple of 3, so that no padding is put
                             between */
};

typedef struct fg__vti_blocks {
  size_t count;
  uint64_t *sizes; /* [count] what each takes in `packed` */
  unsigned char *packed;
  size_t used; /* bytes of `packed` */
} fg__vti_blocks;

/* Deflates block by block, from the beginning of a block on. Clear it also on failure.
 * MEMORY. */
fg_status fg__vti_pack(fg__vti_blocks *out, fg_context *context, const void *data,
                       size_t bytes);
void fg__vti_blocks_clear(fg__vti_blocks *blocks);

/* Bytes on their way into a text, which begins as {.stream = ...}. */
typedef struct fg__vti_text {
  FILE *stream;
  size_t count;
  unsigned char waiting[FG__VTI_ENCODED];
} fg__vti_text;

void fg__vti_put(fg__vti_text *text, const unsigned char *bytes, size_t count);
void fg__vti_put_end(fg__vti_text *text);

/* Tag and sizes of all blocks of the array before its text, and the end behind it; `data`
 * is not read. */
void fg__vti_begin_array(FILE *stream, const fg__vti_output *array,
                         const uint64_t *sizes);
void fg__vti_end_array(FILE *stream, const fg__vti_output *array);

#endif
