/* Draws one scale of a finished run again. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "build_features.h"
#include "command/command.h"
#include "folder/file.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/settings.h"
#include "option/validation.h"
#include "report/past_run.h"
#include "run/background.h"
#include "run/scale_files.h"
#include "sandbox.h"

/* What only pictures have. */
static int check_solids(const draw_settings *settings)
{
  const given_option of_pictures[] = {
      {"view", settings->picture.view_count > 0},
      {"width", settings->picture.width > 0.0},
      {"height", settings->picture.height > 0.0},
      {"dpi", settings->picture.dpi > 0.0},
      {"title", settings->picture.title != NULL},
      {"no-frame", settings->picture.no_frame},
      {"transparent", settings->picture.transparent},
      {"palette", settings->picture.palette && ends_with(settings->output, ".vtp")},
  };
  int code = refuse_given("draw", of_pictures, sizeof of_pictures / sizeof of_pictures[0],
                          "only in a picture, and %s is none", settings->output);
  return code ? code : check_place_of_file(settings->output);
}

static bool is_solids(const char *path)
{
  return ends_with(path, ".vtp") || ends_with(path, ".glb");
}

static int check_output(const draw_settings *settings)
{
  const char *path = settings->output;
  const bool index = settings->scale_index >= 0, arrows = settings->arrows.count > 0,
             clusters = settings->clusters.count > 0;
  if (index + arrows + clusters > 1) {
    complain("%s and %s each choose a scale: say one",
             index ? "--scale-index" : "--arrows",
             index && arrows ? "--arrows" : "--clusters");
    advise("Try 'flowgrain draw --help'.");
    return EXIT_USAGE;
  }
  return is_solids(path) ? check_solids(settings) : check_picture_name(path, "draw");
}

static int check_dimension(const draw_settings *settings, int dimension)
{
  if (is_solids(settings->output) && dimension == 2) {
    complain("-o %s: only in 3D, and %s is in 2D", settings->output, settings->folder);
    advise("Try 'flowgrain draw --help'.");
    return EXIT_USAGE;
  }
  int code =
      refuse_other_dimension("draw", &settings->picture, dimension, settings->folder);
  if (!code && dimension == 3 && !is_solids(settings->output))
    code = require_feature(settings->output, FG_FEATURE_RENDER);
  return code;
}

/* The finest scale that has at most so many of what is counted. */
static int choose_at_most(const draw_settings *settings, const cli_report *report,
                          int (*count_of)(const cli_report *, int), int most,
                          const char *what)
{
  for (int k = 0; k < report->scale_count; ++k)
    if (count_of(report, k) <= most)
      return k;
  complain("%s: its coarsest scale has %d %s, and at most %d were asked for",
           settings->folder, count_of(report, report->scale_count - 1), what, most);
  return -1;
}

/* The scale that the options choose, -1 after a complaint. */
static int choose_scale(const draw_settings *settings, const cli_report *report)
{
  int count = report->scale_count;
  if (settings->scale_index >= count) {
    complain("%s: has %d scale%s, and --scale-index %d was asked for", settings->folder,
             count, count == 1 ? "" : "s", settings->scale_index);
    return -1;
  }
  if (settings->scale_index >= 0)
    return settings->scale_index;
  if (settings->arrows.count)
    return choose_at_most(settings, report, report_scale_arrows,
                          settings->arrows.number[0], "arrows");
  if (settings->clusters.count)
    return choose_at_most(settings, report, report_scale_clusters,
                          settings->clusters.number[0], "clusters");
  return count - 1;
}

static int read_icons(fg_icons **out, fg_context *context, const draw_settings *settings,
                      const cli_report *report, int index)
{
  const char *name = report_scale_icons(report, index);
  /* the name comes from a file: it must not lead out of its folder */
  if (!name || strchr(name, '/')) {
    complain("%s: run.json names no icons for scale %d", settings->folder, index);
    return EXIT_FAILED;
  }
  char *path = join_path(settings->folder, name);
  if (!path)
    return EXIT_FAILED;
  fg_status status = fg_icons_read(out, context, path);
  free(path);
  return status ? complain_of(context, status, settings->folder) : EXIT_DONE;
}

