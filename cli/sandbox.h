/* A sandboxed probe: a file is first read by a child process. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "program.h"

/* Bounds of a child process, and its outcome. */
typedef struct child_bounds {
  unsigned seconds; /* of CPU time */
  size_t bytes;     /* beyond those that this process has; 0: any number */
} child_bounds;

enum { CHILD_TEXT_BYTES = 2048 };

typedef struct child_outcome {
  int signal;                                                 /* that ended it, or 0 */
  char complaint[CHILD_TEXT_BYTES], advice[CHILD_TEXT_BYTES]; /* "" for none */
} child_outcome;

/* Does the work in a child process, which prints nothing; what it complains of is kept.
 * An interrupt, or the end of this process, ends it. Must be called before there are
 * threads. */
void do_in_child(child_outcome *out, void (*work)(void *), void *data,
                 const child_bounds *bounds);

/* The HDF5 library under NetCDF-4 can crash on damaged metadata, and allocate any amount
 * of memory, and ecCodes can on damaged messages. So a file of these kinds is first read
 * by a child process: when that dies or fails, complains and returns EXIT_FAILED, else
 * EXIT_DONE. With options as fg_field_read would, with NULL as fg_inventory_read. */
int sandbox_reading(const char *input, const fg_read_options *options);

/* The same for fg_inventory_read_chosen; options must not be NULL. */
int sandbox_inventory(const char *input, const fg_read_options *options);

/* The same for fg_read_defaults_find; of its failures only a crash is reported. */
int sandbox_defaults(const char *input, const fg_read_options *options);

/* The same for fg_field_read_slab; options must not be NULL. */
int sandbox_reading_part(const char *input, const fg_read_options *options, int slab,
                         int slabs);

#endif
