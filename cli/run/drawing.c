#include "run/drawing.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "inputs.h"
#include "interrupt.h"

struct cli_drawing {
  scale_maker maker;
  fg_field *whole; /* read again where `field` is a slab; else NULL */
  bool threaded;
  pthread_t thread;

  pthread_mutex_t lock; /* guards the members up to `results` */
  pthread_cond_t changed;
  scale_snapshot waiting[MAX_SCALES + 1]; /* one more than wanted, for a last state */
  int added, drawn;
  bool closed; /* no more snapshots will be added */
  bool heeds;  /* interrupts stop the drawing from now on */
  bool cut;    /* an interrupt has stopped the drawing */
  fg_status status;

  scale_result results[MAX_SCALES + 1]; /* by the worker; read after it has ended */
};

/* Drops the scales from `index` on after an interrupt. */
static void cut(cli_drawing *drawing, int index)
{
  drawing->cut = true;
  drawing->added = drawing->drawn = index;
}

static void *work(void *argument)
{
  cli_drawing *drawing = argument;
  pthread_mutex_lock(&drawing->lock);
  for (;;) {
    while (drawing->drawn == drawing->added && !drawing->closed)
      pthread_cond_wait(&drawing->changed, &drawing->lock);
    if (drawing->drawn == drawing->added || drawing->status)
      break;
    if (drawing->heeds && drawing->drawn > 0 && interrupt_came()) {
      cut(drawing, drawing->drawn);
      break;
    }
    int index = drawing->drawn;
    scale_snapshot snapshot = drawing->waiting[index];
    drawing->waiting[index] = (scale_snapshot){0};
    pthread_mutex_unlock(&drawing->lock);
    fg_status status =
        scale_make(&drawing->maker, index, &drawing->results[index], &snapshot);
    snapshot_clear(&snapshot);
    const bool interrupted = status == FG_STATUS_STOPPED && interrupt_came();
    if (interrupted)
      scale_remove(&drawing->maker, index);
    pthread_mutex_lock(&drawing->lock);
    if (interrupted && drawing->heeds && index > 0) {
      cut(drawing, index);
      pthread_cond_broadcast(&drawing->changed);
      break;
    }
    drawing->status = status;
    ++drawing->drawn;
    pthread_cond_broadcast(&drawing->changed);
  }
  pthread_mutex_unlock(&drawing->lock);
  return NULL;
}

/* Reads the whole field if this rank has a slab of it, for placement, scores and pictures
 * in 3D. */
static int read_whole(cli_drawing *drawing)
{
  if (!fg_field_is_slab(drawing->maker.field, NULL, NULL))
    return EXIT_DONE;
  const char *input = drawing->maker.settings->reading.input;
  fg_read_options reading = settings_reading(&drawing->maker.settings->reading);
  fg_status status =
      fg_field_read(&drawing->whole, drawing->maker.context, input, &reading);
  if (status)
    return complain_of(drawing->maker.context, status, input);
  drawing->maker.field = drawing->whole;
  return EXIT_DONE;
}

int drawing_start(cli_drawing **out, const run_settings *settings, const fg_field *field,
                  const cli_output *output)
{
  cli_drawing *drawing = calloc(1, sizeof *drawing);
  *out = drawing;
  if (!drawing || fg_context_create(&drawing->maker.context)) {
    free(drawing);
    *out = NULL;
    complain("out of memory");
    return EXIT_FAILED;
  }
  inputs_give(drawing->maker.context);
  drawing->maker.settings = settings;
  drawing->maker.field = field;
  drawing->maker.output = output;
  int code = read_whole(drawing);
  if (code) {
    fg_context_destroy(drawing->maker.context);
    free(drawing);
    *out = NULL;
    return code;
  }
  drawing->maker.placing =
      (cli_placing){settings, drawing->maker.field, drawing->maker.context, NULL};
  pthread_mutex_init(&drawing->lock, NULL);
  pthread_cond_init(&drawing->changed, NULL);
  /* without a thread scales are drawn in order, with the same result */
  drawing->threaded = settings->work.threads != 1 &&
                      pthread_create(&drawing->thread, NULL, work, drawing) == 0;
  return EXIT_DONE;
}

bool drawing_add(cli_drawing *drawing, const scale_snapshot *snapshot, const int *wanted,
                 int wanted_count)
{
  pthread_mutex_lock(&drawing->lock);
  bool accepted = drawing->added <= MAX_SCALES && !drawing->status && !drawing->cut;
  if (accepted) {
    scale_result *result = &drawing->results[drawing->added];
    result->wanted_count = wanted_count;
    for (int k = 0; k < wanted_count; ++k)
      result->wanted[k] = wanted[k];
    drawing->waiting[drawing->added] = *snapshot;
    ++drawing->added;
    pthread_cond_broadcast(&drawing->changed);
  }
  pthread_mutex_unlock(&drawing->lock);
  if (!accepted || drawing->cut) {
    scale_snapshot refused = *snapshot;
    snapshot_clear(&refused);
    return drawing->cut;
  }
  return true;
}

