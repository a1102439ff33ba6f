/* Communication counters: messages are counted exactly where they are sent, by phase.
 *
 * Counters belong to the ranks that share them (ranks.h); they are NULL with one rank,
 * and then nothing is counted. One thread of a rank sends. */
#ifndef FG__COUNTERS_H
#define FG__COUNTERS_H

#include <stddef.h>

#include "flowgrain/flowgrain.h"

typedef struct fg__counters {
  fg_phase now;
  fg_communication of[FG_PHASES]; /* totals since the context has ranks */
} fg__counters;

/* Begins a phase: what is sent from now on counts for it. Returns the former phase. */
static inline fg_phase fg__phase_begin(fg__counters *counters, fg_phase phase)
{
  if (!counters)
    return phase;
  fg_phase before = counters->now;
  counters->now = phase;
  counters->of[phase].times += 1.0;
  return before;
}

/* The same without counting the phase as begun again. */
static inline fg_phase fg__phase_continue(fg__counters *counters, fg_phase phase)
{
  if (!counters)
    return phase;
  fg_phase before = counters->now;
  counters->now = phase;
  return before;
}

static inline void fg__phase_return(fg__counters *counters, fg_phase before)
{
  if (counters)
    counters->now = before;
}

/* A round of messages with all neighbours. */
static inline void fg__count_exchange(fg__counters *counters)
{
  if (counters)
    counters->of[counters->now].exchanges += 1.0;
}

/* A message to one other rank. */
static inline void fg__count_message(fg__counters *counters, size_t bytes)
{
  if (!counters)
    return;
  counters->of[counters->now].messages += 1.0;
  counters->of[counters->now].bytes += (double)bytes;
}

/* A gather on every rank: `bytes` are those received from others. */
static inline void fg__count_gather(fg__counters *counters, size_t bytes)
{
  if (!counters)
    return;
  counters->of[counters->now].gathers += 1.0;
  counters->of[counters->now].gathered += (double)bytes;
}

/* A sum, a greatest value or a first failure over all ranks, of so many bytes. */
static inline void fg__count_reduction(fg__counters *counters, size_t bytes)
{
  if (!counters)
    return;
  counters->of[counters->now].reductions += 1.0;
  counters->of[counters->now].reduced += (double)bytes;
}

#endif
