/* What a rank tells the others, counted where it is sent: exact, and by what it is for.
 *
 * A book belongs to the ranks that share it (ranks.h); it is NULL where there is one rank
 * only, which tells nobody anything, and then nothing is counted. One thread of a rank
 * sends. */
#ifndef FG__TRAFFIC_H
#define FG__TRAFFIC_H

#include <stddef.h>

#include "flowgrain/flowgrain.h"

typedef struct fg__traffic_book {
  fg_activity now;
  fg_traffic of[FG_ACTIVITIES]; /* totals since the context has ranks */
} fg__traffic_book;

/* What is sent from now on is for `activity`, begun once more. Returns the former one, to
 * be returned to. */
static inline fg_activity fg__traffic_begin(fg__traffic_book *book, fg_activity activity)
{
  if (!book)
    return activity;
  fg_activity before = book->now;
  book->now = activity;
  book->of[activity].times += 1.0;
  return before;
}

/* The same for what belongs to the last that was begun. */
static inline fg_activity fg__traffic_continue(fg__traffic_book *book,
                                               fg_activity activity)
{
  if (!book)
    return activity;
  fg_activity before = book->now;
  book->now = activity;
  return before;
}

static inline void fg__traffic_return(fg__traffic_book *book, fg_activity before)
{
  if (book)
    book->now = before;
}

/* A round of messages with all neighbours. */
static inline void fg__traffic_add_exchange(fg__traffic_book *book)
{
  if (book)
    book->of[book->now].exchanges += 1.0;
}

/* A message to one other rank. */
static inline void fg__traffic_add_message(fg__traffic_book *book, size_t bytes)
{
  if (!book)
    return;
  book->of[book->now].messages += 1.0;
  book->of[book->now].bytes += (double)bytes;
}

/* All ranks' pieces on every rank: `bytes` are those received from others. */
static inline void fg__traffic_add_gather(fg__traffic_book *book, size_t bytes)
{
  if (!book)
    return;
  book->of[book->now].gathers += 1.0;
  book->of[book->now].gathered += (double)bytes;
}

/* A sum, a greatest value or a first failure over all ranks, of so many bytes. */
static inline void fg__traffic_add_reduction(fg__traffic_book *book, size_t bytes)
{
  if (!book)
    return;
  book->of[book->now].reductions += 1.0;
  book->of[book->now].reduced += (double)bytes;
}

#endif
