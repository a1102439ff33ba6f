/* How a run ends: its last results, and what is printed about them. */
#ifndef RUN_FINISH_H
#define RUN_FINISH_H

#include "run/run.h"

/* A run that did not come to the end of its scales can go on later. */
bool finish_can_go_on(const cli_run *run);

/* Waits for the drawing, and says why when it has drawn nothing. Of rank 0. Returns an
 * exit code. */
int finish_drawing(cli_run *run);

/* All that is left to do after the evolution: the drawing, the report, the results' own
 * names, the summary. Of rank 0. Returns an exit code. */
int finish_run(cli_run *run);

/* The second line of the complaint that `code` goes with, where a checkpoint makes it
 * worth while. */
void finish_advise(const cli_run *run, int code, bool resumable);

#endif
