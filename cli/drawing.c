#include "drawing.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "background.h"
#include "build_features.h"
#include "folder.h"
#include "interrupt.h"
#include "options.h"
#include "placing.h"
#include "progress.h"

struct cli_drawing {
  const cli_settings *settings;
  const fg_field *field;
  fg_field *whole; /* `field` where that one given is a part; else NULL */
  const cli_output *output;
  fg_context *context;    /* the worker's own */
  fg_texture *background; /* of the last picture, NULL: none */
  cli_placing placing;
  fg_icons *finer; /* placed icons of the last scale, whose parents come with the next */
  bool threaded;
  pthread_t thread;

  pthread_mutex_t lock; /* guards what follows up to `results` */
  pthread_cond_t changed;
  scale_moment waiting[MAX_SCALES + 1]; /* one more than wanted: a last state */
  int added, drawn;
  bool closed; /* no more snapshots will come */
  bool heeds;  /* interrupts, from now on */
  bool cut;    /* by one */
  fg_status status;

  scale_result results[MAX_SCALES + 1]; /* written by the worker, read after it ended */
  common_look look;
  double icon_seconds, picture_seconds;
};

static char *scale_path(const cli_drawing *drawing, int index, const char *end)
{
  char name[SCALE_NAME_BYTES];
  scale_name(name, index, end);
  return output_path(drawing->output, name);
}

static fg_status write_icons(cli_drawing *drawing, int index, const fg_icons *icons)
{
  char *path = scale_path(drawing, index, ".geojson");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_icons_write(drawing->context, path, icons);
  free(path);
  return status;
}

static fg_status write_solids(cli_drawing *drawing, int index, const fg_icons *icons,
                              const fg_surface *surface)
{
  static const char *const ends[] = {".vtp", ".glb"};
  fg_solid_options options = {.palette = drawing->settings->palette,
                              .speed_min = drawing->look.speeds[0],
                              .speed_max = drawing->look.speeds[1],
                              .surface = surface};
  fg_status status = FG_STATUS_OK;
  for (size_t k = 0; k < sizeof ends / sizeof *ends && !status; ++k) {
    char *path = scale_path(drawing, index, ends[k]);
    if (!path)
      return FG_STATUS_MEMORY;
    status = fg_solid_write(drawing->context, path, NULL, icons, &options);
    free(path);
  }
  return status;
}

/* Which view a file of that end shows, from 0; -1: it is no picture. In 3D. Files of
 * views are called scale-NN.png, scale-NN-2.png, ... */
static int solid_view_of(const char *end)
{
  if (strcmp(end, ".vtp") == 0 || strcmp(end, ".glb") == 0 || strcmp(end, ".vti") == 0 ||
      strcmp(end, ".geojson") == 0)
    return -1;
  return end[0] == '-' ? atoi(end + 1) - 1 : 0;
}

/* A picture for each view and format. */
static fg_status write_renderings(cli_drawing *drawing, int index,
                                  const scale_moment *moment, const fg_icons *icons,
                                  const fg_surface *surface)
{
  const cli_settings *settings = drawing->settings;
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int files = scale_file_ends(ends, settings, drawing->field);
  fg_status status = FG_STATUS_OK;
  for (int n = 1; n < files && !status; ++n) {
    int view = solid_view_of(ends[n]);
    if (view < 0)
      continue;
    fg_solid_options options = settings_solid(settings, view, drawing->look.view);
    options.speed_min = drawing->look.speeds[0];
    options.speed_max = drawing->look.speeds[1];
    if (!settings_place(settings)) /* the time of clusters */
      options.scale_time = moment->time;
    options.surface = surface;
    options.threads = settings->threads;
    char *path = scale_path(drawing, index, ends[n]);
    if (!path)
      status = FG_STATUS_MEMORY;
    else
      status = fg_solid_write(drawing->context, path, drawing->field, icons, &options);
    free(path);
  }
  return status;
}

static fg_status draw_solids(cli_drawing *drawing, int index, const scale_moment *moment,
                             const fg_icons *icons)
{
  fg_surface *surface = NULL;
  fg_status status = FG_STATUS_OK;
  if (drawing->settings->surfaces && moment->density)
    status = fg_density_surface(&surface, drawing->context, moment->density);
  if (!status)
    status = write_solids(drawing, index, icons, surface);
  if (!status)
    status = write_renderings(drawing, index, moment, icons, surface);
  fg_surface_destroy(surface);
  return status;
}

