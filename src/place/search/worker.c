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

fg_status fg__place_find_near(fg__place_worker *worker, const fg__place_box *box,
                              int except)
{
  const fg__place_search *search = worker->search;
  int most = 0;
  worker->near_count = 0;
  if (!fg__grow((void **)&worker->near, &worker->near_capacity, (size_t)search->count,
                sizeof *worker->near))
    return FG_STATUS_MEMORY;
  for (int n = 0; n < search->count; ++n)
    if (n != except && fg__place_boxes_meet(box, &search->box[n])) {
      worker->near[worker->near_count++] = n;
      most += search->icon[n]->line.count;
    }
  fg_status status =
      fg__place_points_start(&worker->beside, NULL, search->scale.dimension, most);
  for (int n = 0; n < worker->near_count && status == FG_STATUS_OK; ++n)
    fg__place_points_add(&worker->beside, &search->icon[worker->near[n]]->line);
  return status;
}

fg_status fg__place_gather(fg__place_worker *worker, const fg__place_box *box, int except)
{
  const fg__place_search *search = worker->search;
  fg_status status = fg__place_find_near(worker, box, except);
  if (status == FG_STATUS_OK)
    status = fg__place_contribution_start(&worker->others, NULL, search->scale.dimension,
                                          box, (float)fg__place_reach(search));
  for (int n = 0; n < worker->near_count && status == FG_STATUS_OK; ++n)
    fg__place_contribution_add(&worker->others,
                               &search->icon[worker->near[n]]->contribution);
  return status;
}

fg_status fg__place_diffusion_cost(double *cost, fg__place_worker *worker,
                                   const fg__place_line *from, const fg__place_line *to)
{
  const fg__place_search *search = worker->search;
  fg_status status =
      fg__place_diffusion_try(cost, &worker->window, &search->diffusion, NULL, from, to);
  *cost *= search->scale.diffusion * (double)search->weights.inverse_error;
  return status;
}

fg_status fg__place_check(const fg__place_search *search, fg_status status)
{
  return status == FG_STATUS_OK
             ? status
             : fg__fail(search->context, status, "out of memory for trials of arrows");
}

/* Sees to it that each thread beside the caller has a worker. */
static bool engage(fg__place_search *search, int threads)
{
  const size_t before = search->helper_count;
  if (!fg__grow((void **)&search->helper, &search->helper_count, (size_t)threads - 1,
                sizeof *search->helper))
    return false;
  for (size_t n = before; n < search->helper_count; ++n)
    search->helper[n] = (fg__place_worker){.search = search};
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
      thread->index > 0 ? &search->helper[thread->index - 1] : &search->own;
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
    return fg__place_check(search, FG_STATUS_MEMORY);
  fg__threads_run(threads, work, &all);
  return fg__place_check(search,
                         atomic_load(&all.failed) ? FG_STATUS_MEMORY : FG_STATUS_OK);
}