static bool is_on_another_map(const draw_settings *settings)
{
  return settings->map.projection || settings->map.has_center || settings->map.has_region;
}

/* Of a density: it is of the run's own map. */
static int check_map(const draw_settings *settings)
{
  const given_option of_density[] = {
      {"tint", settings->picture.tint && is_on_another_map(settings)},
      {"background",
       background_needs_density(&settings->picture) && is_on_another_map(settings)},
  };
  return refuse_given("draw", of_density, 2, "not on another map than the run's");
}

static int project_icons(fg_icons **icons, fg_context *context,
                         const draw_settings *settings, const fg_field *field)
{
  fg_status status = fg_icons_project(icons, context, field);
  return status ? complain_of(context, status, settings->folder) : EXIT_DONE;
}

static int read_field(fg_field **out, fg_context *context, const draw_settings *settings,
                      const cli_report *report)
{
  const char *input = settings->input ? settings->input : report->input;
  if (!settings->input && inputs_is_standard(input)) {
    complain("%s: its input was standard input, which is gone", settings->folder);
    advise("Say with --input where the field is now.");
    return EXIT_FAILED;
  }
  if (!settings->input && report->input_absolute &&
      access(report->input_absolute, R_OK) == 0)
    input = report->input_absolute;
  fg_read_options reading = report->reading;
  if (is_on_another_map(settings))
    reading.map = &settings->map;
  if (check_is_no_input(settings->output, &input, 1) || sandbox_reading(input, &reading))
    return EXIT_FAILED;
  fg_status status = fg_field_read(out, context, input, &reading);
  if (!status)
    say_infinite(input, *out);
  if (!status && !is_on_another_map(settings) &&
      !report_is_of_field(report, settings->folder, input, *out)) {
    fputs("Icons are drawn on the field that they were made of.\n", stderr);
    return EXIT_FAILED;
  }
  if (!status)
    return EXIT_DONE;
  int code = complain_of(context, status, settings->folder);
  if (!*fg_context_hint(context))
    fputs("Say with --input where the field is now.\n", stderr);
  return code;
}

/* What the option is called that needs the density; NULL: none does. Placed arrows have
 * regions of their own to tint. */
static const char *density_user(const draw_settings *settings, const cli_report *report,
                                bool solid)
{
  if (solid)
    return settings->picture.surfaces ? "--surfaces" : NULL;
  if (settings->picture.tint && !report->placed)
    return "--tint";
  return background_needs_density(&settings->picture) ? "--background clusters" : NULL;
}

/* The density that the run has saved, where it is needed. */
static int read_density(fg_density **out, fg_context *context,
                        const draw_settings *settings, const cli_report *report,
                        int index, const fg_field *field)
{
  const char *user = density_user(settings, report, scales_are_solid(field));
  if (!user)
    return EXIT_DONE;
  const char *name = report_scale_density(report, index);
  if (!name || strchr(name, '/')) {
    complain("%s: %s needs the density of scale %d, which was not saved",
             settings->folder, user, index);
    advise("Say --save-field to `flowgrain run`.");
    return EXIT_FAILED;
  }
  char *path = join_path(settings->folder, name);
  if (!path)
    return EXIT_FAILED;
  fg_status status = fg_density_read(out, context, path, field);
  free(path);
  return status ? complain_of(context, status, settings->folder) : EXIT_DONE;
}

/* The simulated scale is one of clusters, not of placed arrows. */
static double caption_time(const cli_report *report, int index)
{
  return report->placed ? 0.0 : report_scale_time(report, index);
}

