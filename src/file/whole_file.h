/* Files that appear whole or not at all: written under a name beside, then renamed. */
#ifndef FG__WHOLE_FILE_H
#define FG__WHOLE_FILE_H

#include "base/context.h"

#include <stdio.h>

typedef struct fg__whole_file {
  const char *path; /* borrowed */
  char *temporary;  /* NULL: a device or pipe, written directly */
  FILE *stream;
  int error; /* errno of the first failed write, where the writer noted it */
} fg__whole_file;

/* Opens a stream whose bytes become the file at `path` on close. FILE_ACCESS, MEMORY. */
fg_status fg__whole_file_open(fg__whole_file *out, fg_context *context, const char *path);

/* Ends it: with OK the file takes its name if every byte could be written, otherwise
 * nothing is left. Returns `status`, or what went wrong now. */
fg_status fg__whole_file_close(fg__whole_file *file, fg_context *context,
                               fg_status status);

/* The same for a library that opens files by name: makes an empty file beside `path`. The
 * name is to be freed by the second call, which renames or removes it. */
fg_status fg__whole_file_name(char **temporary, fg_context *context, const char *path);
fg_status fg__whole_file_rename(char *temporary, fg_context *context, const char *path,
                                fg_status status);

#endif
