/* The density while it evolves, for a page that follows the run (view/child.h). */
#ifndef RUN_EVOLVING_H
#define RUN_EVOLVING_H

#include "run/run.h"

/* Tells the page how the density is now, at times ever farther apart, as clusters grow
 * ever slower, and at the end. Where nobody is told it does nothing. */
void evolving_show(cli_run *run);

#endif
