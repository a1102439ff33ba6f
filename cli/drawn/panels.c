#include "drawn/panels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "drawn/background.h"
#include "folder/file.h"
#include "folder/files.h"
#include "report/series_index.h"

/* Allocates each run by itself, as scales point to it. */
static int add_run(drawn_panels *out, const char *folder)
{
  drawn_run **more = realloc(out->run, ((size_t)out->runs + 1) * sizeof(drawn_run *));
  if (more)
    out->run = more;
  drawn_run *run = more ? calloc(1, sizeof *run) : NULL;
  if (!run)
    return complain_of_memory("runs");
  out->run[out->runs++] = run;
  return drawn_run_open(run, folder);
}

static drawn_run *last_run(const drawn_panels *panels)
{
  return panels->run[panels->runs - 1];
}

/* Adds a panel of the last run. */
static int add_panel(drawn_panels *out, int index, const char *file)
{
  if (out->scales == FG_MOST_PANELS) {
    complain("more than %d panels", FG_MOST_PANELS);
    advise("Name fewer folders, or choose scales with --arrows.");
    return EXIT_FAILED;
  }
  drawn_scale *more = realloc(out->scale, ((size_t)out->scales + 1) * sizeof *more);
  if (!more)
    return complain_of_memory("panels");
  out->scale = more;
  more[out->scales++] = (drawn_scale){.run = last_run(out), .index = index, .file = file};
  return EXIT_DONE;
}

/* Adds the scales of the last run that the options choose. */
static int add_scales(drawn_panels *out, const draw_settings *settings)
{
  const drawn_run *run = last_run(out);
  const number_list *numbers =
      settings->arrows.count ? &settings->arrows : &settings->clusters;
  const int count = settings->all_scales ? run->report.scale_count
                    : numbers->count     ? numbers->count
                                         : 1;
  int code = EXIT_DONE;
  for (int k = 0; k < count && !code; ++k) {
    const int number = numbers->count ? numbers->number[k] : 0;
    const int index =
        settings->all_scales
            ? k
            : drawn_scale_choose(run, settings, settings->arrows.count ? number : 0,
                                 settings->clusters.count ? number : 0);
    code = index < 0 ? EXIT_FAILED : add_panel(out, index, NULL);
  }
  return code;
}

static int add_folder(drawn_panels *out, const draw_settings *settings,
                      const char *folder)
{
  int code = add_run(out, folder);
  return code ? code : add_scales(out, settings);
}

static int add_series(drawn_panels *out, const draw_settings *settings,
                      const char *folder)
{
  char(*names)[MEMBER_NAME_BYTES];
  const int before = out->runs;
  int count, code = index_names(&names, &count, folder);
  for (int n = 0; n < count && !code; ++n) {
    char *member = join_path(folder, names[n]);
    if (!member)
      code = EXIT_FAILED;
    else if (file_is_there(member, REPORT_NAME))
      code = add_folder(out, settings, member);
    else
      fprintf(stderr, "flowgrain: %s: not finished, and left out\n", member);
    free(member);
  }
  free(names);
  if (!code && out->runs == before) {
    complain("%s: holds no finished run", folder);
    code = EXIT_FAILED;
  }
  return code;
}

/* Adds a file of icons: a scale of the run in its folder, or, if made by another program
 * or method, icons on the field of the run before it. */
static int add_file(drawn_panels *out, const char *path)
{
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  char *folder = join_texts(path, "");
  if (!folder)
    return complain_of_memory("a folder's name");
  cut_to_parent(folder);
  int code = EXIT_DONE, index = -1;
  if (file_is_there(folder, REPORT_NAME)) {
    code = add_run(out, folder);
    const cli_report *report = &last_run(out)->report;
    for (int k = 0; k < report->scale_count && !code && index < 0; ++k) {
      const char *icons = report_scale_icons(report, k);
      index = icons && strcmp(icons, name) == 0 ? k : -1;
    }
  }
  free(folder);
  if (!code && out->runs == 0) {
    complain("%s: is of no run, and so the field under its arrows is not known", path);
    advise("Name the folder of a run on that field before it.");
    return EXIT_FAILED;
  }
  return code ? code : add_panel(out, index, index < 0 ? path : NULL);
}

static int add_operand(drawn_panels *out, const draw_settings *settings,
                       const char *operand)
{
  if (ends_with(operand, ".geojson"))
    return add_file(out, operand);
  if (series_is_there(operand))
    return add_series(out, settings, operand);
  return add_folder(out, settings, operand);
}

int drawn_panels_open(drawn_panels *out, const draw_settings *settings)
{
  *out = (drawn_panels){.runs = 0};
  int code = add_operand(out, settings, settings->folder);
  for (int k = 0; k < settings->more.count && !code; ++k)
    code = add_operand(out, settings, settings->more.operand[k]);
  return code;
}