static fg_status write_density(cli_drawing *drawing, int index, const fg_density *density)
{
  char *path = scale_path(drawing, index, ".vti");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_density_write(drawing->context, path, density);
  free(path);
  return status;
}

/* `regions`: what placed arrows stand for, in place of the clusters; NULL: none. */
static fg_status write_pictures(cli_drawing *drawing, int index,
                                const scale_moment *moment, const fg_icons *icons,
                                const fg_density *regions)
{
  static const char *const ends[FORMAT_KINDS] = {".svg", ".png", ".pdf"};
  unsigned formats = formats_to_draw(drawing->settings, false);
  if (!formats)
    return FG_STATUS_OK;
  fg_picture_options options = settings_picture(drawing->settings);
  options.speed_min = drawing->look.speeds[0];
  options.speed_max = drawing->look.speeds[1];
  if (!settings_place(drawing->settings))
    options.scale_time = moment->time;
  fg_status status =
      background_choose(&options, &drawing->background, drawing->context,
                        drawing->settings, drawing->field, moment->density, icons);
  for (int kind = 0; !status && kind < FORMAT_KINDS; ++kind) {
    if (!(formats & (1U << kind)))
      continue;
    char *path = scale_path(drawing, index, ends[kind]);
    if (!path)
      return FG_STATUS_MEMORY;
    status = fg_picture_write(
        drawing->context, path, drawing->field,
        settings_place(drawing->settings) ? regions : moment->density, icons, &options);
    free(path);
  }
  return status;
}

static fg_status make_icons(cli_drawing *drawing, scale_moment *moment)
{
  return fg_icons_create(&moment->icons, drawing->context, drawing->field,
                         moment->density, NULL);
}

/* The last scale's icons, from its file after a resume. */
static fg_status find_finer(cli_drawing *drawing, int index)
{
  if (index == 0 || drawing->finer)
    return FG_STATUS_OK;
  char *path = scale_path(drawing, index - 1, ".geojson");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_icons_read(&drawing->finer, drawing->context, path);
  free(path);
  return status;
}

/* Exactly as many icons as the scale asks for. The finer scale's icons are told which
 * ones they went into. */
static fg_status place_icons(cli_drawing *drawing, int index, scale_moment *moment)
{
  int count = drawing->results[index].wanted[0];
  fg_status status = find_finer(drawing, index);
  if (!status)
    status =
        placing_make(&moment->icons, &drawing->placing, count, moment, drawing->finer);
  return status;
}

static fg_status draw_flat(cli_drawing *drawing, int index, const scale_moment *moment)
{
  fg_density *regions = NULL;
  fg_status status = FG_STATUS_OK;
  if (drawing->placing.placement)
    status = placing_regions(&regions, &drawing->placing);
  if (!status)
    status = write_pictures(drawing, index, moment, moment->icons, regions);
  fg_density_destroy(regions);
  return status;
}

/* Of the finest scale. */
static fg_status choose_look(cli_drawing *drawing, const fg_icons *icons)
{
  common_look *look = &drawing->look;
  if (!scales_are_solid(drawing->field)) {
    fg_icons_speed_range(look->speeds, icons);
    return FG_STATUS_OK;
  }
  fg_status status =
      fg_solid_speed_range(look->speeds, drawing->context, drawing->field, icons);
  if (!status)
    status = fg_solid_best_view(&look->view[0], &look->view[1], drawing->context,
                                drawing->field, icons);
  return status;
}

