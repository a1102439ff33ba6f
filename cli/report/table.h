/* evolution.csv: a row for every accepted step. Rows stay in memory until they are
 * written, so that a disk that is full for a while loses none. */
#ifndef REPORT_TABLE_H
#define REPORT_TABLE_H

#include "program.h"

typedef struct cli_table {
  char *path;
  int file;        /* -1: not open */
  long long bytes; /* of the file, in complete rows */
  char *rows;      /* not yet written */
  size_t used, capacity;
} cli_table;

/* Creates a table at `path` with its heading, and takes ownership of `path` (malloc'd).
 * Returns an exit code. */
int table_start(cli_table *out, char *path);

/* Continues a table after its first `bytes` bytes and drops the rest, in a new file: hard
 * links to the old one keep its contents. Returns an exit code. */
int table_resume(cli_table *out, char *path, long long bytes);

/* Adds the row of a step. Returns an exit code. */
int table_add(cli_table *table, const fg_step *step);

/* Writes buffered rows, with `to_disk` also through to the disk. On failure returns false
 * with errno set, and keeps the rows. */
bool table_flush(cli_table *table, bool to_disk);
void table_close(cli_table *table);

#endif
