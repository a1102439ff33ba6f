/* The processes that work together on one field.
 *
 * An error of MPI itself ends the program, on all ranks: there is no telling in which
 * state the others are. */
#ifndef FG__RANKS_H
#define FG__RANKS_H

#include "base/context.h"
#include "grid/counters.h"

typedef struct fg__transport fg__transport;

/* A group of ranks; a rank's number goes from 0 to count - 1. */
typedef struct fg__ranks {
  int rank, count;
  fg__counters *counters; /* of what this rank sends; NULL: not kept */
  const fg__transport
      *transport; /* how (transport.h), and between whom; NULL: there is */
  void *group;    /* one rank, which sends nothing */
} fg__ranks;

/* The ranks that share what is made with a context; this process alone where it has none
 * (NULL: neither). They live as long as the context. */
const fg__ranks *fg__ranks_of(const fg_context *context);

/* This process alone, whatever the others do. */
extern const fg__ranks fg__single_rank;

/* Makes a context's work that of these ranks, whose transport frees them with the
 * context. */
void fg__ranks_share(fg_context *context, fg__ranks *ranks);

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

/* Sends `count` floats to a rank and receives as many from one; either may be -1, nobody.
 * Messages of different tags are told apart. */
void fg__ranks_swap(const fg__ranks *ranks, int tag, int count, const float *sent, int to,
                    float *received, int from);

/* Brings all ranks' pieces to every rank: rank r's counts[r] floats come to offsets[r].
 * Collective. */
void fg__ranks_gather(const fg__ranks *ranks, const float *sent, float *received,
                      const int counts[], const int offsets[]);

/* Brings a piece from each rank to each: sent_counts[r] elements of `size` bytes to rank
 * r, counts[r] from it. Collective. */
void fg__ranks_deal(const fg__ranks *ranks, size_t size, const void *sent,
                    const int sent_counts[], const int sent_offsets[], void *received,
                    const int counts[], const int offsets[]);

/* Messages under way: an array of requests, to be freed, or NULL without memory. Between
 * the start of number n and the end of the wait its floats are the message's; 0 floats
 * are no message. */
void *fg__requests_create(const fg__ranks *ranks, int count);
void fg__request_send(const fg__ranks *ranks, void *requests, int n, const float *sent,
                      int count, int to);
void fg__request_receive(const fg__ranks *ranks, void *requests, int n, float *received,
                         int count, int from);
void fg__requests_wait(const fg__ranks *ranks, void *requests, int count);

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
