#include "run/scale_maker.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "build_features.h"
#include "drawn/background.h"
#include "drawn/features.h"
#include "folder/scale_files.h"
#include "progress.h"

char *scale_path(const scale_maker *maker, int index, const char *end)
{
  char name[SCALE_NAME_BYTES];
  scale_name(name, index, end);
  return output_path(maker->output, name);
}

static fg_status write_icons(scale_maker *maker, int index, const fg_icons *icons)
{
  char *path = scale_path(maker, index, ".geojson");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_icons_write(maker->context, path, icons);
  free(path);
  return status;
}

static fg_status write_solids(scale_maker *maker, int index, const fg_icons *icons,
                              const fg_surface *surface)
{
  static const char *const ends[] = {".vtp", ".glb"};
  fg_solid_options options = {.palette = maker->settings->picture.palette,
                              .speed_min = maker->look.speeds[0],
                              .speed_max = maker->look.speeds[1],
                              .surface = surface};
  fg_status status = FG_STATUS_OK;
  for (size_t k = 0; k < sizeof ends / sizeof *ends && !status; ++k) {
    char *path = scale_path(maker, index, ends[k]);
    if (!path)
      return FG_STATUS_MEMORY;
    status = fg_solid_write(maker->context, path, maker->field, icons, &options);
    free(path);
  }
  return status;
}

/* The view of a picture's ending in 3D, from 0; -1: no picture. Files of views are named
 * scale-NN.png, scale-NN-2.png, ... */
static int solid_view_of(const char *end)
{
  if (strcmp(end, ".vtp") == 0 || strcmp(end, ".glb") == 0 || strcmp(end, ".vti") == 0 ||
      strcmp(end, ".geojson") == 0)
    return -1;
  return end[0] == '-' ? atoi(end + 1) - 1 : 0;
}

/* Writes a picture for each view and format. */
static fg_status write_renderings(scale_maker *maker, int index,
                                  const scale_snapshot *snapshot, const fg_icons *icons,
                                  const fg_surface *surface)
{
  const run_settings *settings = maker->settings;
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int files = scale_file_ends(ends, settings, maker->field);
  fg_status status = FG_STATUS_OK;
  for (int n = 1; n < files && !status; ++n) {
    int view = solid_view_of(ends[n]);
    if (view < 0)
      continue;
    fg_solid_options options = settings_solid(&settings->picture, view, maker->look.view);
    options.speed_min = maker->look.speeds[0];
    options.speed_max = maker->look.speeds[1];
    if (!settings_place(settings)) /* only clusters have a simulated time */
      options.scale_time = snapshot->time;
    options.surface = surface;
    options.threads = settings->work.threads;
    char *path = scale_path(maker, index, ends[n]);
    if (!path)
      status = FG_STATUS_MEMORY;
    else
      status = fg_solid_write(maker->context, path, maker->field, icons, &options);
    free(path);
  }
  return status;
}

static fg_status draw_solids(scale_maker *maker, int index,
                             const scale_snapshot *snapshot, const fg_icons *icons)
{
  fg_surface *surface = NULL;
  fg_status status = FG_STATUS_OK;
  if (maker->settings->picture.surfaces && snapshot->density)
    status = fg_density_surface(&surface, maker->context, snapshot->density);
  if (!status)
    status = write_solids(maker, index, icons, surface);
  if (!status)
    status = write_renderings(maker, index, snapshot, icons, surface);
  fg_surface_destroy(surface);
  return status;
}

static fg_status write_density(scale_maker *maker, int index, const fg_density *density)
{
  char *path = scale_path(maker, index, ".vti");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_density_write(maker->context, path, density);
  free(path);
  return status;
}

/* A scale of a time at which no cluster has an arrow shows the density itself. */
static void show_density(picture_settings *picture, fg_picture_options *options,
                         const run_settings *settings, const fg_icons *icons)
{
  static const double full = 1e-3; /* 0 is the default fade */
  if (!settings->times.count || fg_icons_count(icons) > 0 || picture->background)
    return;
  picture->background = FG_TEXTURE_CLUSTERS + 1;
  options->background_fade = full;
}

