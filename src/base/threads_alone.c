/* Teams in a build without threads (FLOWGRAIN_THREADS=OFF): the caller alone. */
#include "base/threads.h"

fg_status fg__threads_create(fg__threads **out, fg_context *context, int thread_count)
{
  (void)context;
  (void)thread_count;
  *out = NULL;
  return FG_STATUS_OK;
}

void fg__threads_destroy(fg__threads *threads)
{
  (void)threads;
}

int fg__threads_available(void)
{
  return 1;
}

int fg__threads_count(const fg__threads *threads)
{
  (void)threads;
  return 1;
}

void fg__threads_run(fg__threads *threads, fg__threads_work *work, void *argument)
{
  (void)threads;
  fg__thread alone = fg__single_thread();
  work(argument, &alone);
}

void fg__threads_barrier(const fg__thread *thread)
{
  (void)thread;
}
