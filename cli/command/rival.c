/* Draws the field by another method, for comparison. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build_features.h"
#include "command/command.h"
#include "folder/file.h"
#include "folder/made.h"
#include "inputs.h"
#include "option/table.h"
#include "option/validation.h"
#include "series/places.h"

static const char name_end[] = ".geojson";

/* A file under a temporary name, and its final name. */
typedef struct result_file {
  char *partial, *path;
  struct result_file *next;
} result_file;

typedef struct rival_work {
  const rival_settings *settings;
  fg_context *context;
  fg_field *field;
  fg_rival *rival;
  double speeds[2]; /* of the icons of the first count: the ends of all colour keys */
  result_file *files;
} rival_work;

static int check_name(const char *path)
{
  size_t length = strlen(path), end = strlen(name_end);
  if (length > end && strcmp(path + length - end, name_end) == 0)
    return check_place_of_file(path);
  complain("-o %s: the name's end must be %s", path, name_end);
  advise("Try 'flowgrain rival --help'.");
  return EXIT_USAGE;
}

static int is_input(const rival_settings *settings, const char *path)
{
  const char *const inputs[] = {settings->reading.input, settings->reading.vars_from,
                                settings->reading.mesh_from};
  return check_is_no_input(path, inputs, 3);
}

/* The picture's path for one count: FILE, or FILE-COUNT with several. */
static char *name_file(const rival_settings *settings, int count, const char *end)
{
  int stem = (int)(strlen(settings->output) - strlen(name_end));
  size_t size = strlen(settings->output) + 32;
  char *path = malloc(size);
  if (path && settings->icons.count > 1)
    snprintf(path, size, "%.*s-%d.%s", stem, settings->output, count, end);
  else if (path)
    snprintf(path, size, "%.*s.%s", stem, settings->output, end);
  return path;
}

static const result_file *new_file(rival_work *work, int count, const char *end)
{
  result_file *file = calloc(1, sizeof *file);
  if (!file) {
    complain("out of memory for a file's name");
    return NULL;
  }
  file->next = work->files;
  work->files = file;
  file->path = name_file(work->settings, count, end);
  if (!file->path)
    complain("out of memory for a file's name");
  if (file->path && is_input(work->settings, file->path))
    return NULL;
  file->partial = file->path ? temporary_name(file->path) : NULL;
  return file->partial ? file : NULL;
}

static int complain_of_result(const rival_work *work, const result_file *file,
                              fg_status status)
{
  return complain_of_partial(work->context, status, file->partial, file->path);
}

static int write_icons(rival_work *work, int count, const fg_icons *icons)
{
  const result_file *file = new_file(work, count, name_end + 1);
  if (!file)
    return EXIT_FAILED;
  fg_status status = fg_icons_write(work->context, file->partial, icons);
  return status ? complain_of_result(work, file, status) : EXIT_DONE;
}

static int write_clusters(rival_work *work, int count, const fg_density *clusters)
{
  const result_file *file = new_file(work, count, "vti");
  if (!file)
    return EXIT_FAILED;
  fg_status status = fg_density_write(work->context, file->partial, clusters);
  return status ? complain_of_result(work, file, status) : EXIT_DONE;
}

/* Files of one count beside its icons: pictures, in 3D also a scene of solids. */
typedef struct rival_files {
  rival_work *work;
  int count;
  const fg_icons *icons;
  const fg_density *clusters;
} rival_files;

static int write_flat(const rival_files *files, const char *end)
{
  rival_work *work = files->work;
  fg_picture_options options =
      settings_picture(&work->settings->picture, &work->settings->reading.map);
  options.speed_min = work->speeds[0];
  options.speed_max = work->speeds[1];
  double key_width = 0.0;
  options.key_width = &key_width;
  const result_file *file = new_file(work, files->count, end);
  if (!file)
    return EXIT_FAILED;
  fg_status status = fg_picture_write(work->context, file->partial, work->field,
                                      files->clusters, files->icons, &options);
  tell_key_width(file->path, key_width);
  return status ? complain_of_result(work, file, status) : EXIT_DONE;
}

static int write_solid(const rival_files *files, const char *end)
{
  rival_work *work = files->work;
  fg_solid_options options = settings_solid(&work->settings->picture, 0, NULL);
  options.speed_min = work->speeds[0];
  options.speed_max = work->speeds[1];
  const result_file *file = new_file(work, files->count, end);
  if (!file)
    return EXIT_FAILED;
  fg_status status =
      fg_solid_write(work->context, file->partial, work->field, files->icons, &options);
  return status ? complain_of_result(work, file, status) : EXIT_DONE;
}

static bool is_solid(const rival_work *work)
{
  return fg_field_contents(work->field)->dimension == 3;
}

static int write_pictures(const rival_files *files)
{
  bool solid = is_solid(files->work);
  unsigned formats = formats_to_draw(files->work->settings->formats, solid);
  int code = EXIT_DONE;
  if (solid)
    code = write_solid(files, "vtp");
  if (!code && solid)
    code = write_solid(files, "glb");
  for (int kind = 0; !code && kind < FORMAT_KINDS; ++kind)
    if (formats & (1U << kind))
      code = solid ? write_solid(files, format_words[kind])
                   : write_flat(files, format_words[kind]);
  return code;
}

