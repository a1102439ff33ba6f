/* Processes started by a launcher such as mpirun: launch_mpi.c, or launch_alone.c in a
 * program without MPI. */
#ifndef LAUNCH_H
#define LAUNCH_H

#include <stdbool.h>

#include "flowgrain/context.h"

/* Initialises MPI if a launcher started this process. Returns an exit code. */
int launch_start(void);

/* Finalises it. Collective. */
void launch_end(void);

/* Makes all launched processes the ranks of a context. Collective. */
fg_status launch_share(fg_context *context);

#endif
