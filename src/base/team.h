/* A team of threads that work on one thing at a time, waiting for each other at barriers.
 */
#ifndef FG__TEAM_H
#define FG__TEAM_H

#include "base/context.h"

typedef struct fg__team fg__team;

enum { FG__MOST_MEMBERS = 256 };

/* What one member of a team is given; `team` is NULL for a member on its own. That may be
 * one of several processes that share the work likewise: where members of a team meet it
 * does `meet` (unless NULL) with the occasion, which is between the work and whoever
 * gives it out. */
typedef struct fg__share {
  fg__team *team;
  int member, members;
  void (*meet)(void *argument, unsigned occasion);
  void *argument;
} fg__share;

static inline fg__share fg__alone(void)
{
  return (fg__share){.members = 1};
}

/* Starts members - 1 threads, which sleep until there is work; the caller is member 0.
 * *out is NULL when members is 1, and in a build without threads; more than
 * FG__MOST_MEMBERS are cut to that. MEMORY (no thread to be had counts as such). */
fg_status fg__team_create(fg__team **out, fg_context *context, int members);
void fg__team_destroy(fg__team *team);

/* 1 for NULL. */
int fg__team_members(const fg__team *team);

/* Runs work(argument, share) in every member and returns when all are done. A NULL team
 * is the caller alone. */
typedef void fg__team_work(void *argument, const fg__share *share);
void fg__team_run(fg__team *team, fg__team_work *work, void *argument);

/* Returns once every member of the share's team has called it; memory written before is
 * seen by all after it. Only within fg__team_run. */
void fg__team_barrier(const fg__share *share);

/* The same for a team; a member on its own meets whom its share says. */
void fg__team_meet(const fg__share *share, unsigned occasion);

/* A member's part [*begin, *end) of `count` things; begin is a multiple of `multiple`. */
void fg__team_part(const fg__share *share, int count, int multiple, int *begin, int *end);

#endif
