/* Writing VTK XML image data: inline base64 in zlib blocks, so that the file is XML
 * throughout and every reader of VTK's takes it. */
#ifndef FG__VTI_WRITE_H
#define FG__VTI_WRITE_H

#include "base/context.h"
#include "base/whole_file.h"

/* The box of an image; points[2] is 0 in 2D, an image in the plane z = 0. Nothing of it
 * may be infinite or NaN. */
typedef struct fg__vti_image {
  int points[3];
  double origin[3], spacing[3];
  const double *time; /* TimeValue; NULL: none */
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

#endif
