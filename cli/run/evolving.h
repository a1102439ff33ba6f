/* The density while it evolves, sent to the process that shows it (view/child.h). */
#ifndef RUN_EVOLVING_H
#define RUN_EVOLVING_H

#include "run/run.h"

/* Sends the present density, at intervals that grow, as clusters grow ever slower, and at
 * the end. Without a socket it does nothing. */
void evolving_show(cli_run *run);

#endif
