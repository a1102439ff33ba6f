/* The processes that work together on one field. */
#ifndef FG__RANKS_H
#define FG__RANKS_H

#include "base/context.h"

/* A group of ranks; a rank's number goes from 0 to count - 1. */
typedef struct fg__ranks {
  int rank, count;
} fg__ranks;

/* All processes that were started together. Starts MPI, unless it runs: quietly, and so
 * that it is finalised when the process ends. Borrowed. Collective in the first call.
 * MPI. */
fg_status fg__ranks_all(const fg__ranks **out, fg_context *context);

/* This process on its own, whatever the others do: MPI and p4est are started likewise. */
fg_status fg__ranks_alone(const fg__ranks **out, fg_context *context);

#endif
