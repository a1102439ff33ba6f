/* The folder of a run's results. Everything is written to DIR/.flowgrain first, together
 * with the checkpoint, and takes its place in DIR when the run ends. Whatever the time
 * at which a run is killed, DIR/.flowgrain then has all to go on from the checkpoint. */
#ifndef FOLDER_RESULTS_H
#define FOLDER_RESULTS_H

#include "folder/files.h"

/* The folder of the work in DIR. */
#define WORK_NAME ".flowgrain"

typedef struct cli_output {
  char *folder;    /* DIR */
  char *work;      /* DIR/.flowgrain */
  char *made_from; /* the topmost folder that output_open made, NULL: none */
  int lock;        /* held while the run lasts; -1: not held */
} cli_output;

/* What a folder holds. */
typedef enum output_state {
  OUTPUT_EMPTY,       /* nothing that counts */
  OUTPUT_UNFINISHED,  /* a checkpoint to go on from */
  OUTPUT_INTERRUPTED, /* results of an interrupted run, and no checkpoint */
  OUTPUT_FINISHED
} output_state;

typedef struct output_contents {
  output_state state;
  char
      foreign[SCALE_NAME_BYTES]; /* a file named like a result that no run has made; "" */
} output_contents;

/* Refuses, with nothing written, a DIR that is no folder or can not be written to, and
 * one that another run is writing to. Not to be called by the run that does (a process
 * that closes a file loses its lock). Returns an exit code. */
int output_check(const char *folder);

/* Says what DIR holds. Returns an exit code. */
int output_look(output_contents *out, const char *folder);

/* Makes DIR, with its parents, and the folder of the work in it, for this run alone.
 * Returns an exit code. */
int output_open(cli_output *out, const char *folder);

/* Forgets what an earlier run left in the folder of the work. Returns an exit code. */
int output_start_anew(const cli_output *out);

/* Keeps, of what an earlier run left there, the checkpoint, the table and the first
 * `scales` scales. Returns an exit code. */
int output_go_on(const cli_output *out, int scales);

/* Gives the previous checkpoint, which is the one that is whole, the name of the newest:
 * the next one to be written would else take its place before it has a name itself.
 * Returns an exit code. */
int output_use_previous(const cli_output *out);

/* Where to write the file that shall be DIR/name. NULL without memory. End with free. */
char *output_path(const cli_output *out, const char *name);

/* Where the checkpoint of a run with the results' folder DIR is, for any rank: rank 0
 * alone opens the folder. NULL without memory. End with free. */
char *output_checkpoint_path(const char *folder);

/* Brings the scales written so far to the disk. Returns an exit code. */
int output_synchronise(const cli_output *out);

/* Gives every file its place in DIR, instead of those of an earlier run; run.json is the
 * last, so that a folder with it is whole. Refuses where that would replace what no run
 * has made. The folder of the work keeps the files too, until output_close. Returns an
 * exit code. */
int output_publish(const cli_output *out);

/* Ends the work. Where there is a checkpoint, and the run is not `finished`, all that is
 * needed to go on from it stays; else nothing but the results, and no folder that was
 * made for nothing. Returns whether the run can go on. */
bool output_close(cli_output *out, bool finished);

#endif
