#include "drawn/scale.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "drawn/background.h"
#include "drawn/features.h"
#include "folder/file.h"
#include "folder/scale_files.h"
#include "option/validation.h"

int drawn_run_open(drawn_run *out, const char *folder)
{
  *out = (drawn_run){.folder = join_texts(folder, "")};
  return out->folder ? report_read(&out->report, folder)
                     : complain_of_memory("a folder's name");
}

void drawn_run_close(drawn_run *run)
{
  fg_field_destroy(run->field);
  report_clear(&run->report);
  free(run->folder);
  *run = (drawn_run){.folder = NULL};
}

/* The finest scale with at most so many arrows or clusters. */
static int choose_at_most(const drawn_run *run, int (*count_of)(const cli_report *, int),
                          int most, const char *what)
{
  const cli_report *report = &run->report;
  for (int k = 0; k < report->scale_count; ++k)
    if (count_of(report, k) <= most)
      return k;
  complain("%s: its coarsest scale has %d %s, and at most %d were asked for", run->folder,
           count_of(report, report->scale_count - 1), what, most);
  return -1;
}

int drawn_scale_choose(const drawn_run *run, const draw_settings *settings, int arrows,
                       int clusters)
{
  const int count = run->report.scale_count;
  if (settings->scale_index >= count) {
    complain("%s: has %d scale%s, and --scale-index %d was asked for", run->folder, count,
             count == 1 ? "" : "s", settings->scale_index);
    return -1;
  }
  if (settings->scale_index >= 0)
    return settings->scale_index;
  if (arrows)
    return choose_at_most(run, report_scale_arrows, arrows, "arrows");
  if (clusters)
    return choose_at_most(run, report_scale_clusters, clusters, "clusters");
  return count - 1;
}

static int read_icons(drawn_scale *scale, fg_context *context)
{
  const char *folder = scale->run->folder;
  const char *name =
      scale->file ? scale->file : report_scale_icons(&scale->run->report, scale->index);
  /* the name comes from run.json; it must not refer to another folder */
  if (!scale->file && (!name || strchr(name, '/'))) {
    complain("%s: run.json names no icons for scale %d", folder, scale->index);
    return EXIT_FAILED;
  }
  char *path = scale->file ? join_texts(name, "") : join_path(folder, name);
  if (!path)
    return EXIT_FAILED;
  fg_status status = fg_icons_read(&scale->icons, context, path);
  free(path);
  return status ? complain_of(context, status, scale->file ? scale->file : folder)
                : EXIT_DONE;
}

static bool is_on_another_map(const draw_settings *settings)
{
  return settings->map.projection || settings->map.has_center || settings->map.has_region;
}

/* A density is on the run's own map. */
int drawn_check_map(const draw_settings *settings)
{
  const given_option of_density[] = {
      {"tint", settings->picture.tint && is_on_another_map(settings)},
      {"background",
       background_needs_density(&settings->picture) && is_on_another_map(settings)},
  };
  return refuse_given("draw", of_density, 2, "not on another map than the run's");
}

fg_map_options drawn_run_map(const drawn_run *run, const draw_settings *settings)
{
  static const char none[] = "none";
  const fg_map_options *own = &run->report.map;
  fg_map_options map = settings->map;
  if (!is_on_another_map(settings))
    return *own;
  if (!map.projection && strcmp(own->projection, none) != 0)
    map.projection = own->projection;
  if (!map.has_region && own->has_region &&
      !(map.projection && strcmp(map.projection, none) == 0)) {
    map.has_region = true;
    memcpy(map.region, own->region, sizeof map.region);
  }
  return map;
}

static int read_field(drawn_run *run, fg_context *context, const draw_settings *settings)
{
  const cli_report *report = &run->report;
  if (run->field)
    return EXIT_DONE;
  const char *input = settings->input ? settings->input : report->input;
  if (!settings->input && input_is_standard(input)) {
    complain("%s: its input was standard input, which is gone", run->folder);
    advise("Say with --input where the field is now.");
    return EXIT_FAILED;
  }
  if (!settings->input && report->input_absolute &&
      access(report->input_absolute, R_OK) == 0)
    input = report->input_absolute;
  fg_read_options reading = report->reading;
  const fg_map_options map = drawn_run_map(run, settings);
  reading.map = &map;
  if (settings->vars_from)
    reading.vars_from = settings->vars_from;
  if (settings->mesh_from)
    reading.mesh_from = settings->mesh_from;
  const char *const inputs[] = {input, reading.vars_from, reading.mesh_from};
  if (settings->output && check_is_no_input(settings->output, inputs, 3))
    return EXIT_FAILED; /* the pictures of a series are in its folder */
  fg_status status = fg_field_read(&run->field, context, input, &reading);
  if (!status)
    report_doubts(input, run->field);
  if (!status && !is_on_another_map(settings) &&
      !report_is_of_field(report, run->folder, input, run->field)) {
    fputs("Icons are drawn on the field that they were made of.\n", stderr);
    return EXIT_FAILED;
  }
  if (!status)
    return EXIT_DONE;
  int code = complain_of(context, status, run->folder);
  if (status != FG_STATUS_STOPPED && status != FG_STATUS_ARGUMENT &&
      !*fg_context_hint(context))
    fputs("Say with --input where the field is now.\n", stderr);
  return code;
}

