#include "base/threads.h"

void fg__threads_exchange(const fg__thread *thread, unsigned occasion)
{
  if (!thread->threads && thread->exchange)
    thread->exchange(thread->argument, occasion);
  else
    fg__threads_barrier(thread);
}

void fg__threads_range(const fg__thread *thread, int count, int multiple, int *begin,
                       int *end)
{
  int64_t units = ((int64_t)count + multiple - 1) / multiple;
  *begin = (int)(units * thread->index / thread->count) * multiple;
  *end = (int)(units * (thread->index + 1) / thread->count) * multiple;
  if (*end > count)
    *end = count;
}
