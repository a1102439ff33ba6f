#include <stdlib.h>

#include "base/memory.h"
#include "base/threads.h"
#include "brush/layer.h"

/* Clusters whose lines are to be found; each thread takes every so manyth. */
typedef struct search {
  const fg_density_arrays *density;
  const fg__labels *labels;
  const fg__brush_canvas *image;
  const fg__line_rule *rule;
  fg__brush_line *line;
  fg_context *context;               /* the caller's */
  fg_context *own[FG__MOST_THREADS]; /* a context is for one thread */
  fg_status status[FG__MOST_THREADS];
} search;

static fg_status find_line(const search *s, fg_context *context, int cluster)
{
  fg__window window;
  fg_status status = fg__window_create(&window, context, s->density, s->labels, cluster);
  if (status)
    return status;
  status = fg__line_create(&s->line[cluster - 1], context, &window, s->image, s->rule);
  fg__window_clear(&window);
  return status;
}

static void find_part(void *argument, const fg__thread *thread)
{
  search *s = argument;
  int index = thread->index;
  fg_status status = FG_STATUS_OK;
  for (int cluster = 1 + index; cluster <= s->labels->count && !status;
       cluster += thread->count) {
    if (index == 0)
      status = fg__check_stop(s->context);
    if (!status)
      status = find_line(s, s->own[index], cluster);
  }
  s->status[index] = status;
}

static fg_status find_lines(search *s, fg__threads *threads)
{
  int thread_count = fg__threads_count(threads), made = 0;
  fg_status status = FG_STATUS_OK;
  for (; made < thread_count && !status; ++made)
    status = fg_context_create(&s->own[made]);
  if (status)
    status = fg__fail_memory(s->context, "a context", 0);
  else
    fg__threads_run(threads, find_part, s);
  for (int n = 0; n < made; ++n) {
    if (!status && s->status[n])
      status =
          s->status[n] == FG_STATUS_STOPPED
              ? s->status[n]
              : fg__fail(s->context, s->status[n], "%s", fg_context_message(s->own[n]));
    fg_context_destroy(s->own[n]);
  }
  return status;
}

fg_status fg__layer_lines(fg__brush_line **lines, int *count, fg_context *context,
                          const fg_density *density, const fg__brush_canvas *image,
                          const fg__line_rule *rule, int thread_count)
{
  fg__labels labels;
  fg__threads *threads = NULL;
  *lines = NULL;
  fg_status status = fg__labels_create(&labels, context, density);
  if (status)
    return status;
  search *s = fg__allocate(1, sizeof *s);
  fg__brush_line *found = fg__allocate((size_t)labels.count + 1, sizeof *found);
  *count = labels.count;
  if (!s || !found)
    status = fg__fail_memory(context, "strokes", (size_t)labels.count * sizeof *found);
  else
    status = fg__threads_create(&threads, context, thread_count);
  if (!status) {
    *s = (search){.density = fg_density_contents(density),
                  .labels = &labels,
                  .image = image,
                  .rule = rule,
                  .line = found,
                  .context = context};
    status = find_lines(s, threads);
  }
  fg__threads_destroy(threads);
  fg__labels_clear(&labels);
  free(s);
  if (status)
    free(found);
  else
    *lines = found;
  return status;
}
