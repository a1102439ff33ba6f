#include "place/search/search.h"

#include "base/memory.h"

#include <stdatomic.h>
#include <stdlib.h>

void fg__place_worker_clear(fg__place_worker *worker)
{
  fg__place_contribution_clear(&worker->others);
  fg__place_contribution_clear(&worker->trial);
  fg__place_points_clear(&worker->beside);
  fg__place_window_clear(&worker->window);
  free(worker->near);
  *worker = (fg__place_worker){.search = NULL};
}

/* Sees to it that each thread beside the caller has a worker. */
static bool engage(fg__place_search *search, int threads)
{
  const size_t before = search->beside_count;
  if (!fg__grow((void **)&search->beside, &search->beside_count, (size_t)threads - 1,
                sizeof *search->beside))
    return false;
  for (size_t n = before; n < search->beside_count; ++n)
    search->beside[n] = (fg__place_worker){.search = search};
  return true;
}

typedef struct sharing {
  fg__place_search *search;
  fg__place_task *task;
  void *argument;
  int count;
  atomic_int begun, failed;
} sharing;

static void work(void *argument, const fg__thread *thread)
{
  sharing *all = argument;
  fg__place_search *search = all->search;
  fg__place_worker *worker =
      thread->index > 0 ? &search->beside[thread->index - 1] : &search->own;
  int n;
  while ((n = atomic_fetch_add_explicit(&all->begun, 1, memory_order_relaxed)) <
         all->count)
    if (all->task(all->argument, worker, n) != FG_STATUS_OK)
      atomic_store_explicit(&all->failed, 1, memory_order_relaxed);
}

fg_status fg__place_share(fg__place_search *search, fg__place_task *task, void *argument,
                          int count)
{
  sharing all = {.search = search, .task = task, .argument = argument, .count = count};
  fg__threads *threads = count > 1 ? search->threads : NULL;
  if (!engage(search, fg__threads_count(threads)))
    return fg__fail_memory(search->context, "threads that place",
                           (size_t)fg__threads_count(threads) * sizeof *search->beside);
  fg__threads_run(threads, work, &all);
  return atomic_load(&all.failed)
             ? fg__fail_memory(search->context, "a trial of an arrow",
                               sizeof(fg__place_worker))
             : FG_STATUS_OK;
}
