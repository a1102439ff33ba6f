/* Ranks: processes that a launcher such as mpirun started with the same command line.
 * Only rank 0 prints, draws and writes. The others store their complaints until all ranks
 * agree on a failure, which rank 0 then prints. */
#ifndef RANKS_H
#define RANKS_H

#include <stdbool.h>

#include "flowgrain/context.h"

/* Determines this process's rank. Returns an exit code. To be followed by ranks_end on
 * all ranks, also after a failure. */
int ranks_start(void);
void ranks_end(void);

/* Makes work with a context that of all ranks. Collective. Returns an exit code. */
int ranks_share(fg_context *context);

bool ranks_leader(void); /* whether this is rank 0 */
int ranks_number(void);  /* this rank's number, from 0 */
int ranks_count(void);

/* Reduces all ranks' exit codes to one: that of the lowest failed rank; failures take
 * precedence over EXIT_INTERRUPTED. Rank 0 prints the complaint of that rank, unless it
 * has printed one of its own. Collective. */
int ranks_agree(int code);

/* Whether `one` is true on any rank. Collective. */
bool ranks_any(bool one);

#endif
