/* The folder of a run's results: everything is written under a temporary name in it, and
 * takes its final name when the whole run is there. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "program.h"

typedef struct cli_output {
  char *folder;    /* DIR */
  char *partial;   /* DIR/.flowgrain-XXXXXX, NULL while there is none */
  char *made_from; /* the topmost folder that output_open made, NULL: none */
} cli_output;

/* Refuses early, with nothing written, a DIR that is no folder, can not be written to, or
 * holds the results of a run (unless `force`). Returns an exit code. */
int output_check(const char *folder, bool force);

/* Makes DIR, with its parents, and the temporary folder in it. Returns an exit code. */
int output_open(cli_output *out, const char *folder);

/* Where to write the file that shall be DIR/name. NULL without memory. End with free. */
char *output_path(const cli_output *out, const char *name);

/* Gives every file its final name, in place of those of an earlier run; run.json is the
 * last, so that a folder with it is whole. Returns an exit code. */
int output_commit(cli_output *out);

/* Removes what is still temporary, and folders made for it that are empty. */
void output_close(cli_output *out);

/* A name beside `path`, with the same end, to write it under until it is whole. NULL
 * without memory. End with free. */
char *temporary_name(const char *path);

#endif
