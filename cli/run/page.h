/* The page for browsers of a run. */
#ifndef RUN_PAGE_H
#define RUN_PAGE_H

#include "run/run.h"

/* Writes index.html, where the run has one, from the files of scales: once all are drawn.
 * Of rank 0. Returns an exit code. */
int page_write(cli_run *run);

#endif
