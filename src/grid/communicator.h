/* What MPI calls a group of ranks; for src/grid only. */
#ifndef FG__COMMUNICATOR_H
#define FG__COMMUNICATOR_H

#include <mpi.h>

#include "grid/ranks.h"

/* The communicator of ranks; its messages are this library's alone. */
MPI_Comm fg__communicator(const fg__ranks *ranks);

#endif
