/* Threads that work on one task at a time and wait for each other at barriers. */
#ifndef FG__THREADS_H
#define FG__THREADS_H

#include "base/context.h"

typedef struct fg__threads fg__threads;

enum { FG__MOST_THREADS = 256 };

/* One thread of several, which takes its share of the work. `threads` is NULL for a
 * thread on its own. A process that shares the work with other ranks has one thread; it
 * calls `exchange` (unless NULL) where its neighbours need values, and says which ones.
 */
typedef struct fg__thread {
  fg__threads *threads;
  int index, count;
  void (*exchange)(void *argument, unsigned occasion);
  void *argument;
} fg__thread;

static inline fg__thread fg__single_thread(void)
{
  return (fg__thread){.count = 1};
}

/* Starts thread_count - 1 threads, which sleep until there is work; the caller is thread
 * 0. *out is NULL when thread_count is 1, and in a build without threads; more than
 * FG__MOST_THREADS are cut to that. MEMORY (no thread to be had counts as such). */
fg_status fg__threads_create(fg__threads **out, fg_context *context, int thread_count);
void fg__threads_destroy(fg__threads *threads);

/* Threads that can run at the same time, 1 to FG__MOST_THREADS. */
int fg__threads_available(void);

/* 1 for NULL. */
int fg__threads_count(const fg__threads *threads);

/* Runs work(argument, thread) in every thread and returns when all are done. NULL is the
 * caller alone. */
typedef void fg__threads_work(void *argument, const fg__thread *thread);
void fg__threads_run(fg__threads *threads, fg__threads_work *work, void *argument);

/* Returns once all threads have called it; memory written before is
 * seen by all after it. Only within fg__threads_run. */
void fg__threads_barrier(const fg__thread *thread);

/* The same for several threads; a single thread calls its exchange. */
void fg__threads_exchange(const fg__thread *thread, unsigned occasion);

/* A thread's part [*begin, *end) of `count` things; begin is a multiple of `multiple`. */
void fg__threads_range(const fg__thread *thread, int count, int multiple, int *begin,
                       int *end);

#endif