/* The regions of placed arrows, where --tint shows them. */
static int make_regions(fg_density **out, fg_context *context,
                        const draw_settings *settings, const cli_report *report,
                        const fg_field *field, const fg_icons *icons)
{
  if (!settings->picture.tint || !report->placed)
    return EXIT_DONE;
  fg_placement *placement = NULL;
  fg_placement_options options = {.lengths = report->lengths};
  fg_status status = fg_placement_create(&placement, context, field, &options);
  if (!status)
    status = fg_placement_resume(placement, icons);
  if (!status)
    status = fg_placement_regions(out, placement);
  fg_placement_destroy(placement);
  return status ? complain_of(context, status, settings->folder) : EXIT_DONE;
}

static fg_status write_solid(fg_context *context, const char *path,
                             const draw_settings *settings, const cli_report *report,
                             int index, const fg_field *field, const fg_density *density,
                             const fg_icons *icons)
{
  fg_surface *surface = NULL;
  fg_status status =
      density ? fg_density_surface(&surface, context, density) : FG_STATUS_OK;
  if (status)
    return status;
  fg_solid_options options =
      settings_solid(&settings->picture, 0, report->has_view ? report->view : NULL);
  options.surface = surface;
  double speeds[2] = {report->speeds[0], report->speeds[1]};
  settings_speeds(speeds, &settings->picture);
  options.speed_min = speeds[0];
  options.speed_max = speeds[1];
  options.scale_time = caption_time(report, index);
  status = fg_solid_write(context, path, field, icons, &options);
  fg_surface_destroy(surface);
  return status;
}

static int write_picture(fg_context *context, const draw_settings *settings,
                         const cli_report *report, int index, const fg_field *field,
                         const fg_density *density, const fg_density *regions,
                         const fg_icons *icons)
{
  fg_picture_options options = settings_picture(&settings->picture);
  double speeds[2] = {report->speeds[0], report->speeds[1]};
  settings_speeds(speeds, &settings->picture);
  options.speed_min = speeds[0];
  options.speed_max = speeds[1];
  options.scale_time = caption_time(report, index);
  char *partial = temporary_name(settings->output);
  if (!partial)
    return EXIT_FAILED;
  fg_texture *background = NULL;
  fg_status status =
      report->dimension == 3
          ? FG_STATUS_OK
          : background_choose(&options, &background, context, &settings->picture, 0,
                              field, density, icons);
  if (!status)
    status = report->dimension == 3
                 ? write_solid(context, partial, settings, report, index, field, density,
                               icons)
                 : fg_picture_write(context, partial, field,
                                    report->placed ? regions : density, icons, &options);
  int code = status ? complain_of_partial(context, status, partial, settings->output)
                    : EXIT_DONE;
  fg_texture_destroy(background);
  return publish_file(partial, settings->output, code);
}

int command_draw(const void *given)
{
  const draw_settings *settings = given;
  cli_report report = {0};
  fg_context *context = NULL;
  fg_icons *icons = NULL;
  fg_field *field = NULL;
  fg_density *density = NULL, *regions = NULL;
  int code = check_output(settings);
  if (!code)
    code = report_read(&report, settings->folder);
  if (!code)
    code = check_dimension(settings, report.dimension);
  if (!code)
    code = check_map(settings);
  if (code)
    goto cleanup;
  int index = choose_scale(settings, &report);
  if (index < 0 || create_context(&context)) {
    code = EXIT_FAILED;
    goto cleanup;
  }
  interrupt_start(context);
  code = read_icons(&icons, context, settings, &report, index);
  if (!code)
    code = read_field(&field, context, settings, &report);
  if (!code)
    code = project_icons(&icons, context, settings, field);
  if (!code)
    code = read_density(&density, context, settings, &report, index, field);
  if (!code)
    code = make_regions(&regions, context, settings, &report, field, icons);
  if (!code)
    code =
        write_picture(context, settings, &report, index, field, density, regions, icons);
cleanup:
  interrupt_end();
  fg_density_destroy(regions);
  fg_density_destroy(density);
  fg_field_destroy(field);
  fg_icons_destroy(icons);
  fg_context_destroy(context);
  report_clear(&report);
  return code;
}
