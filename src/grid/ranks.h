/* The processes that work together on one field.
 *
 * An error of MPI itself ends the program, on all ranks: there is no telling in which
 * state the others are. */
#ifndef FG__RANKS_H
#define FG__RANKS_H

#include "base/context.h"
#include "grid/traffic.h"

/* A group of ranks; a rank's number goes from 0 to count - 1. */
typedef struct fg__ranks {
  int rank, count;
  fg__traffic_book *book; /* of what this rank tells the others; NULL: not kept */
} fg__ranks;

/* This process on its own, without MPI: for grids that no other process has a part of. */
extern const fg__ranks fg__single_rank;

/* All processes that were started together. Starts MPI, unless it runs: quietly, and so
 * that it is finalised when the process ends. Borrowed. Collective in the first call.
 * MPI. */
fg_status fg__ranks_all(const fg__ranks **out, fg_context *context);

/* This process on its own, whatever the others do: MPI is started likewise. */
fg_status fg__ranks_alone(const fg__ranks **out, fg_context *context);

/* Adds up whole numbers over all ranks, modulo 2^64, in place: the same bits in any
 * order. Collective. */
void fg__ranks_add(const fg__ranks *ranks, uint64_t *sum, int count);

/* The exclusive or of each word over all ranks, in place. Collective. */
void fg__ranks_combine(const fg__ranks *ranks, uint32_t *word, int count);

/* Greatest of each value over all ranks, in place; none may be NaN. Collective. */
void fg__ranks_greatest(const fg__ranks *ranks, double *value, int count);

/* Whether a number is the same on all ranks. Collective. */
bool fg__ranks_alike(const fg__ranks *ranks, uint64_t number);

/* Brings the bytes of all ranks to rank 0, those of rank 0 first, then those of rank 1:
 * `take` gets them there in pieces of at most 64 KiB. Collective. */
typedef void fg__taker(void *closure, const unsigned char *bytes, size_t count);
void fg__ranks_pass(const fg__ranks *ranks, const void *bytes, size_t count,
                    fg__taker *take, void *closure);

/* Makes one failure of many: when `status` is a failure on some rank, all ranks return
 * the status of the lowest such rank, and every context holds that rank's message and
 * hint in place of its own; the program prints it on rank 0. A stop (FG_STATUS_STOPPED)
 * gives way to any other failure. Collective: a rank that fails must come here before its
 * next message, or the others wait for ever. */
fg_status fg__ranks_agree(const fg__ranks *ranks, fg_context *context, fg_status status);

#if defined(__clang_analyzer__)
/* What the analyzer can not see across files: a failure stays one. */
#define fg__ranks_agree(ranks, context, status)                                          \
  ((status) ? (status) : fg__ranks_agree(ranks, context, status))
#endif

#endif