/* Makes the icons of one count and, for a picture of clusters, its density. */
static fg_status make(rival_work *work, int count, fg_icons **icons,
                      fg_density **clusters)
{
  const rival_settings *settings = work->settings;
  fg_status status = fg_rival_icons(icons, work->rival, count);
  if (!status && (settings->picture.tint || settings->save_field))
    status = fg_rival_clusters(clusters, work->rival, count);
  return status;
}

static void choose_speeds(rival_work *work, const fg_icons *icons)
{
  fg_icons_speed_range(work->speeds, icons);
  settings_speeds(work->speeds, &work->settings->picture);
}

/* Of a square grid no point may lie in a field that is very narrow. */
static int complain_of_none(const rival_work *work)
{
  complain("%s: the method %s has no icon in it", work->settings->reading.input,
           fg_rival_name((fg_rival_method)work->settings->method));
  advise("ask for more with --icons, or take another --method");
  return EXIT_FAILED;
}

static int draw(rival_work *work, int count)
{
  fg_icons *icons = NULL;
  fg_density *clusters = NULL;
  const char *path = NULL;
  int code = EXIT_DONE;
  fg_status status = make(work, count, &icons, &clusters);
  if (status)
    code = complain_of(work->context, status, work->settings->reading.input);
  if (!code && fg_icons_count(icons) == 0)
    code = complain_of_none(work);
  if (!code && !work->files)
    choose_speeds(work, icons);
  if (!code)
    code = write_icons(work, count, icons);
  if (!code)
    path = work->files->path;
  if (!code && work->settings->save_field)
    code = write_clusters(work, count, clusters);
  if (!code)
    code = write_pictures(&(rival_files){work, count, icons, clusters});
  if (!code)
    printf("%4d icons  %s\n", fg_icons_count(icons), path);
  fg_density_destroy(clusters);
  fg_icons_destroy(icons);
  return code;
}

/* Renames all files to their final names, or removes all. */
static int publish(rival_work *work, int code)
{
  for (result_file *file = work->files, *next; file; file = next) {
    next = file->next;
    code = publish_file(file->partial, file->path, code);
    free(file->path);
    free(file);
  }
  work->files = NULL;
  return code;
}

/* Whether arrows of a method have equal lengths. */
static bool has_length(fg_rival_method method)
{
  return method == FG_RIVAL_HEDGEHOG || method == FG_RIVAL_GRID_CURVED ||
         method == FG_RIVAL_VORONOI || method == FG_RIVAL_K_MEANS ||
         method == FG_RIVAL_RANDOM;
}

static int check_method(const rival_settings *settings)
{
  fg_rival_method method = (fg_rival_method)settings->method;
  const given_option of_clusters[] = {{"tint", settings->picture.tint},
                                      {"save-field", settings->save_field}};
  const given_option of_discrete[] = {
      {"position-weight", settings->position_weight >= 0.0},
      {"elongation", settings->elongation > 0.0}};
  const given_option of_grids = {"lengths speed", settings->by_speed != 0};
  const given_option of_pieces = {"length", settings->length > 0.0};
  int code = EXIT_DONE;
  if (!fg_rival_divides(method))
    code = refuse_given("rival", of_clusters, sizeof of_clusters / sizeof of_clusters[0],
                        "the method %s has no clusters", fg_rival_name(method));
  if (!code && method != FG_RIVAL_DISCRETE)
    code = refuse_given("rival", of_discrete, sizeof of_discrete / sizeof of_discrete[0],
                        "only with --method discrete");
  if (!code && method != FG_RIVAL_HEDGEHOG && method != FG_RIVAL_GRID_CURVED)
    code =
        refuse_given("rival", &of_grids, 1, "only with --method hedgehog or grid-curved");
  if (!code && !has_length(method))
    code = refuse_given("rival", &of_pieces, 1,
                        "only with --method hedgehog, grid-curved, voronoi, k-means or "
                        "random");
  return code;
}

static int prepare(rival_work *work)
{
  const rival_settings *settings = work->settings;
  fg_rival_options options = {.method = (fg_rival_method)settings->method,
                              .nodes = settings->nodes,
                              .length_by_speed = settings->by_speed != 0,
                              .length = settings->length,
                              .direction_only = settings->position_weight == 0.0,
                              .position_weight = fmax(settings->position_weight, 0.0),
                              .elongation = settings->elongation};
  int code = create_context(&work->context);
  if (!code)
    code = places_read(&work->field, work->context, &settings->reading);
  if (code)
    return code;
  const int dimension = fg_field_contents(work->field)->dimension;
  code = refuse_other_dimension("rival", &settings->picture, dimension,
                                settings->reading.input);
  if (!code)
    code = refuse_undrawable(settings->formats, false, dimension == 3);
  if (code)
    return code;
  const fg_status status =
      fg_rival_create(&work->rival, work->context, work->field, &options);
  return status ? complain_of(work->context, status, settings->reading.input) : EXIT_DONE;
}

int command_rival(const void *given)
{
  const rival_settings *settings = given;
  static const int default_counts[] = {60};
  int count = settings->icons.count;
  const int *counts = count ? settings->icons.number : default_counts;
  rival_work work = {.settings = settings};
  int code = check_method(settings);
  if (!code)
    code = check_name(settings->output);
  if (!code)
    code = is_input(settings, settings->output);
  if (!code)
    code = prepare(&work);
  for (int k = 0; !code && k < (count ? count : 1); ++k)
    code = draw(&work, counts[k]);
  code = publish(&work, code);
  fg_rival_destroy(work.rival);
  fg_field_destroy(work.field);
  fg_context_destroy(work.context);
  return code;
}
