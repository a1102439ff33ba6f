/* Checkpoints of a run: the state of the evolution and of the program. All functions are
 * collective: rank 0 handles the results, and each rank its part of the file. */
#ifndef RUN_CHECKPOINT_H
#define RUN_CHECKPOINT_H

#include "run/run.h"

/* Writes a checkpoint of the last step, unless there is one, after all scales so far are
 * drawn. A checkpoint that cannot be written is a warning, printed for the first of
 * several in a row. Returns an exit code: EXIT_FAILED only when the drawing has
 * failed. */
int checkpoint_save(cli_run *run);

/* Whether the next checkpoint is due by rank 0's clock: --checkpoint seconds after the
 * last. */
bool checkpoint_is_due(const cli_run *run);

/* Restores the state of the checkpoint in the run's folder. The run has a new evolution,
 * and on rank 0 an open folder and a drawing. Returns an exit code, the same on all
 * ranks. */
int checkpoint_resume(cli_run *run);

#endif
