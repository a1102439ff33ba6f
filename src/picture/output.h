/* A picture's bytes on their way to a file that appears whole or not at all. */
#ifndef FG__OUTPUT_H
#define FG__OUTPUT_H

#include "base/context.h"

#include <cairo.h>
#include <stdio.h>

typedef struct fg__output {
  const char *path; /* borrowed */
  char *temporary;  /* NULL: a device or pipe, written directly */
  FILE *stream;
  int error; /* errno of the first write that failed */
} fg__output;

/* Opens a stream whose bytes become the file at `path` on close. FILE_ACCESS, MEMORY. */
fg_status fg__output_open(fg__output *out, fg_context *context, const char *path);

/* Ends it: with OK the file takes its name if every byte could be written, otherwise
 * nothing is left. Returns `status`, or what went wrong now. */
fg_status fg__output_close(fg__output *output, fg_context *context, fg_status status);

/* What Cairo's streams call, with the output as their closure. */
cairo_status_t fg__output_write(void *output, const unsigned char *bytes,
                                unsigned int count);

#endif
