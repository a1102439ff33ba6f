/* The end of a run: last results, and what is printed about them. */
#ifndef RUN_FINISH_H
#define RUN_FINISH_H

#include "run/run.h"

/* Whether the run ended before its last scale and can be resumed. */
bool finish_can_go_on(const cli_run *run);

/* Waits for the drawing, and prints an error when it has drawn nothing. Rank 0. Returns
 * an exit code. */
int finish_drawing(cli_run *run);

/* Everything after the evolution: drawing, report, moving results to their place,
 * summary. Rank 0. Returns an exit code. */
int finish_run(cli_run *run);

/* Prints as second line of a complaint that --resume continues the run, if it can. */
void finish_advise(const cli_run *run, int code, bool resumable);

#endif
