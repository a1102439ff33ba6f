#include "series/panels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build_features.h"
#include "drawn/background.h"
#include "drawn/panels.h"
#include "folder/files.h"
#include "folder/made.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/table.h"

/* With more members panels are too small to read at a picture's width. */
enum { MOST_MEMBERS = 12 };

/* "panels-NN." and a format, up to `end`. */
static bool is_name(const char *name, size_t end)
{
  static const char stem[] = "panels-00.";
  const size_t length = sizeof stem - 1;
  if (end != length + 3 || strncmp(name, stem, 7) != 0 || name[9] != '.' ||
      strspn(name + 7, "0123456789") != 2)
    return false;
  for (int kind = 0; kind < FORMAT_KINDS; ++kind)
    if (strncmp(name + length, format_words[kind], 3) == 0)
      return true;
  return false;
}

static bool is_panels(const char *name)
{
  return is_name(name, strlen(name));
}

/* NAME.PROCESS-ATTEMPT.part */
static bool is_part(const char *name)
{
  const size_t length = strlen(name), end = strlen("panels-00.svg");
  return length > end + 5 && is_name(name, end) && name[end] == '.' &&
         strcmp(name + length - 5, ".part") == 0;
}

static int refuse(const char *folder, const char *name, const void *data)
{
  (void)data;
  return index_has_panels(folder, name) ? EXIT_DONE : made_complain(folder, name);
}

int panels_refuse_foreign(const char *folder)
{
  return for_names(folder, is_panels, refuse, NULL);
}

static bool is_panels_or_part(const char *name)
{
  return is_panels(name) || is_part(name);
}

static int remove_one(const char *folder, const char *name, const void *data)
{
  (void)data;
  return is_part(name) || index_has_panels(folder, name) ? remove_file(folder, name)
                                                         : EXIT_DONE;
}

int panels_remove(const char *folder)
{
  return for_names(folder, is_panels_or_part, remove_one, NULL);
}

/* Whether the files of the runs have all that pictures show. */
static bool can_be_drawn(const run_settings *settings)
{
  const picture_settings *picture = &settings->picture;
  const bool needs_density =
      background_needs_density(picture) || (picture->tint && !settings_place(settings));
  return !picture->no_arrows && !picture->skeletons && !picture->centers &&
         (settings->save_field || !needs_density);
}

static int scales_of(const drawn_panels *panels)
{
  int least = MAX_SCALES;
  for (int k = 0; k < panels->runs; ++k) {
    const cli_report *report = &panels->run[k]->report;
    if (report->dimension == 3)
      return 0;
    if (report->scale_count < least)
      least = report->scale_count;
  }
  return least;
}

static int draw_scale(drawn_panels *panels, fg_context *context, int scale,
                      const draw_settings *settings, unsigned formats, fg_status *status)
{
  for (int k = 0; k < panels->scales; ++k) {
    drawn_run *run = panels->scale[k].run;
    drawn_scale_clear(&panels->scale[k]);
    panels->scale[k] = (drawn_scale){.run = run, .index = scale};
  }
  int code = drawn_panels_read(panels, context, settings);
  for (int kind = 0; kind < FORMAT_KINDS && !code && !*status; ++kind) {
    char name[PANELS_NAME_BYTES];
    if (!(formats & (1U << kind)))
      continue;
    panels_name(name, scale, format_words[kind]);
    char *path = join_path(settings->folder, name);
    *status =
        path ? drawn_panels_draw(panels, context, settings, path) : FG_STATUS_MEMORY;
    if (!*status && path)
      printf("%4d panels  %s\n", panels->scales, path);
    free(path);
  }
  return code;
}

/* Runs on different maps or regions have no common figure; that is a warning. */
static int explain(series_index *index, const fg_context *context, fg_status status)
{
  if (status != FG_STATUS_ARGUMENT)
    return complain_of(context, status, index->settings->output);
  fprintf(stderr, "flowgrain: no panels: %s\n", fg_context_message(context));
  int code = panels_remove(index->settings->output);
  index->panel_scales = 0;
  return code ? code : index_write(index);
}

static int draw_all(series_index *index, drawn_panels *panels, fg_context *context,
                    const draw_settings *settings)
{
  fg_status status = FG_STATUS_OK;
  int code = EXIT_DONE;
  for (int k = 0; k < index->panel_scales && !code && !status; ++k)
    code = draw_scale(panels, context, k, settings, index->panel_formats, &status);
  if (interrupt_came()) {
    complain("%s: interrupted before all panels were drawn", settings->folder);
    advise("The same command with --resume goes on.");
    return EXIT_INTERRUPTED;
  }
  return status ? explain(index, context, status) : code;
}

int panels_draw(series_index *index)
{
  const run_settings *run = index->settings;
  const unsigned formats = formats_to_draw(run->formats, false);
  drawn_panels panels = {.runs = 0};
  fg_context *context = NULL;
  draw_settings settings = {.inputs = run->inputs,
                            .picture = run->picture,
                            .folder = run->output,
                            .input = run->reading.input,
                            .scale_index = 0};
  memcpy(settings.picture.speed_range, index->speeds, sizeof index->speeds);
  if (index->count < 2 || !formats || !can_be_drawn(run))
    return EXIT_DONE;
  if (index->count > MOST_MEMBERS) {
    if (!run->quiet)
      fprintf(stderr,
              "flowgrain: no panels: of %d members they would be small; `flowgrain draw "
              "%s -o FILE` draws them\n",
              index->count, run->output);
    return EXIT_DONE;
  }
  int code = drawn_panels_open(&panels, &settings);
  index->panel_scales = code || panels.runs < 2 ? 0 : scales_of(&panels);
  index->panel_formats = formats;
  if (!code && index->panel_scales > 0)
    code = index_write(index); /* names files before they exist */
  if (!code && index->panel_scales > 0)
    code = create_context(&context);
  if (context) {
    interrupt_start(context);
    code = draw_all(index, &panels, context, &settings);
    interrupt_end();
  }
  drawn_panels_close(&panels);
  fg_context_destroy(context);
  return code;
}