/* regions: of placed arrows, shown instead of clusters; NULL: none. */
static fg_status write_pictures(scale_maker *maker, int index,
                                const scale_snapshot *snapshot, const fg_icons *icons,
                                const fg_density *regions)
{
  static const char *const ends[FORMAT_KINDS] = {".svg", ".png", ".pdf"};
  unsigned formats = formats_to_draw(maker->settings->formats, false);
  if (!formats)
    return FG_STATUS_OK;
  fg_picture_options options =
      settings_picture(&maker->settings->picture, &maker->settings->reading.map);
  options.speed_min = maker->look.speeds[0];
  options.speed_max = maker->look.speeds[1];
  if (!settings_place(maker->settings))
    options.scale_time = snapshot->time;
  double key_width = 0.0;
  if (index == 0 && !maker->settings->quiet)
    options.key_width = &key_width;
  picture_settings picture = maker->settings->picture;
  show_density(&picture, &options, maker->settings, icons);
  fg_status status = background_choose(&options, &maker->background, maker->context,
                                       &picture, maker->settings->work.threads,
                                       maker->field, snapshot->density, icons);
  for (int kind = 0; !status && kind < FORMAT_KINDS; ++kind) {
    if (!(formats & (1U << kind)))
      continue;
    char *path = scale_path(maker, index, ends[kind]);
    if (!path)
      return FG_STATUS_MEMORY;
    status = fg_picture_write(
        maker->context, path, maker->field,
        settings_place(maker->settings) ? regions : snapshot->density, icons, &options);
    tell_key_width(maker->settings->output, key_width);
    options.key_width = NULL;
    key_width = 0.0;
    free(path);
  }
  return status;
}

static fg_status make_icons(scale_maker *maker, scale_snapshot *snapshot)
{
  const fg_icon_options options = settings_icons(maker->settings);
  return fg_icons_create(&snapshot->icons, maker->context, maker->field,
                         snapshot->density, &options);
}

static fg_status add_features(scale_maker *maker, fg_icons *icons)
{
  const run_settings *settings = maker->settings;
  return features_add(maker->context, maker->field, icons, &settings->picture,
                      settings->work.threads);
}

static void count_features(scale_result *result, const fg_icons *icons)
{
  const fg_critical_points *points = fg_icons_kept_critical(icons);
  result->has_features = points != NULL;
  for (int n = 0; n < fg_critical_points_count(points); ++n)
    ++result->features[fg_critical_points_at(points, n)->kind];
}

/* The last scale's icons; after a resume read from the file. */
static fg_status find_finer(scale_maker *maker, int index)
{
  if (index == 0 || maker->finer)
    return FG_STATUS_OK;
  char *path = scale_path(maker, index - 1, ".geojson");
  if (!path)
    return FG_STATUS_MEMORY;
  fg_status status = fg_icons_read(&maker->finer, maker->context, path);
  free(path);
  return status ? status : add_features(maker, maker->finer);
}

/* Makes exactly `count` icons, and sets the parents of the finer scale's icons. */
static fg_status place_icons(scale_maker *maker, int index, int count,
                             scale_snapshot *snapshot)
{
  fg_status status = find_finer(maker, index);
  if (!status)
    status =
        placing_make(&snapshot->icons, &maker->placing, count, snapshot, maker->finer);
  return status;
}

static fg_status draw_flat(scale_maker *maker, int index, const scale_snapshot *snapshot)
{
  fg_density *regions = NULL;
  fg_status status = FG_STATUS_OK;
  if (maker->placing.placement)
    status = placing_regions(&regions, &maker->placing);
  if (!status)
    status = write_pictures(maker, index, snapshot, snapshot->icons, regions);
  fg_density_destroy(regions);
  return status;
}

