/* The file of a checkpoint: arrays of nodal values and a text, every byte under a
 * checksum (docs/design/checkpoint.md has the layout). A record holds an array at the
 * nodes of a grid, or of a box of it, by their places in the whole: ranks write and read
 * their own boxes of it, and the bytes do not depend on the number of ranks. All ranks
 * need the same file system.
 *
 * Writing: every rank begins (one of them creates the file before the others), writes its
 * boxes of each record, and ends its share; then the checksums are put together, and the
 * rank that created the file commits it. The file takes its name only then; what had the
 * name before becomes PATH.previous. */
#ifndef FG__CHECKPOINT_FILE_H
#define FG__CHECKPOINT_FILE_H

#include <stdint.h>

#include "base/context.h"
#include "grid/box.h"
#include "grid/ranks.h"

enum { FG__ARRAY_NAME_BYTES = 24, FG__CHECKPOINT_FIRST_OFFSET = 64 };

/* The 32-bit floats of one array at the nodes of a box of a grid, x fastest. Boxes of one
 * array and grid do not overlap. */
typedef struct fg__box_record {
  char array[FG__ARRAY_NAME_BYTES]; /* ended by a zero */
  int grid;                         /* 0: the finest level */
  fg__box box;
  uint64_t offset, bytes; /* in the file: fg__checkpoint_place */
  uint32_t checksum;      /* while it is written, the share of what this rank wrote */
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

/* Gives records, without values so far, their places one after the other; the same on all
 * ranks. */
void fg__checkpoint_place(fg__box_record *records, size_t count);

/* Writes the values of a box, x fastest, as far as they belong to a record. Over all
 * calls and ranks each value of a record is written once. FILE_ACCESS. */
fg_status fg__checkpoint_write(fg__checkpoint_writer *writer, fg_context *context,
                               fg__box_record *record, const fg__box *box,
                               const float *values);

/* Makes the checksums of records of all ranks' shares of them. Collective. */
void fg__checkpoint_settle(fg__box_record *records, size_t count, const fg__ranks *ranks);

/* Brings a rank's share to the disk and closes it; returns `status` or a failure. For
 * all ranks but the one that commits. FILE_ACCESS. */
fg_status fg__checkpoint_end_share(fg__checkpoint_writer *writer, fg_context *context,
                                   fg_status status);

/* With OK, the worst status of all ranks, writes text and table, brings all to the disk
 * and gives the file its name. Otherwise, and on failure, PATH.part is removed and PATH
 * is kept. Returns `status` or a failure. FILE_ACCESS, MEMORY. */
fg_status fg__checkpoint_commit(fg__checkpoint_writer *writer, fg_context *context,
                                const char *text, const fg__box_record *records,
                                size_t count, fg_status status);

typedef struct fg__checkpoint_file {
  char *path;
  int file;
  uint32_t identity; /* a checksum of all checksums in the file */
  char *text;
  fg__box_record *record;
  uint32_t *share; /* of each record's checksum: what this rank has read of it */
  size_t record_count;
} fg__checkpoint_file;

/* Opens a file; all but the records' values is checked. FILE_ACCESS, FILE_FORMAT (no
 * checkpoint, damaged), UNSUPPORTED (another format), MEMORY. */
fg_status fg__checkpoint_read(fg__checkpoint_file *out, fg_context *context,
                              const char *path);
void fg__checkpoint_close(fg__checkpoint_file *file);

/* Reads all values and checks them, a part on each rank; the same outcome on all.
 * Collective. FILE_ACCESS, FILE_FORMAT. */
fg_status fg__checkpoint_verify(const fg__checkpoint_file *file, fg_context *context,
                                const fg__ranks *ranks);

/* Reads an array's values in a box, from all the records that reach into it.
 * FILE_ACCESS, FILE_FORMAT (damaged; the records do not cover the box). */
fg_status fg__checkpoint_read_box(const fg__checkpoint_file *file, fg_context *context,
                                  const char *array, int grid, const fg__box *box,
                                  float *values);

/* Checks what all ranks have read since the file was opened, or since the last check:
 * every value of the file, once. Collective. FILE_FORMAT. */
fg_status fg__checkpoint_check(const fg__checkpoint_file *file, fg_context *context,
                               const fg__ranks *ranks);

#endif
