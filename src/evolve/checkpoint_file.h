/* The file of a checkpoint: boxes of nodal values and a text, every byte under a checksum
 * (docs/design/checkpoint.md has the layout). A box names its nodes by their places in
 * the whole grid, so boxes written by any number of ranks are read by any other.
 *
 * Writing: every rank begins (one of them creates the file), places its records behind
 * those of the ranks before it, writes them, and ends its share; then the one that
 * created the file commits it with the records of all, in the order of their places. The
 * file takes its name only then; what had the name before becomes PATH.previous. */
#ifndef FG__CHECKPOINT_FILE_H
#define FG__CHECKPOINT_FILE_H

#include <stdint.h>

#include "base/context.h"

enum { FG__ARRAY_NAME_BYTES = 24, FG__CHECKPOINT_FIRST_OFFSET = 64 };

/* The 32-bit floats of one array at the nodes [first, first + nodes) of a grid, x
 * fastest. Boxes of one array and grid do not overlap. */
typedef struct fg__box_record {
  char array[FG__ARRAY_NAME_BYTES]; /* ended by a zero */
  int grid;                         /* 0: the finest level */
  int first[3], nodes[3];
  uint64_t offset, bytes; /* in the file: fg__checkpoint_place */
  uint32_t checksum;      /* fg__checkpoint_write */
} fg__box_record;

typedef struct fg__checkpoint_writer {
  const char *path; /* borrowed */
  char *part;       /* the name until the commit: PATH.part */
  int file;
} fg__checkpoint_writer;

/* Opens PATH.part, new with `create`, which one rank does before the others. On failure
 * there is nothing to end. FILE_ACCESS, MEMORY. */
fg_status fg__checkpoint_begin(fg__checkpoint_writer *out, fg_context *context,
                               const char *path, bool create);

/* Gives records their places one after the other from `offset`; returns where the next
 * rank's begin. The first rank's begin at FG__CHECKPOINT_FIRST_OFFSET. */
uint64_t fg__checkpoint_place(fg__box_record *records, size_t count, uint64_t offset);

/* Writes a record's values and notes their checksum. FILE_ACCESS. */
fg_status fg__checkpoint_write(fg__checkpoint_writer *writer, fg_context *context,
                               fg__box_record *record, const float *values);

/* Brings a rank's share to the disk and closes it; returns `status` or a failure. For
 * all ranks but the one that commits. FILE_ACCESS. */
fg_status fg__checkpoint_end_share(fg__checkpoint_writer *writer, fg_context *context,
                                   fg_status status);

/* With OK, the worst status of all ranks, writes text and table, brings all to the disk
 * and gives the file its name. Otherwise, and on failure, PATH.part goes and PATH stays
 * as it was. Returns `status` or a failure. FILE_ACCESS, MEMORY. */
fg_status fg__checkpoint_commit(fg__checkpoint_writer *writer, fg_context *context,
                                const char *text, const fg__box_record *records,
                                size_t count, fg_status status);

typedef struct fg__checkpoint_file {
  char *path;
  int file;
  char *text;
  fg__box_record *record;
  size_t record_count;
} fg__checkpoint_file;

/* Opens a file; all but the records' values is checked. FILE_ACCESS, FILE_FORMAT (no
 * checkpoint, damaged), UNSUPPORTED (another format), MEMORY. */
fg_status fg__checkpoint_read(fg__checkpoint_file *out, fg_context *context,
                              const char *path);
void fg__checkpoint_close(fg__checkpoint_file *file);

/* Checks the values of records [first, end). FILE_ACCESS, FILE_FORMAT. */
fg_status fg__checkpoint_verify(const fg__checkpoint_file *file, fg_context *context,
                                size_t first, size_t end);

/* Reads an array's values in a box, from all the records that reach into it, each checked
 * as a whole. FILE_ACCESS, FILE_FORMAT (damaged; the records do not cover the box). */
fg_status fg__checkpoint_read_box(const fg__checkpoint_file *file, fg_context *context,
                                  const char *array, int grid, const int first[3],
                                  const int nodes[3], float *values);

#endif
