/* The work of several processes on one field. Not included by flowgrain.h: this header
 * needs MPI's, and is there where the library was built with it (FG_FEATURE_MPI). */
#ifndef FLOWGRAIN_MPI_H
#define FLOWGRAIN_MPI_H

#include <mpi.h>

#include "flowgrain/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Makes the processes of a communicator the ranks that share what is made with this
 * context (context.h says which calls are then collective):
 *
 *     MPI_Init(&argc, &argv);
 *     fg_context_create(&context);
 *     fg_context_set_communicator(context, MPI_COMM_WORLD);
 *
 * Once for a context, before anything is made with it. The library uses a duplicate of
 * the communicator, which ends with the context; it never initialises or finalises MPI.
 * The thread that calls it, and no other, calls what is collective
 * (MPI_THREAD_FUNNELED). An error of MPI in later calls ends the program, since no rank
 * can know the state of the others. A communicator of one process changes nothing.
 * Collective. ARGUMENT (MPI is not initialised, the context has a communicator), MEMORY,
 * MPI. */
FG_API fg_status fg_context_set_communicator(fg_context *context, MPI_Comm communicator);

#ifdef __cplusplus
}
#endif

#endif