static fg_status draw_icons(cli_drawing *drawing, int index, scale_moment *moment)
{
  scale_result *result = &drawing->results[index];
  double start = clock_seconds();
  fg_status status = FG_STATUS_OK;
  if (settings_place(drawing->settings))
    status = place_icons(drawing, index, moment);
  else if (!moment->icons)
    status = make_icons(drawing, moment);
  if (!status && !settings_place(drawing->settings))
    status = placing_score(drawing->context, drawing->field, moment->icons);
  const fg_icons *icons = moment->icons;
  if (!status)
    status = write_icons(drawing, index, icons);
  double between = clock_seconds();
  drawing->icon_seconds += between - start;
  if (!status && index == 0)
    status = choose_look(drawing, icons);
  if (!status)
    status = scales_are_solid(drawing->field) ? draw_solids(drawing, index, moment, icons)
                                              : draw_flat(drawing, index, moment);
  drawing->picture_seconds += clock_seconds() - between;
  if (!status) {
    if (!settings_place(drawing->settings) || moment->density)
      result->clusters = fg_icons_clusters(icons);
    result->icons = fg_icons_count(icons);
    const fg_score *score = fg_icons_kept_score(icons);
    result->has_score = score != NULL;
    if (score)
      result->score = *score;
    result->dropped = fg_icons_dropped(icons);
  }
  /* now that there is a coarser scale, the finer one's file names its icons */
  if (!status && settings_place(drawing->settings) && drawing->finer)
    status = write_icons(drawing, index - 1, drawing->finer);
  if (!status && settings_place(drawing->settings)) {
    fg_icons_destroy(drawing->finer);
    drawing->finer = moment->icons;
    moment->icons = NULL;
  }
  return status;
}

static fg_status draw(cli_drawing *drawing, int index, scale_moment *moment)
{
  scale_result *result = &drawing->results[index];
  fg_status status = FG_STATUS_OK;
  result->clusters = moment->clusters;
  result->time = moment->time;
  result->energy = moment->energy;
  result->area_fraction = moment->area_fraction;
  drawing->icon_seconds += moment->icon_seconds;
  drawing->picture_seconds += moment->file_seconds;
  status = draw_icons(drawing, index, moment);
  double start = clock_seconds();
  if (!status && moment->density &&
      scales_have_density(drawing->settings, drawing->field))
    status = write_density(drawing, index, moment->density);
  drawing->picture_seconds += clock_seconds() - start;
  return status;
}

static void moment_clear(scale_moment *moment)
{
  fg_density_destroy(moment->density);
  fg_icons_destroy(moment->icons);
  *moment = (scale_moment){0};
}

/* Removes what there is of a scale that was interrupted. */
static void remove_scale(const cli_drawing *drawing, int index)
{
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int count = scale_file_ends(ends, drawing->settings, drawing->field);
  for (int n = 0; n < count; ++n) {
    char *path = scale_path(drawing, index, ends[n]);
    if (path)
      unlink(path);
    free(path);
  }
}

/* After an interrupt that is heeded: the scales from `index` on are left out. */
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
    scale_moment moment = drawing->waiting[index];
    drawing->waiting[index] = (scale_moment){0};
    pthread_mutex_unlock(&drawing->lock);
    fg_status status = draw(drawing, index, &moment);
    moment_clear(&moment);
    const bool interrupted = status == FG_STATUS_STOPPED && interrupt_came();
    if (interrupted)
      remove_scale(drawing, index);
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

/* Reads what other ranks have of a field: placing, scoring and pictures in 3D need it. */
static int read_whole(cli_drawing *drawing)
{
  if (!fg_field_is_part(drawing->field, NULL, NULL))
    return EXIT_DONE;
  const char *input = drawing->settings->operand;
  fg_read_options reading = settings_reading(drawing->settings);
  fg_status status = fg_field_read(&drawing->whole, drawing->context, input, &reading);
  if (status)
    return complain_of(drawing->context, status, input);
  drawing->field = drawing->whole;
  return EXIT_DONE;
}

int drawing_start(cli_drawing **out, const cli_settings *settings, const fg_field *field,
                  const cli_output *output)
{
  cli_drawing *drawing = calloc(1, sizeof *drawing);
  *out = drawing;
  if (!drawing || fg_context_create(&drawing->context)) {
    free(drawing);
    *out = NULL;
    complain("out of memory");
    return EXIT_FAILED;
  }
  drawing->settings = settings;
  drawing->field = field;
  drawing->output = output;
  int code = read_whole(drawing);
  if (code) {
    fg_context_destroy(drawing->context);
    free(drawing);
    *out = NULL;
    return code;
  }
  drawing->placing = (cli_placing){settings, drawing->field, drawing->context, NULL};
  pthread_mutex_init(&drawing->lock, NULL);
  pthread_cond_init(&drawing->changed, NULL);
  /* without a thread to be had, the drawing is done in order: the result is the same */
  drawing->threaded = settings->threads != 1 &&
                      pthread_create(&drawing->thread, NULL, work, drawing) == 0;
  return EXIT_DONE;
}

