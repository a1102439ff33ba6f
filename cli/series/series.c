#include "series/series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "folder/made.h"
#include "folder/results.h"
#include "inputs.h"
#include "interrupt.h"
#include "progress.h"
#include "ranks.h"
#include "report/series_index.h"
#include "series/panels.h"

/* The name of a member's folder: "time-0011", "level-003", "time-0011-level-003". */
static void name_member(char out[MEMBER_NAME_BYTES], const chosen_places *places,
                        int time, int level)
{
  char level_name[MEMBER_NAME_BYTES / 2] = "";
  if (places->level.several)
    snprintf(level_name, sizeof level_name, "level-%03d", level);
  if (places->time.several)
    snprintf(out, MEMBER_NAME_BYTES, "time-%04d%s%s", time, *level_name ? "-" : "",
             level_name);
  else
    snprintf(out, MEMBER_NAME_BYTES, "%s", level_name);
}

int series_refuse(const char *folder)
{
  if (!series_is_there(folder))
    return EXIT_DONE;
  complain("%s: holds a series of runs", folder);
  advise("Choose another folder with -o.");
  return EXIT_FAILED;
}

static const char *words_of(const fg_axis_value *values, int index)
{
  return values ? values[index].words : NULL;
}

static int list_members(series_index *out, const chosen_places *places)
{
  const fg_selection *time = &places->time, *level = &places->level;
  const fg_inventory_vector *vector = places->vector;
  out->member = calloc((size_t)time->count * (size_t)level->count, sizeof *out->member);
  if (!out->member)
    return complain_of_memory("a series");
  for (int t = 0; t < time->count; ++t)
    for (int l = 0; l < level->count; ++l) {
      series_member *member = &out->member[out->count++];
      member->time = time->index[t];
      member->level = level->index[l];
      name_member(member->name, places, member->time, member->level);
      if (vector) {
        member->time_words = words_of(vector->time_value, member->time);
        member->level_words = words_of(vector->level_value, member->level);
      }
    }
  return EXIT_DONE;
}

/* Checks that DIR can hold the series. *goes_on: it holds an unfinished one. */
static int check_folder(series_index *index, bool *goes_on)
{
  const run_settings *settings = index->settings;
  *goes_on = false;
  int code = output_check(settings->output);
  if (code)
    return code;
  if (file_is_there(settings->output, REPORT_NAME)) {
    complain("%s: holds the results of a run, and a series of runs has a folder of its "
             "own",
             settings->output);
    advise("Choose another folder with -o.");
    return EXIT_FAILED;
  }
  code = panels_refuse_foreign(settings->output);
  if (code || !series_is_there(settings->output) || settings->force)
    return code;
  if (!settings->resume) {
    complain("%s: holds a series of runs", settings->output);
    advise("Choose another folder with -o, or replace its results with --force, or go on "
           "with --resume.");
    return EXIT_FAILED;
  }
  *goes_on = index_matches(index);
  return *goes_on ? EXIT_DONE : EXIT_FAILED;
}

/* Extends the range by a member's field. Failures are left to the member's run, but for a
 * file that cannot be read at all. */
static int add_speeds(double speeds[2], fg_context *context, const series_index *index,
                      fg_input *input, int number)
{
  const series_member *member = &index->member[number];
  double range[2];
  fg_field *field;
  int code = EXIT_DONE;
  fg_status status =
      fg_input_field(&field, context, input, member->time, member->level, 0, 1);
  if (status == FG_STATUS_FILE_ACCESS)
    code = complain_of(context, status, index->settings->reading.input);
  if (!status)
    status = fg_field_speed_range(range, context, field);
  if (!status) {
    speeds[0] = fmin(speeds[0], range[0]);
    speeds[1] = fmax(speeds[1], range[1]);
  }
  fg_context_clear(context);
  fg_field_destroy(field);
  return code;
}