/* The option that needs the density; NULL: none. Placed arrows have regions of their own,
 * which --tint shows. */
static const char *density_user(const draw_settings *settings, const cli_report *report,
                                bool solid)
{
  if (solid)
    return settings->picture.surfaces ? "--surfaces" : NULL;
  if (settings->picture.tint && !report->placed)
    return "--tint";
  return background_needs_density(&settings->picture) ? "--background clusters" : NULL;
}

/* Reads the run's density file where it is needed. */
static int read_density(drawn_scale *scale, fg_context *context,
                        const draw_settings *settings)
{
  const drawn_run *run = scale->run;
  const char *user = density_user(settings, &run->report, scales_are_solid(run->field));
  if (!user)
    return EXIT_DONE;
  if (scale->file) {
    complain("%s: %s needs the density of a scale, and this is a file of icons",
             scale->file, user);
    return EXIT_FAILED;
  }
  const char *name = report_scale_density(&run->report, scale->index);
  if (!name || strchr(name, '/')) {
    complain("%s: %s needs the density of scale %d, which was not saved", run->folder,
             user, scale->index);
    advise("Say --save-field to `flowgrain run`.");
    return EXIT_FAILED;
  }
  char *path = join_path(run->folder, name);
  if (!path)
    return EXIT_FAILED;
  fg_status status = fg_density_read(&scale->density, context, path, run->field);
  free(path);
  return status ? complain_of(context, status, run->folder) : EXIT_DONE;
}

/* Makes the regions of placed arrows, for --tint. */
static int make_regions(drawn_scale *scale, fg_context *context,
                        const draw_settings *settings)
{
  const drawn_run *run = scale->run;
  if (!settings->picture.tint || !run->report.placed)
    return EXIT_DONE;
  fg_placement *placement = NULL;
  fg_placement_options options = {.lengths = run->report.lengths};
  fg_status status = fg_placement_create(&placement, context, run->field, &options);
  if (!status)
    status = fg_placement_resume(placement, scale->icons);
  if (!status)
    status = fg_placement_regions(&scale->regions, placement);
  fg_placement_destroy(placement);
  return status ? complain_of(context, status, run->folder) : EXIT_DONE;
}

static bool is_in_box(const fg_field_arrays *field, const double point[3])
{
  for (int k = 0; k < 2; ++k)
    if (!(point[k] >= field->axis[k][0] &&
          point[k] <= field->axis[k][field->size[k] - 1]))
      return false;
  return true;
}

/* A word about arrows of which half would be seen, but not the head. */
static void report_headless(const drawn_scale *scale)
{
  const fg_field_arrays *field = fg_field_contents(scale->run->field);
  int headless = 0;
  for (int n = 0; n < fg_icons_count(scale->icons); ++n) {
    const fg_icon *icon = fg_icons_at(scale->icons, n);
    int seen = 0;
    for (int i = 0; i < icon->point_count; ++i)
      seen += is_in_box(field, icon->points[i]);
    headless += 2 * seen >= icon->point_count &&
                !is_in_box(field, icon->points[icon->point_count - 1]);
  }
  if (headless)
    fprintf(stderr,
            "flowgrain: %s: %d arrow%s left out, for the head%s beyond the region; "
            "run --region places arrows in it\n",
            scale->run->folder, headless, headless == 1 ? " is" : "s are",
            headless == 1 ? " lies" : "s lie");
}

int drawn_scale_read(drawn_scale *scale, fg_context *context,
                     const draw_settings *settings)
{
  drawn_run *run = scale->run;
  int code = read_icons(scale, context);
  if (!code)
    code = read_field(run, context, settings);
  fg_status status =
      code ? FG_STATUS_OK : fg_icons_project(&scale->icons, context, run->field);
  if (!code && !status)
    status = features_add(context, run->field, scale->icons, &settings->picture, 0);
  if (status)
    code = complain_of(context, status, scale->file ? scale->file : run->folder);
  if (is_on_another_map(settings)) /* the recorded error is of the run's map */
    fg_icons_keep_score(scale->icons, NULL);
  if (!code && is_on_another_map(settings) && drawn_run_map(run, settings).has_region)
    report_headless(scale);
  if (!code)
    code = read_density(scale, context, settings);
  if (!code)
    code = make_regions(scale, context, settings);
  return code;
}

double drawn_scale_time(const drawn_scale *scale)
{
  const cli_report *report = &scale->run->report;
  return report->placed || scale->file ? 0.0 : report_scale_time(report, scale->index);
}

void drawn_scale_clear(drawn_scale *scale)
{
  fg_density_destroy(scale->regions);
  fg_density_destroy(scale->density);
  fg_icons_destroy(scale->icons);
  *scale = (drawn_scale){.run = NULL};
}
