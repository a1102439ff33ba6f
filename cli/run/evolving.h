/* Sends densities to the process that shows the run (view/child.h). */
#ifndef RUN_EVOLVING_H
#define RUN_EVOLVING_H

#include "run/run.h"

/* Sends the current density, at increasing intervals (clusters grow ever more slowly),
 * and at the end. Does nothing without a socket. */
void evolving_show(cli_run *run);

#endif
