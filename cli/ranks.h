/* Ranks: several processes that a launcher such as mpirun started with the same command
 * line. Rank 0 alone prints, draws and writes; the others keep their complaints until all
 * agree on a failure, which rank 0 then prints. */
#ifndef RANKS_H
#define RANKS_H

#include <stdbool.h>

#include "flowgrain/context.h"

/* Finds out which rank this is. Returns an exit code. Ended at last, by all ranks,
 * whatever it returned. */
int ranks_start(void);
void ranks_end(void);

/* Makes what a context is used for the work of all ranks. Collective. Returns an exit
 * code. */
int ranks_share(fg_context *context);

bool ranks_leader(void); /* this is rank 0, maybe the only one */
int ranks_number(void);  /* this one's, from 0 */
int ranks_count(void);

/* Makes one exit code of all ranks': that of the lowest rank that failed;
 * EXIT_INTERRUPTED gives way to failures. Rank 0 prints the complaint of that rank,
 * unless it has printed one of its own. Every rank must come here, or the others
 * wait for ever. */
int ranks_agree(int code);

/* Whether it is so on any rank; collective likewise. */
bool ranks_any(bool one);

#endif
