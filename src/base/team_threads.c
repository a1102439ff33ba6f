#include "base/team.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/memory.h"

/* Work comes in pieces of some hundred microseconds, one after the other: a member looks
 * for the next one for about that long before it sleeps. Looking in turn with the system
 * keeps a team larger than the machine going. */
enum { LOOKS_BEFORE_SLEEP = 20000, LOOKS_BEFORE_YIELD = 500, CACHE_LINE = 64 };

struct fg__team {
  int members;
  pthread_t *thread;
  int started; /* threads */
  fg__team_work *work;
  void *argument;
  pthread_mutex_t mutex;
  pthread_cond_t wake;
  int sleepers;
  bool ending;
  _Alignas(CACHE_LINE) atomic_uint round;   /* pieces of work given out */
  _Alignas(CACHE_LINE) atomic_uint arrived; /* at the barrier */
  _Alignas(CACHE_LINE) atomic_uint phase;   /* barriers passed */
};

typedef struct start {
  fg__team *team;
  int member;
} start;

static inline void pause_briefly(unsigned look)
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
  if (look % LOOKS_BEFORE_YIELD == LOOKS_BEFORE_YIELD - 1)
    sched_yield();
}

void fg__team_barrier(const fg__share *share)
{
  fg__team *team = share->team;
  if (!team || share->members == 1)
    return;
  unsigned phase = atomic_load_explicit(&team->phase, memory_order_relaxed);
  unsigned before = atomic_fetch_add_explicit(&team->arrived, 1, memory_order_acq_rel);
  if (before + 1 == (unsigned)team->members) {
    atomic_store_explicit(&team->arrived, 0, memory_order_relaxed);
    atomic_store_explicit(&team->phase, phase + 1, memory_order_release);
    return;
  }
  for (unsigned look = 0;
       atomic_load_explicit(&team->phase, memory_order_acquire) == phase; ++look)
    pause_briefly(look);
}

/* Waits until there is a piece of work other than `seen`; false when there will be none.
 */
static bool await_work(fg__team *team, unsigned seen)
{
  for (unsigned look = 0; look < LOOKS_BEFORE_SLEEP; ++look) {
    if (atomic_load_explicit(&team->round, memory_order_acquire) != seen)
      return !team->ending;
    pause_briefly(look);
  }
  pthread_mutex_lock(&team->mutex);
  ++team->sleepers;
  while (atomic_load_explicit(&team->round, memory_order_acquire) == seen)
    pthread_cond_wait(&team->wake, &team->mutex);
  --team->sleepers;
  bool more = !team->ending;
  pthread_mutex_unlock(&team->mutex);
  return more;
}

static void *member_main(void *argument)
{
  start mine = *(start *)argument;
  free(argument);
  fg__share share = {
      .team = mine.team, .member = mine.member, .members = mine.team->members};
  for (unsigned seen = 0; await_work(mine.team, seen); ++seen) {
    mine.team->work(mine.team->argument, &share);
    fg__team_barrier(&share);
  }
  return NULL;
}

static void give_out(fg__team *team)
{
  pthread_mutex_lock(&team->mutex);
  atomic_fetch_add_explicit(&team->round, 1, memory_order_release);
  if (team->sleepers > 0)
    pthread_cond_broadcast(&team->wake);
  pthread_mutex_unlock(&team->mutex);
}

void fg__team_run(fg__team *team, fg__team_work *work, void *argument)
{
  if (!team) {
    fg__share alone = fg__alone();
    work(argument, &alone);
    return;
  }
  team->work = work;
  team->argument = argument;
  give_out(team);
  fg__share share = {.team = team, .members = team->members};
  work(argument, &share);
  fg__team_barrier(&share);
}

static bool start_thread(fg__team *team, int member)
{
  start *argument = malloc(sizeof *argument);
  if (!argument)
    return false;
  *argument = (start){team, member};
  if (pthread_create(&team->thread[member - 1], NULL, member_main, argument) == 0)
    return true;
  free(argument);
  return false;
}

fg_status fg__team_create(fg__team **out, fg_context *context, int members)
{
  *out = NULL;
  if (members <= 1)
    return FG_STATUS_OK;
  if (members > FG__MOST_MEMBERS)
    members = FG__MOST_MEMBERS;
  fg__team *team = fg__allocate_aligned(1, sizeof *team);
  pthread_t *threads = fg__allocate((size_t)members, sizeof *threads);
  if (!team || !threads) {
    free(team);
    free(threads);
    return fg__fail_memory(context, "threads", (size_t)members * sizeof *threads);
  }
  team->members = members;
  team->thread = threads;
  pthread_mutex_init(&team->mutex, NULL);
  pthread_cond_init(&team->wake, NULL);
  while (team->started < members - 1 && start_thread(team, team->started + 1))
    ++team->started;
  if (team->started < members - 1) {
    int started = team->started;
    fg__team_destroy(team);
    return fg__fail(context, FG_STATUS_MEMORY, "only %d of %d threads could be started",
                    started + 1, members);
  }
  *out = team;
  return FG_STATUS_OK;
}

void fg__team_destroy(fg__team *team)
{
  if (!team)
    return;
  team->ending = true;
  give_out(team);
  for (int n = 0; n < team->started; ++n)
    pthread_join(team->thread[n], NULL);
  pthread_mutex_destroy(&team->mutex);
  pthread_cond_destroy(&team->wake);
  free(team->thread);
  free(team);
}

int fg__team_members(const fg__team *team)
{
  return team ? team->members : 1;
}
