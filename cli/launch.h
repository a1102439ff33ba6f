/* What a launcher such as mpirun started: launch_mpi.c, or launch_alone.c in a program
 * without MPI. */
#ifndef LAUNCH_H
#define LAUNCH_H

#include <stdbool.h>

#include "flowgrain/context.h"

/* Initialises MPI where a launcher started this process, and only there: without one the
 * program does not need it. Returns an exit code. */
int launch_start(void);

/* Finalises it. Collective. */
void launch_end(void);

/* Gives a context all that were launched as its ranks. Collective. */
fg_status launch_share(fg_context *context);

#endif
