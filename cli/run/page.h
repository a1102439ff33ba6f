/* The page of a run for browsers. */
#ifndef RUN_PAGE_H
#define RUN_PAGE_H

#include "run/run.h"

/* Writes index.html, if the run has one, from the files of its scales, after all are
 * drawn. Rank 0. Returns an exit code. */
int page_write(cli_run *run);

#endif