/* Without a worker thread: draws the snapshots that wait. */
static void draw_here(cli_drawing *drawing)
{
  if (drawing->threaded)
    return;
  drawing->closed = true; /* so that work() returns when no snapshot waits */
  drawing->heeds = true;  /* nothing else runs meanwhile */
  work(drawing);
}

bool drawing_keep_up(cli_drawing *drawing)
{
  if (drawing->threaded)
    return true;
  interrupt_second_at_once(true);
  draw_here(drawing);
  interrupt_second_at_once(false);
  return !drawing->status;
}

bool drawing_wait(cli_drawing *drawing)
{
  drawing_keep_up(drawing);
  pthread_mutex_lock(&drawing->lock);
  while (drawing->drawn < drawing->added && !drawing->status)
    pthread_cond_wait(&drawing->changed, &drawing->lock);
  bool whole = !drawing->status;
  pthread_mutex_unlock(&drawing->lock);
  return whole;
}

void drawing_restore(cli_drawing *drawing, const scale_result *results, int count,
                     const common_look *look, double icon_seconds, double picture_seconds)
{
  pthread_mutex_lock(&drawing->lock);
  for (int k = 0; k < count; ++k)
    drawing->results[k] = results[k];
  drawing->added = drawing->drawn = count;
  drawing->maker.look = *look;
  drawing->maker.icon_seconds = icon_seconds;
  drawing->maker.picture_seconds = picture_seconds;
  pthread_mutex_unlock(&drawing->lock);
}

void drawing_heed_interrupts(cli_drawing *drawing)
{
  pthread_mutex_lock(&drawing->lock);
  drawing->heeds = true;
  pthread_mutex_unlock(&drawing->lock);
  interrupt_second_at_once(true);
}

bool drawing_wait_for(cli_drawing *drawing, double seconds)
{
  struct timespec until;
  draw_here(drawing);
  timespec_get(&until, TIME_UTC);
  double end = (double)until.tv_nsec * 1e-9 + seconds;
  until.tv_sec += (time_t)end;
  until.tv_nsec = (long)((end - floor(end)) * 1e9);
  pthread_mutex_lock(&drawing->lock);
  int waited = 0;
  while (waited == 0 && drawing->drawn < drawing->added && !drawing->status)
    waited = pthread_cond_timedwait(&drawing->changed, &drawing->lock, &until);
  bool all = drawing->drawn >= drawing->added || drawing->status;
  pthread_mutex_unlock(&drawing->lock);
  return all;
}

bool drawing_was_cut(const cli_drawing *drawing)
{
  return drawing->cut;
}

fg_status drawing_finish(cli_drawing *drawing)
{
  pthread_mutex_lock(&drawing->lock);
  drawing->closed = true;
  pthread_cond_broadcast(&drawing->changed);
  pthread_mutex_unlock(&drawing->lock);
  if (drawing->threaded) {
    pthread_join(drawing->thread, NULL);
    drawing->threaded = false;
  }
  return drawing->status;
}

char *drawing_density_path(const cli_drawing *drawing)
{
  return scale_path(&drawing->maker, drawing->added, ".vti");
}

int drawing_count(const cli_drawing *drawing)
{
  return drawing->added;
}

int drawing_ready(cli_drawing *drawing)
{
  pthread_mutex_lock(&drawing->lock);
  int ready = drawing->drawn;
  pthread_mutex_unlock(&drawing->lock);
  return ready;
}

bool drawing_failed(cli_drawing *drawing)
{
  pthread_mutex_lock(&drawing->lock);
  bool failed = drawing->status != FG_STATUS_OK;
  pthread_mutex_unlock(&drawing->lock);
  return failed;
}

const scale_result *drawing_result(const cli_drawing *drawing, int index)
{
  return &drawing->results[index];
}

const fg_field *drawing_field(const cli_drawing *drawing)
{
  return drawing->maker.field;
}

const common_look *drawing_look(const cli_drawing *drawing)
{
  return &drawing->maker.look;
}

double drawing_icon_seconds(const cli_drawing *drawing)
{
  return drawing->maker.icon_seconds;
}

double drawing_picture_seconds(const cli_drawing *drawing)
{
  return drawing->maker.picture_seconds;
}

fg_context *drawing_context(const cli_drawing *drawing)
{
  return drawing->maker.context;
}

void drawing_destroy(cli_drawing *drawing)
{
  if (!drawing)
    return;
  if (drawing->threaded)
    fg_context_stop(drawing->maker.context); /* drops unfinished scales */
  drawing_finish(drawing);
  for (int k = 0; k <= MAX_SCALES; ++k)
    snapshot_clear(&drawing->waiting[k]);
  pthread_cond_destroy(&drawing->changed);
  pthread_mutex_destroy(&drawing->lock);
  scale_maker_clear(&drawing->maker);
  fg_field_destroy(drawing->whole);
  free(drawing);
}