/* From the finest scale that has arrows. */
static fg_status choose_look(scale_maker *maker, const fg_icons *icons)
{
  common_look *look = &maker->look;
  if (!scales_are_solid(maker->field)) {
    fg_icons_speed_range(look->speeds, icons);
    settings_speeds(look->speeds, &maker->settings->picture);
    return FG_STATUS_OK;
  }
  fg_status status =
      fg_solid_speed_range(look->speeds, maker->context, maker->field, icons);
  if (!status)
    status = fg_solid_best_view(&look->view[0], &look->view[1], maker->context,
                                maker->field, icons);
  settings_speeds(look->speeds, &maker->settings->picture);
  return status;
}

static fg_status draw_icons(scale_maker *maker, int index, scale_result *result,
                            scale_snapshot *snapshot)
{
  double start = clock_seconds();
  fg_status status = FG_STATUS_OK;
  if (settings_place(maker->settings))
    status = place_icons(maker, index, result->wanted[0], snapshot);
  else if (!snapshot->icons)
    status = make_icons(maker, snapshot);
  if (!status && !settings_place(maker->settings) && fg_icons_count(snapshot->icons) > 0)
    status =
        placing_score(maker->context, maker->settings, maker->field, snapshot->icons);
  if (!status)
    status = add_features(maker, snapshot->icons);
  const fg_icons *icons = snapshot->icons;
  if (!status)
    status = write_icons(maker, index, icons);
  double between = clock_seconds();
  maker->icon_seconds += between - start;
  if (!status && !(maker->look.speeds[1] > 0.0)) /* not chosen yet */
    status = choose_look(maker, icons);
  if (!status)
    status = scales_are_solid(maker->field) ? draw_solids(maker, index, snapshot, icons)
                                            : draw_flat(maker, index, snapshot);
  maker->picture_seconds += clock_seconds() - between;
  if (!status) {
    if (!settings_place(maker->settings) || snapshot->density)
      result->clusters = fg_icons_clusters(icons);
    result->icons = fg_icons_count(icons);
    const fg_score *score = fg_icons_kept_score(icons);
    result->has_score = score != NULL;
    if (score)
      result->score = *score;
    result->dropped = fg_icons_dropped(icons);
    count_features(result, icons);
  }
  /* the parents of the finer scale's icons are known now */
  if (!status && settings_place(maker->settings) && maker->finer)
    status = write_icons(maker, index - 1, maker->finer);
  if (!status && settings_place(maker->settings)) {
    fg_icons_destroy(maker->finer);
    maker->finer = snapshot->icons;
    snapshot->icons = NULL;
  }
  return status;
}

fg_status scale_make(scale_maker *maker, int index, scale_result *result,
                     scale_snapshot *snapshot)
{
  fg_status status = FG_STATUS_OK;
  result->clusters = snapshot->clusters;
  result->time = snapshot->time;
  result->energy = snapshot->energy;
  result->area_fraction = snapshot->area_fraction;
  maker->icon_seconds += snapshot->icon_seconds;
  maker->picture_seconds += snapshot->file_seconds;
  status = draw_icons(maker, index, result, snapshot);
  double start = clock_seconds();
  if (!status && snapshot->density && scales_have_density(maker->settings, maker->field))
    status = write_density(maker, index, snapshot->density);
  maker->picture_seconds += clock_seconds() - start;
  return status;
}

void snapshot_clear(scale_snapshot *snapshot)
{
  fg_density_destroy(snapshot->density);
  fg_icons_destroy(snapshot->icons);
  *snapshot = (scale_snapshot){0};
}

void scale_remove(const scale_maker *maker, int index)
{
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int count = scale_file_ends(ends, maker->settings, maker->field);
  for (int n = 0; n < count; ++n) {
    char *path = scale_path(maker, index, ends[n]);
    if (path)
      unlink(path);
    free(path);
  }
}

void scale_maker_clear(scale_maker *maker)
{
  placing_clear(&maker->placing);
  fg_icons_destroy(maker->finer);
  fg_texture_destroy(maker->background);
  fg_context_destroy(maker->context);
}
