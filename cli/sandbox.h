/* A sandboxed probe: a child process reads a file first. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "program.h"

/* Bounds of a child process, and its outcome. */
typedef struct child_bounds {
  unsigned seconds; /* of CPU time */
  size_t bytes;     /* in addition to those of this process; 0: unlimited */
} child_bounds;

enum { CHILD_TEXT_BYTES = 2048 };

typedef struct child_outcome {
  int signal; /* signal that ended the process, or 0 */
  char complaint[CHILD_TEXT_BYTES], advice[CHILD_TEXT_BYTES]; /* "" for none */
} child_outcome;

/* Calls `work` in a child process that prints nothing; its last complaint is stored. An
 * interrupt, or the end of this process, ends it. To be called before threads start. */
void do_in_child(child_outcome *out, void (*work)(void *), void *data,
                 const child_bounds *bounds);

/* HDF5 (under NetCDF-4) can crash on damaged metadata, or allocate any amount of memory;
 * so can ecCodes on damaged messages. A child process therefore first reads files of
 * these kinds: when it crashes or fails, prints an error and returns EXIT_FAILED, else
 * EXIT_DONE. With options it reads like fg_field_read, with NULL like
 * fg_inventory_read. */
int sandbox_reading(const char *input, const fg_read_options *options);

/* The same where a reading that fails is no failure yet, as another time may be read;
 * with options only a crash counts as failure. */
int sandbox_trial(const char *input, const fg_read_options *options);

/* The same for fg_inventory_read_chosen; options must not be NULL. */
int sandbox_inventory(const char *input, const fg_read_options *options);

/* The same for fg_read_defaults_find; only a crash counts as failure. */
int sandbox_defaults(const char *input, const fg_read_options *options);

/* The same for fg_field_read_slab; options must not be NULL. */
int sandbox_reading_part(const char *input, const fg_read_options *options, int slab,
                         int slabs);

#endif
