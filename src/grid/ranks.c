#include "grid/ranks.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/transport.h"

#undef fg__ranks_agree /* for the analyzer also a macro */

static void end_sharing(void *shared)
{
  const fg__ranks *ranks = shared;
  ranks->transport->end(ranks->group);
}

void fg__ranks_share(fg_context *context, fg__ranks *ranks)
{
  fg__context_share(context, ranks, end_sharing);
}

const fg__ranks fg__single_rank = {.count = 1};

const fg__ranks *fg__ranks_of(const fg_context *context)
{
  const fg__ranks *shared = fg__context_shared(context);
  return shared ? shared : &fg__single_rank;
}

void fg__ranks_add(const fg__ranks *ranks, uint64_t *sum, int count)
{
  if (!ranks->transport)
    return;
  fg__count_reduction(ranks->counters, (size_t)count * sizeof *sum);
  ranks->transport->add(ranks->group, sum, count);
}

void fg__ranks_combine(const fg__ranks *ranks, uint32_t *word, int count)
{
  if (!ranks->transport)
    return;
  fg__count_reduction(ranks->counters, (size_t)count * sizeof *word);
  ranks->transport->combine(ranks->group, word, count);
}

void fg__ranks_greatest(const fg__ranks *ranks, double *value, int count)
{
  if (!ranks->transport)
    return;
  fg__count_reduction(ranks->counters, (size_t)count * sizeof *value);
  ranks->transport->greatest(ranks->group, value, count);
}

bool fg__ranks_alike(const fg__ranks *ranks, uint64_t number)
{
  if (!ranks->transport)
    return true;
  uint64_t ends[] = {number, ~number}; /* the greatest complement is the least's */
  fg__count_reduction(ranks->counters, sizeof ends);
  ranks->transport->greatest_word(ranks->group, ends, 2);
  return ends[0] == ~ends[1];
}

enum { PIECE_BYTES = 1 << 16 };

static void take_pieces(const unsigned char *bytes, size_t count, fg__taker *take,
                        void *closure)
{
  for (size_t at = 0; at < count; at += PIECE_BYTES)
    take(closure, bytes + at, count - at < PIECE_BYTES ? count - at : PIECE_BYTES);
}

void fg__ranks_pass(const fg__ranks *ranks, const void *bytes, size_t count,
                    fg__taker *take, void *closure)
{
  unsigned char piece[PIECE_BYTES];
  const unsigned char *own = bytes ? bytes : piece;
  if (ranks->rank > 0) {
    for (size_t at = 0; at <= count; at += PIECE_BYTES) { /* a short one ends them */
      size_t bytes_now = count - at < PIECE_BYTES ? count - at : PIECE_BYTES;
      fg__count_message(ranks->counters, bytes_now);
      ranks->transport->send(ranks->group, own + at, (int)bytes_now, 0);
    }
    return;
  }
  take_pieces(own, count, take, closure);
  for (int r = 1; r < ranks->count; ++r)
    for (int received = PIECE_BYTES; received == PIECE_BYTES;) {
      received = ranks->transport->receive(ranks->group, piece, PIECE_BYTES, r);
      if (received > 0)
        take(closure, piece, (size_t)received);
    }
}

/* Replaces what the context holds by what it holds on rank `from`. */
static void broadcast_message(const fg__ranks *ranks, fg_context *context,
                              fg_status status, int from)
{
  enum { TEXT_BYTES = 2048 };
  char text[2][TEXT_BYTES] = {{0}};
  if (ranks->rank == from) {
    snprintf(text[0], TEXT_BYTES, "%s", fg_context_message(context));
    snprintf(text[1], TEXT_BYTES, "%s", fg_context_hint(context));
  }
  ranks->transport->broadcast(ranks->group, text, (int)sizeof text, from);
  fg_context_clear(context);
  fg__fail(context, status, "%s", text[0]);
  if (text[1][0])
    fg__hint(context, "%s", text[1]);
}

fg_status fg__ranks_agree(const fg__ranks *ranks, fg_context *context, fg_status status)
{
  if (!ranks->transport)
    return status;
  int order = status == FG_STATUS_OK        ? INT_MAX
              : status == FG_STATUS_STOPPED ? ranks->count + ranks->rank
                                            : ranks->rank;
  int first[2] = {order, (int)status};
  fg__count_reduction(ranks->counters, sizeof first);
  ranks->transport->first(ranks->group, first);
  if (first[0] == INT_MAX)
    return FG_STATUS_OK;
  broadcast_message(ranks, context, (fg_status)first[1], first[0] % ranks->count);
  return (fg_status)first[1];
}

void fg__ranks_swap(const fg__ranks *ranks, int tag, int count, const float *sent, int to,
                    float *received, int from)
{
  if (ranks->transport)
    ranks->transport->swap(ranks->group, tag, count, sent, to, received, from);
}

void fg__ranks_gather(const fg__ranks *ranks, const float *sent, float *received,
                      const int counts[], const int offsets[])
{
  const int own = counts[ranks->rank];
  if (!ranks->transport)
    memcpy(received, sent, (size_t)own * sizeof *sent);
  else
    ranks->transport->gather(ranks->group, sent, own, received, counts, offsets);
}

void fg__ranks_deal(const fg__ranks *ranks, size_t size, const void *sent,
                    const int sent_counts[], const int sent_offsets[], void *received,
                    const int counts[], const int offsets[])
{
  if (!ranks->transport)
    memcpy(received, sent, (size_t)counts[0] * size);
  else
    ranks->transport->deal(ranks->group, size, sent, sent_counts, sent_offsets, received,
                           counts, offsets);
}

void *fg__requests_create(const fg__ranks *ranks, int count)
{
  return fg__allocate((size_t)count,
                      ranks->transport ? ranks->transport->request_size : 1);
}

void fg__request_send(const fg__ranks *ranks, void *requests, int n, const float *sent,
                      int count, int to)
{
  ranks->transport->begin_send(ranks->group, requests, n, sent, count, to);
}

void fg__request_receive(const fg__ranks *ranks, void *requests, int n, float *received,
                         int count, int from)
{
  ranks->transport->begin_receive(ranks->group, requests, n, received, count, from);
}

void fg__requests_wait(const fg__ranks *ranks, void *requests, int count)
{
  if (count > 0)
    ranks->transport->wait(requests, count);
}

void fg_ranks(const fg_context *context, int *rank, int *count)
{
  const fg__ranks *ranks = fg__ranks_of(context);
  *rank = ranks->rank;
  *count = ranks->count;
}

fg_status fg_ranks_agree(fg_context *context, fg_status status, const char *message,
                         const char *hint)
{
  if (status && message) {
    fg_context_clear(context);
    fg__fail(context, status, "%s", message);
    if (hint)
      fg__hint(context, "%s", hint);
  }
  return fg__ranks_agree(fg__ranks_of(context), context, status);
}