/* Finds the common range of all fields, unless it is given. */
static int find_speeds(series_index *index, fg_input *input)
{
  const run_settings *settings = index->settings;
  fg_context *context;
  double speeds[2] = {HUGE_VAL, -HUGE_VAL};
  int code = create_context(&context);
  if (code)
    return code;
  interrupt_start(context);
  cli_progress progress;
  progress_start(&progress, settings->quiet, 0);
  for (int n = 0; n < index->count && !code && !interrupt_came(); ++n) {
    progress_stage(&progress, "reading the fields' speeds");
    code = add_speeds(speeds, context, index, input, n);
  }
  progress_wipe(&progress);
  interrupt_end();
  fg_context_destroy(context);
  if (!code && interrupt_came())
    code = EXIT_INTERRUPTED;
  if (speeds[0] > speeds[1])
    speeds[0] = speeds[1] = 0.0;
  fg_picture_round_speeds(speeds);
  settings_speeds(speeds, &settings->picture);
  memcpy(index->speeds, speeds, sizeof speeds);
  return code;
}

/* Removes folders of the replaced series that are not members of this one. */
static int remove_others(const series_index *index)
{
  char(*names)[MEMBER_NAME_BYTES];
  int count, code = index_names(&names, &count, index->settings->output);
  for (int n = 0; n < count && !code; ++n) {
    bool kept = false;
    for (int k = 0; k < index->count && !kept; ++k)
      kept = strcmp(names[n], index->member[k].name) == 0;
    char *folder = kept ? NULL : join_path(index->settings->output, names[n]);
    if (folder)
      code = made_remove(folder, NULL);
    if (folder)
      rmdir(folder); /* fails on a folder that is not empty */
    free(folder);
  }
  free(names);
  return code;
}

/* On rank 0: checks the folder, finds the range, writes the index. */
static int begin(series_index *index, fg_input *input)
{
  bool goes_on;
  int code = check_folder(index, &goes_on);
  if (!code)
    code = panels_remove(index->settings->output);
  if (code || goes_on)
    return code;
  code = find_speeds(index, input);
  char *made_from = NULL;
  if (!code)
    code = make_folders(index->settings->output, &made_from);
  if (!code && index->settings->force)
    code = remove_others(index);
  if (!code)
    code = index_write(index);
  free(made_from);
  return code;
}

static int run_member(const series_index *index, const series_member *member,
                      int (*run)(const run_settings *settings))
{
  run_settings settings = *index->settings;
  settings.reading.time = member->time;
  settings.reading.level = member->level;
  settings.member = true;
  memcpy(settings.picture.speed_range, index->speeds, sizeof index->speeds);
  char *folder = join_path(index->settings->output, member->name);
  settings.output = folder;
  int code = folder ? run(&settings) : complain_of_memory("a file's name");
  free(folder);
  return code;
}

/* A member that fails because of its data does not stop the others. */
static int run_members(const series_index *index,
                       int (*run)(const run_settings *settings))
{
  int failed = 0, done = 0, code = EXIT_DONE;
  for (int n = 0; n < index->count; ++n) {
    code = ranks_any(interrupt_came()) ? EXIT_INTERRUPTED
                                       : run_member(index, &index->member[n], run);
    if (code == EXIT_USAGE || code == EXIT_INTERRUPTED)
      break;
    failed += code != EXIT_DONE;
    ++done;
  }
  const char *folder = index->settings->output;
  if (code == EXIT_INTERRUPTED && ranks_leader()) {
    complain("%s: interrupted after %d of %d fields", folder, done - failed,
             index->count);
    advise("The same command with --resume goes on.");
  }
  if (code == EXIT_USAGE || code == EXIT_INTERRUPTED)
    return code;
  if (failed && ranks_leader())
    complain("%s: %d of %d fields could not be done", folder, failed, index->count);
  return failed ? EXIT_FAILED : EXIT_DONE;
}

/* Also draws figures of the members that succeeded. */
static int do_members(series_index *index, int (*run)(const run_settings *settings))
{
  const int code = run_members(index, run);
  if (code != EXIT_DONE && code != EXIT_FAILED)
    return code;
  const int panels = ranks_agree(ranks_leader() ? panels_draw(index) : EXIT_DONE);
  return code ? code : panels;
}

int series_run(const run_settings *settings, const chosen_places *places,
               int (*run)(const run_settings *settings))
{
  series_index index = {.settings = settings};
  int code = ranks_agree(list_members(&index, places));
  if (!code)
    code = ranks_agree(ranks_leader() ? begin(&index, places->input) : EXIT_DONE);
  if (!code)
    code = ranks_agree(
        ranks_leader() ? EXIT_DONE : index_read_speeds(index.speeds, settings->output));
  if (!code)
    code = do_members(&index, run);
  free(index.member);
  return code;
}