void drawn_panels_close(drawn_panels *panels)
{
  for (int k = 0; k < panels->scales; ++k)
    drawn_scale_clear(&panels->scale[k]);
  for (int k = 0; k < panels->runs; ++k) {
    drawn_run_close(panels->run[k]);
    free(panels->run[k]);
  }
  free(panels->scale);
  free(panels->run);
  *panels = (drawn_panels){.runs = 0};
}

static int labels_given(const char *wanted)
{
  int given = 1;
  for (const char *at = wanted; *at; ++at)
    given += *at == '|';
  return given;
}

int drawn_panels_check_labels(const drawn_panels *panels, const draw_settings *settings)
{
  const int given = settings->panel_label ? labels_given(settings->panel_label) : 1;
  if (given == 1 || given == panels->scales)
    return EXIT_DONE;
  complain("--panel-label %s: %d labels, and there are %d panels", settings->panel_label,
           given, panels->scales);
  advise("Say one for all, or one for each.");
  return EXIT_USAGE;
}

/* Splits a copy of the option's text into labels, which point into it. */
static void set_labels(fg_panel *panel, int count, char *copy)
{
  const bool several = copy && labels_given(copy) > 1;
  for (int k = 0; k < count && copy; ++k) {
    panel[k].label = copy;
    if (!several)
      continue;
    copy += strcspn(copy, "|");
    if (*copy)
      *copy++ = '\0';
  }
}

/* The union of the runs' ranges of speed. */
static void join_speeds(double speeds[2], const drawn_panels *panels)
{
  for (int k = 0; k < panels->runs; ++k) {
    const double *own = panels->run[k]->report.speeds;
    if (!(own[1] > own[0]))
      continue;
    const bool first = !(speeds[1] > speeds[0]);
    speeds[0] = first || own[0] < speeds[0] ? own[0] : speeds[0];
    speeds[1] = first || own[1] > speeds[1] ? own[1] : speeds[1];
  }
}

static fg_status make_backgrounds(fg_panel *panel, fg_texture **texture,
                                  fg_context *context, const drawn_panels *panels,
                                  const draw_settings *settings,
                                  const fg_picture_options *options)
{
  int size[2];
  if (!settings->picture.background)
    return FG_STATUS_OK;
  fg_status status = fg_panels_frame(size, context, panel, panels->scales, options);
  for (int k = 0; k < panels->scales && !status; ++k) {
    status = background_make(&texture[k], context, &settings->picture, 0, size,
                             panel[k].field, panels->scale[k].density);
    panel[k].background = texture[k];
  }
  return status;
}

static fg_status draw(fg_panel *panel, fg_texture **texture, fg_context *context,
                      const drawn_panels *panels, const draw_settings *settings,
                      const char *path)
{
  const fg_map_options map = drawn_run_map(panels->scale[0].run, settings);
  fg_picture_options options = settings_picture(&settings->picture, &map);
  double speeds[2] = {0.0, 0.0};
  for (int k = 0; k < panels->scales; ++k) {
    const drawn_scale *scale = &panels->scale[k];
    panel[k].field = scale->run->field;
    panel[k].name = scale->file ? scale->file : scale->run->folder;
    panel[k].icons = scale->icons;
    panel[k].density = scale->run->report.placed ? scale->regions : scale->density;
    panel[k].scale_time = drawn_scale_time(scale);
  }
  join_speeds(speeds, panels);
  settings_speeds(speeds, &settings->picture);
  options.speed_min = speeds[0];
  options.speed_max = speeds[1];
  background_range(&options, &settings->picture);
  options.columns = settings->columns;
  double key_width = 0.0;
  options.key_width = &key_width;
  fg_status status =
      make_backgrounds(panel, texture, context, panels, settings, &options);
  if (!status)
    status = fg_panels_write(context, path, panel, panels->scales, &options);
  tell_key_width(settings->output ? settings->output : path, key_width);
  return status;
}

int drawn_panels_read(drawn_panels *panels, fg_context *context,
                      const draw_settings *settings)
{
  int code = EXIT_DONE;
  for (int k = 0; k < panels->scales && !code; ++k)
    code = drawn_scale_read(&panels->scale[k], context, settings);
  return code;
}

fg_status drawn_panels_draw(const drawn_panels *panels, fg_context *context,
                            const draw_settings *settings, const char *path)
{
  const size_t count = (size_t)panels->scales;
  fg_panel *panel = calloc(count, sizeof *panel);
  fg_texture **texture = calloc(count, sizeof(fg_texture *));
  char *labels = settings->panel_label ? join_texts(settings->panel_label, "") : NULL;
  fg_status status = FG_STATUS_MEMORY;
  if (panel && texture && (labels || !settings->panel_label)) {
    set_labels(panel, panels->scales, labels);
    status = draw(panel, texture, context, panels, settings, path);
  }
  for (size_t k = 0; k < count && texture; ++k)
    fg_texture_destroy(texture[k]);
  free(labels);
  free(texture);
  free(panel);
  return status;
}
