/* evolution.csv: a row for every accepted step. Rows wait in memory until they are
 * written, so that a disk that is full for a while costs none. */
#ifndef REPORT_TABLE_H
#define REPORT_TABLE_H

#include "program.h"

typedef struct cli_table {
  char *path;
  int file;        /* -1: not open */
  long long bytes; /* of the file, all of them whole rows */
  char *rows;      /* not written yet */
  size_t used, capacity;
} cli_table;

/* Begins a table at `path`, with its heading, which it takes over (malloc'd). Returns an
 * exit code. */
int table_start(cli_table *out, char *path);

/* Goes on with one after its first `bytes`; what follows them is dropped, and what else
 * the file is known as keeps it. Returns an exit code. */
int table_resume(cli_table *out, char *path, long long bytes);

/* Adds a step's row. Returns an exit code. */
int table_add(cli_table *table, const fg_step *step);

/* Writes the rows that wait, and with `to_disk` sees to it that they survive the machine.
 * False: they wait on, and errno says why. */
bool table_flush(cli_table *table, bool to_disk);
void table_close(cli_table *table);

#endif
