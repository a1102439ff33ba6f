#include "base/threads.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/memory.h"

/* Work comes in pieces of some hundred microseconds, one after the other: a thread looks
 * for the next one for about that long before it sleeps. Looking in turn with the system
 * keeps more threads than cores going. */
enum { LOOKS_BEFORE_SLEEP = 20000, LOOKS_BEFORE_YIELD = 500, CACHE_LINE = 64 };

/* Between two looks of a thread that has waited at a barrier for LOOKS_BEFORE_SLEEP. */
enum { NAP_NANOSECONDS = 100000 };

struct fg__threads {
  int thread_count;
  pthread_t *thread;
  int started; /* threads */
  fg__threads_work *work;
  void *argument;
  pthread_mutex_t mutex;
  pthread_cond_t wake;
  int sleepers;
  bool finished;
  _Alignas(CACHE_LINE) atomic_uint round;   /* pieces of work given out */
  _Alignas(CACHE_LINE) atomic_uint arrived; /* at the barrier */
  _Alignas(CACHE_LINE) atomic_uint phase;   /* barriers passed */
};

typedef struct start {
  fg__threads *threads;
  int index;
} start;

int fg__threads_available(void)
{
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  return cores < 1 ? 1 : cores > FG__MOST_THREADS ? FG__MOST_THREADS : (int)cores;
}

static inline void pause_briefly(unsigned look)
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
  if (look % LOOKS_BEFORE_YIELD == LOOKS_BEFORE_YIELD - 1)
    sched_yield();
}

void fg__threads_barrier(const fg__thread *thread)
{
  fg__threads *threads = thread->threads;
  if (!threads || thread->count == 1)
    return;
  unsigned phase = atomic_load_explicit(&threads->phase, memory_order_relaxed);
  unsigned before = atomic_fetch_add_explicit(&threads->arrived, 1, memory_order_acq_rel);
  if (before + 1 == (unsigned)threads->thread_count) {
    atomic_store_explicit(&threads->arrived, 0, memory_order_relaxed);
    atomic_store_explicit(&threads->phase, phase + 1, memory_order_release);
    return;
  }
  for (unsigned look = 0;
       atomic_load_explicit(&threads->phase, memory_order_acquire) == phase; ++look)
    if (look < LOOKS_BEFORE_SLEEP)
      pause_briefly(look);
    else /* the work is coarse: the others are far behind */
      nanosleep(&(struct timespec){.tv_nsec = NAP_NANOSECONDS}, NULL);
}

/* Waits until there is a piece of work other than `seen`; false when there will be none.
 */
static bool await_work(fg__threads *threads, unsigned seen)
{
  for (unsigned look = 0; look < LOOKS_BEFORE_SLEEP; ++look) {
    if (atomic_load_explicit(&threads->round, memory_order_acquire) != seen)
      return !threads->finished;
    pause_briefly(look);
  }
  pthread_mutex_lock(&threads->mutex);
  ++threads->sleepers;
  while (atomic_load_explicit(&threads->round, memory_order_acquire) == seen)
    pthread_cond_wait(&threads->wake, &threads->mutex);
  --threads->sleepers;
  bool more = !threads->finished;
  pthread_mutex_unlock(&threads->mutex);
  return more;
}

static void *member_main(void *argument)
{
  start mine = *(start *)argument;
  free(argument);
  fg__thread thread = {
      .threads = mine.threads, .index = mine.index, .count = mine.threads->thread_count};
  for (unsigned seen = 0; await_work(mine.threads, seen); ++seen) {
    mine.threads->work(mine.threads->argument, &thread);
    fg__threads_barrier(&thread);
  }
  return NULL;
}

static void give_out(fg__threads *threads)
{
  pthread_mutex_lock(&threads->mutex);
  atomic_fetch_add_explicit(&threads->round, 1, memory_order_release);
  if (threads->sleepers > 0)
    pthread_cond_broadcast(&threads->wake);
  pthread_mutex_unlock(&threads->mutex);
}

void fg__threads_run(fg__threads *threads, fg__threads_work *work, void *argument)
{
  if (!threads) {
    fg__thread alone = fg__single_thread();
    work(argument, &alone);
    return;
  }
  threads->work = work;
  threads->argument = argument;
  give_out(threads);
  fg__thread thread = {.threads = threads, .count = threads->thread_count};
  work(argument, &thread);
  fg__threads_barrier(&thread);
}

static bool start_thread(fg__threads *threads, int index)
{
  start *argument = malloc(sizeof *argument);
  if (!argument)
    return false;
  *argument = (start){threads, index};
  if (pthread_create(&threads->thread[index - 1], NULL, member_main, argument) == 0)
    return true;
  free(argument);
  return false;
}

fg_status fg__threads_create(fg__threads **out, fg_context *context, int thread_count)
{
  *out = NULL;
  if (thread_count <= 1)
    return FG_STATUS_OK;
  if (thread_count > FG__MOST_THREADS)
    thread_count = FG__MOST_THREADS;
  fg__threads *threads = fg__allocate_aligned(1, sizeof *threads);
  pthread_t *handles = fg__allocate((size_t)thread_count, sizeof *handles);
  if (!threads || !handles) {
    free(threads);
    free(handles);
    return fg__fail_memory(context, "threads", (size_t)thread_count * sizeof *handles);
  }
  threads->thread_count = thread_count;
  threads->thread = handles;
  pthread_mutex_init(&threads->mutex, NULL);
  pthread_cond_init(&threads->wake, NULL);
  while (threads->started < thread_count - 1 &&
         start_thread(threads, threads->started + 1))
    ++threads->started;
  if (threads->started < thread_count - 1) {
    int started = threads->started;
    fg__threads_destroy(threads);
    return fg__fail(context, FG_STATUS_MEMORY, "only %d of %d threads could be started",
                    started + 1, thread_count);
  }
  *out = threads;
  return FG_STATUS_OK;
}

void fg__threads_destroy(fg__threads *threads)
{
  if (!threads)
    return;
  threads->finished = true;
  give_out(threads);
  for (int n = 0; n < threads->started; ++n)
    pthread_join(threads->thread[n], NULL);
  pthread_mutex_destroy(&threads->mutex);
  pthread_cond_destroy(&threads->wake);
  free(threads->thread);
  free(threads);
}

int fg__threads_count(const fg__threads *threads)
{
  return threads ? threads->thread_count : 1;
}
