#include "icon/icons_make.h"

#include "icon/icons.h"
#include "icon/make.h"
#include "icon/slender.h"

#include "base/memory.h"
#include "base/threads.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { MOST_THREADS = 64 };

/* In 3D a cluster's fair share of the domain is its volume over the default coverage: an
 * arrow is plump relative to that share. */
static const double DEFAULT_COVERAGE = 0.3;

/* What all threads share; each takes the next cluster until there is none. */
typedef struct icon_job {
  const fg__icon_source *source;
  fg_icon *icon; /* [source->count * FG__ICON_PIECES] */
  atomic_int next;
  atomic_bool halted; /* a thread failed or the caller wants to stop */
} icon_job;

typedef struct icon_worker {
  icon_job *job;
  fg_context *context; /* its own: a context is for one thread at a time */
  fg_context *caller;  /* the caller's, on the caller's own thread, else NULL */
  fg_status status;
} icon_worker;

static const fg_field *field_of(const fg__icon_source *source, int index)
{
  return source->field_window ? source->field_window[index] : source->field;
}

/* Makes the icons of a cluster; in 3D a plump one is made slimmer. */
static fg_status make_icons(icon_job *job, fg_context *context, fg__chooser *chooser,
                            int index)
{
  const fg__icon_source *source = job->source;
  int cluster = source->cluster[index];
  fg_icon *icon = &job->icon[(size_t)index * FG__ICON_PIECES];
  fg__window whole;
  fg__window_piece part[FG__WINDOW_PIECES] = {{{0}, 0.0}};
  int parts = 0;
  fg_status status = fg__window_cut(&whole, context, source->density, source->labels,
                                    &source->patch[index], cluster);
  if (status == FG_STATUS_OK)
    status =
        fg__window_divide(part, &parts, context, source->density, source->labels, &whole);
  for (int k = 0; k < parts && status == FG_STATUS_OK; k++) {
    status = fg__icon_make(&icon[k], context, chooser, field_of(source, index),
                           &part[k].window);
    icon[k].area = source->labels->area[cluster - 1] * part[k].share;
    if (source->density->dimension == 3)
      fg__solid_slim(&icon[k], cbrt(icon[k].area / DEFAULT_COVERAGE));
  }
  for (int k = 0; k < parts; k++)
    fg__window_clear(&part[k].window);
  return status;
}

static void work(void *argument, const fg__thread *thread)
{
  icon_worker *worker = &((icon_worker *)argument)[thread->index];
  icon_job *job = worker->job;
  fg__chooser chooser = {.territory = job->source->territory,
                         .to_ends = job->source->to_ends};
  while (worker->status == FG_STATUS_OK && !atomic_load(&job->halted)) {
    int index = atomic_fetch_add(&job->next, 1);
    if (index >= job->source->count)
      break;
    if (worker->caller)
      worker->status = fg__check_stop(worker->caller);
    if (worker->status == FG_STATUS_OK)
      worker->status = make_icons(job, worker->context, &chooser, index);
  }
  if (worker->status != FG_STATUS_OK)
    atomic_store(&job->halted, true);
  fg__chooser_clear(&chooser);
}

/* The caller's thread is the first worker, and the only one where no threads are to be
 * had. */
fg_status fg__icons_make(fg_icon *icon, fg_context *context,
                         const fg__icon_source *source, int thread_count)
{
  icon_job job = {.source = source, .icon = icon};
  icon_worker workers[MOST_THREADS] = {
      {.job = &job, .context = context, .caller = context}};
  fg__threads *threads = NULL;
  fg_status status = FG_STATUS_OK;
  thread_count = thread_count < MOST_THREADS ? thread_count : MOST_THREADS;
  thread_count = thread_count < source->count ? thread_count : source->count;
  (void)fg__threads_create(&threads, NULL, thread_count);
  thread_count = fg__threads_count(threads);
  for (int i = 1; i < thread_count; i++) {
    workers[i].job = &job;
    (void)fg_context_create(&workers[i].context); /* without one messages are lost */
  }
  fg__threads_run(threads, work, workers);
  for (int i = 0; i < thread_count; i++) {
    const icon_worker *worker = &workers[i];
    if (worker->status != FG_STATUS_OK && status == FG_STATUS_OK)
      status = i == 0 ? worker->status
                      : fg__fail(context, worker->status, "%s",
                                 fg_context_message(worker->context));
    if (i > 0)
      fg_context_destroy(worker->context);
  }
  fg__threads_destroy(threads);
  return status;
}

fg_status fg__icons_collect(fg_icons **out, fg_context *context, const fg_icon *icon,
                            int clusters)
{
  fg_icons *icons = NULL;
  fg_status status = fg__icons_create_empty(&icons, context);
  int drawn = 0;
  for (int i = 0; i < clusters && status == FG_STATUS_OK; i++) {
    const fg_icon *part = &icon[(size_t)i * FG__ICON_PIECES];
    bool has_icon = false;
    for (int k = 0; k < FG__ICON_PIECES && status == FG_STATUS_OK; k++)
      if (part[k].points) {
        status = fg__icons_add(icons, context, &part[k]);
        has_icon = true;
      }
    drawn += has_icon;
  }
  if (status != FG_STATUS_OK) {
    fg_icons_destroy(icons);
    return status;
  }
  fg__icons_set_clusters(icons, clusters, clusters - drawn);
  *out = icons;
  return FG_STATUS_OK;
}

fg_icon *fg__icons_allocate(int clusters)
{
  return fg__allocate((size_t)clusters * FG__ICON_PIECES, sizeof(fg_icon));
}

void fg__icons_free(fg_icon *icon, int clusters)
{
  for (int i = 0; icon && i < clusters * FG__ICON_PIECES; i++)
    fg__icon_free(&icon[i]);
  free(icon);
}
