/* The folder of a run's results. Files are first written to DIR/.flowgrain, with the
 * checkpoint, and move to DIR when the run ends. At whatever time a run is killed,
 * DIR/.flowgrain has all that is needed to resume from the checkpoint. */
#ifndef FOLDER_RESULTS_H
#define FOLDER_RESULTS_H

#include "folder/files.h"

/* The work folder in DIR. */
#define WORK_NAME ".flowgrain"

typedef struct cli_output {
  char *folder;    /* DIR */
  char *work;      /* DIR/.flowgrain */
  char *made_from; /* the topmost folder that output_open created, NULL: none */
  int lock;        /* file descriptor of the lock while the run lasts; -1: none */
} cli_output;

/* Contents of a folder. */
typedef enum output_state {
  OUTPUT_EMPTY,       /* no files of runs */
  OUTPUT_UNFINISHED,  /* a checkpoint to resume from */
  OUTPUT_INTERRUPTED, /* results of an interrupted run without a checkpoint */
  OUTPUT_FINISHED
} output_state;

typedef struct output_contents {
  output_state state;
  char foreign[SCALE_NAME_BYTES]; /* a file with the name of a result that no run has
                                     made; "" */
} output_contents;

/* Refuses a DIR that is no folder, is not writable, or is in use by another run; writes
 * nothing. Not to be called by the run that holds the lock: a process that closes the
 * file loses it. Returns an exit code. */
int output_check(const char *folder);

/* Finds what DIR contains. Returns an exit code. */
int output_inspect(output_contents *out, const char *folder);

/* Creates DIR, its parents and the work folder, and locks it for this run. Returns an
 * exit code. */
int output_open(cli_output *out, const char *folder);

/* Removes files of an earlier run from the work folder. Returns an exit code. */
int output_start_anew(const cli_output *out);

/* Keeps of an earlier run's work folder the checkpoint, the table and the first `scales`
 * scales. Returns an exit code. */
int output_go_on(const cli_output *out, int scales);

/* Renames the previous checkpoint, the only valid one, to the newest; otherwise the next
 * checkpoint would first replace it. Returns an exit code. */
int output_use_previous(const cli_output *out);

/* The path under which DIR/name is written. NULL without memory. To be freed. */
char *output_path(const cli_output *out, const char *name);

/* The path of a run's checkpoint, for any rank (rank 0 alone opens the folder). NULL
 * without memory. To be freed. */
char *output_checkpoint_path(const char *folder);

/* Flushes the scales written so far to disk. Returns an exit code. */
int output_synchronise(const cli_output *out);

/* Moves every file to DIR in place of an earlier run's. run.json is last, so that a
 * folder with it is complete. Refuses to replace files that no run has made. The work
 * folder keeps the files, too, until output_close. Returns an exit code. */
int output_publish(const cli_output *out);

/* Ends the work. If there is a checkpoint and the run is not `finished`, keeps what is
 * needed to resume; otherwise keeps results only, and removes a folder that was created
 * for nothing. Returns whether the run can be resumed. */
bool output_close(cli_output *out, bool finished);

#endif