bool drawing_add(cli_drawing *drawing, const scale_moment *moment, const int *wanted,
                 int wanted_count)
{
  pthread_mutex_lock(&drawing->lock);
  bool accepted = drawing->added <= MAX_SCALES && !drawing->status && !drawing->cut;
  if (accepted) {
    scale_result *result = &drawing->results[drawing->added];
    result->wanted_count = wanted_count;
    for (int k = 0; k < wanted_count; ++k)
      result->wanted[k] = wanted[k];
    drawing->waiting[drawing->added] = *moment;
    ++drawing->added;
    pthread_cond_broadcast(&drawing->changed);
  }
  pthread_mutex_unlock(&drawing->lock);
  if (!accepted || drawing->cut) {
    scale_moment refused = *moment;
    moment_clear(&refused);
    return drawing->cut;
  }
  if (drawing->threaded)
    return true;
  drawing->closed = true; /* work returns when nothing waits */
  drawing->heeds = true;  /* nothing else goes on meanwhile */
  interrupt_second_at_once(true);
  work(drawing);
  interrupt_second_at_once(false);
  return !drawing->status;
}

bool drawing_wait(cli_drawing *drawing)
{
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
  drawing->look = *look;
  drawing->icon_seconds = icon_seconds;
  drawing->picture_seconds = picture_seconds;
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

bool scales_are_solid(const fg_field *field)
{
  return fg_field_contents(field)->dimension == 3;
}

bool scales_have_density(const cli_settings *settings, const fg_field *field)
{
  return settings->save_field || scales_are_solid(field);
}

static int add_end(char ends[SCALE_FILES][SCALE_END_BYTES], int count, const char *end)
{
  snprintf(ends[count], SCALE_END_BYTES, ".%s", end);
  return count + 1;
}

int scale_file_ends(char ends[SCALE_FILES][SCALE_END_BYTES], const cli_settings *settings,
                    const fg_field *field)
{
  int count = add_end(ends, 0, "geojson");
  bool solid = scales_are_solid(field);
  unsigned formats = formats_to_draw(settings, solid);
  for (int kind = 0; kind < FORMAT_KINDS; ++kind)
    if (formats & (1U << kind)) {
      count = add_end(ends, count, format_words[kind]);
      for (int view = 1; view < settings->view_count && solid; ++view)
        snprintf(ends[count++], SCALE_END_BYTES, "-%d.%s", view + 1, format_words[kind]);
    }
  if (solid) {
    count = add_end(ends, count, "vtp");
    count = add_end(ends, count, "glb");
  }
  if (scales_have_density(settings, field))
    count = add_end(ends, count, "vti");
  return count;
}

char *drawing_density_path(const cli_drawing *drawing)
{
  return scale_path(drawing, drawing->added, ".vti");
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

const common_look *drawing_look(const cli_drawing *drawing)
{
  return &drawing->look;
}

double drawing_icon_seconds(const cli_drawing *drawing)
{
  return drawing->icon_seconds;
}

double drawing_picture_seconds(const cli_drawing *drawing)
{
  return drawing->picture_seconds;
}

fg_context *drawing_context(const cli_drawing *drawing)
{
  return drawing->context;
}

void drawing_destroy(cli_drawing *drawing)
{
  if (!drawing)
    return;
  if (drawing->threaded)
    fg_context_stop(drawing->context); /* not finished: the scales are not wanted */
  drawing_finish(drawing);
  for (int k = 0; k <= MAX_SCALES; ++k)
    moment_clear(&drawing->waiting[k]);
  pthread_cond_destroy(&drawing->changed);
  pthread_mutex_destroy(&drawing->lock);
  placing_clear(&drawing->placing);
  fg_icons_destroy(drawing->finer);
  fg_texture_destroy(drawing->background);
  fg_field_destroy(drawing->whole);
  fg_context_destroy(drawing->context);
  free(drawing);
}
