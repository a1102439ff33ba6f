/* The bytes of files. */
#ifndef FG__SOURCE_H
#define FG__SOURCE_H

#include "base/context.h"

/* What a format keeps of an input from call to call: its open files, the chosen vector.
 */
typedef struct fg__kept {
  void *data; /* NULL: nothing yet */
  void (*close)(void *data);
} fg__kept;

/* A file to read: its bytes are mapped or in memory, so that a decoder can be fuzzed. A
 * library that wants to open the file itself may use `path` when `on_disk`. */
typedef struct fg__source {
  const char *path; /* for messages; the file's name when on_disk */
  bool on_disk;
  const unsigned char *bytes;
  size_t size;
  fg__kept *kept; /* for calls whose options differ in time and level alone; NULL: a call
                     keeps nothing */
} fg__source;

/* Maps a regular file that can be read and is not empty; or gives the context's bytes, as
 * no file, for "-" (fg_context_set_input). FILE_ACCESS, FILE_FORMAT (empty). */
fg_status fg__source_open(fg__source *out, fg_context *context, const char *path);

/* Ends a source. Returns `status`, that of its reading, or fg__source_check. */
fg_status fg__source_close(fg__source *source, fg_context *context, fg_status status);

/* Returns `status`, that of reading a file of `size` bytes; or FILE_ACCESS where it has
 * become shorter since: what was read beyond its end then is zeros, and what was found
 * wrong with it may be so. (Reading mapped bytes beyond the page of its end is a SIGBUS.)
 */
fg_status fg__source_check(fg_context *context, fg_status status, const char *path,
                           size_t size);

/* How an input is called in messages. */
const char *fg__input_name(const fg_context *context, const char *input);

#endif
