/* The page for browsers of a run. */
#ifndef RUN_PAGE_H
#define RUN_PAGE_H

#include "run/run.h"

/* Writes index.html, where the run has one: once all scales are drawn, whose files the
 * page of a run in 3D holds. Of rank 0. Returns an exit code. */
int page_write(cli_run *run);

#endif
