/* Draws scales of finished runs: one, or several as panels of a figure. */
#include <stdio.h>
#include <string.h>

#include "build_features.h"
#include "command/command.h"
#include "drawn/background.h"
#include "drawn/panels.h"
#include "folder/file.h"
#include "folder/made.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/validation.h"
#include "series/series.h"

/* Refuses options of pictures for solids. */
static int check_solids(const draw_settings *settings)
{
  const given_option of_pictures[] = {
      {"view", settings->picture.view_count > 0},
      {"width", settings->picture.width > 0.0},
      {"height", settings->picture.height > 0.0},
      {"dpi", settings->picture.dpi > 0.0},
      {"title", settings->picture.title != NULL},
      {"subtitle", settings->picture.subtitle != NULL},
      {"label", settings->picture.label != NULL},
      {"font-size", settings->picture.font_size > 0.0},
      {"no-keys", settings->picture.no_keys},
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
             clusters = settings->clusters.count > 0, all = settings->all_scales;
  if (index + arrows + clusters + all > 1) {
    complain("%s and %s each choose a scale: say one",
             all     ? "--all-scales"
             : index ? "--scale-index"
                     : "--arrows",
             all && index               ? "--scale-index"
             : (all || index) && arrows ? "--arrows"
                                        : "--clusters");
    advise("Try 'flowgrain draw --help'.");
    return EXIT_USAGE;
  }
  return is_solids(path) ? check_solids(settings) : check_picture_name(path, "draw");
}

static int check_dimension(const draw_settings *settings, int dimension,
                           const char *folder)
{
  if (is_solids(settings->output) && dimension == 2) {
    complain("-o %s: only in 3D, and %s is in 2D", settings->output, folder);
    advise("Try 'flowgrain draw --help'.");
    return EXIT_USAGE;
  }
  int code = refuse_other_dimension("draw", &settings->picture, dimension, folder);
  if (!code && dimension == 3 && !is_solids(settings->output))
    code = require_feature(settings->output, FG_FEATURE_RENDER);
  return code;
}

static fg_status write_solid(fg_context *context, const char *path,
                             const draw_settings *settings, const drawn_scale *scale)
{
  const cli_report *report = &scale->run->report;
  const fg_density *density = scale->density;
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
  options.scale_time = drawn_scale_time(scale);
  status = fg_solid_write(context, path, scale->run->field, scale->icons, &options);
  fg_surface_destroy(surface);
  return status;
}

static fg_status write_flat(fg_context *context, const char *path,
                            const draw_settings *settings, const drawn_scale *scale)
{
  const cli_report *report = &scale->run->report;
  const fg_map_options map = drawn_run_map(scale->run, settings);
  fg_picture_options options = settings_picture(&settings->picture, &map);
  double speeds[2] = {report->speeds[0], report->speeds[1]};
  settings_speeds(speeds, &settings->picture);
  options.speed_min = speeds[0];
  options.speed_max = speeds[1];
  options.scale_time = drawn_scale_time(scale);
  double key_width = 0.0;
  options.key_width = &key_width;
  fg_texture *background = NULL;
  fg_status status =
      background_choose(&options, &background, context, &settings->picture, 0,
                        scale->run->field, scale->density, scale->icons);
  if (!status)
    status = fg_picture_write(context, path, scale->run->field,
                              report->placed ? scale->regions : scale->density,
                              scale->icons, &options);
  tell_key_width(settings->output, key_width);
  fg_texture_destroy(background);
  return status;
}

static int write_picture(drawn_panels *panels, fg_context *context,
                         const draw_settings *settings, bool several)
{
  int code = drawn_panels_read(panels, context, settings);
  char *partial = code ? NULL : temporary_name(settings->output);
  if (!partial)
    return code ? code : EXIT_FAILED;
  const drawn_scale *first = &panels->scale[0];
  fg_status status = several ? drawn_panels_draw(panels, context, settings, partial)
                     : first->run->report.dimension == 3
                         ? write_solid(context, partial, settings, first)
                         : write_flat(context, partial, settings, first);
  code = status ? complain_of_partial(context, status, partial, settings->output)
                : EXIT_DONE;
  return publish_file(partial, settings->output, code);
}

/* Panels are pictures in 2D; options for panels need several. */
static int check_panels(const drawn_panels *panels, const draw_settings *settings,
                        bool several)
{
  const given_option of_panels[] = {
      {"columns", settings->columns > 0 && !several},
      {"panel-label", settings->panel_label && !several},
  };
  int code = refuse_given("draw", of_panels, 2,
                          "of several panels, and %s is one picture", settings->output);
  if (!code && several && is_solids(settings->output)) {
    complain("-o %s: several runs or scales are drawn as panels of a picture: .svg, .pdf "
             "or .png",
             settings->output);
    return EXIT_USAGE;
  }
  if (!code)
    code = drawn_panels_check_labels(panels, settings);
  for (int k = 0; k < panels->runs && !code; ++k) {
    const drawn_run *run = panels->run[k];
    if (several && run->report.dimension == 3) {
      complain("%s: is in 3D, and panels show runs in 2D", run->folder);
      advise("Draw one at a time; icons of another program from the folder of a run on "
             "their field.");
      return EXIT_FAILED;
    }
    code = check_dimension(settings, run->report.dimension, run->folder);
  }
  return code;
}

int command_draw(const void *given)
{
  const draw_settings *settings = given;
  drawn_panels panels = {.runs = 0};
  fg_context *context = NULL;
  int code = check_output(settings);
  if (!code)
    code = drawn_panels_open(&panels, settings);
  const bool several = panels.scales > 1 || settings->more.count > 0;
  if (!code)
    code = check_panels(&panels, settings, several);
  if (!code)
    code = drawn_check_map(settings);
  if (!code)
    code = create_context(&context);
  if (!code) {
    interrupt_start(context);
    code = write_picture(&panels, context, settings, several);
  }
  interrupt_end();
  drawn_panels_close(&panels);
  fg_context_destroy(context);
  return code;
}
