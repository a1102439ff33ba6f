/* Checkpoints of a run: the evolution's state, and the program's own beside it. All
 * collective: rank 0 sees to the results, and every rank to its part of the file. */
#ifndef RUN_CHECKPOINT_H
#define RUN_CHECKPOINT_H

#include "run/run.h"

/* Writes a checkpoint of the last step, unless there is one, after the scales so far are
 * drawn. One that can not be written is a warning, at the first of several in a row.
 * Returns an exit code: failed only when the drawing has. */
int checkpoint_save(cli_run *run);

/* Says whether the next one is due by rank 0's clock: --checkpoint seconds after the
 * last.
 */
bool checkpoint_is_due(const cli_run *run);

/* Puts a run with a new evolution, and on rank 0 with a folder and a drawing, into the
 * state of the checkpoint in its folder. Returns an exit code, the same on all. */
int checkpoint_resume(cli_run *run);

#endif
