#include "run/checkpoint.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder/files.h"
#include "folder/scale_files.h"
#include "option/recorded.h"
#include "option/table.h"
#include "ranks.h"
#include "report/coarsening.h"
#include "report/json.h"

/* cJSON may write only 15 digits of a number. */
static void add_exact(cJSON *object, const char *name, double value)
{
  char text[32];
  snprintf(text, sizeof text, "%.17g", value);
  cJSON_AddItemToObject(object, name, cJSON_CreateRaw(text));
}

static void add_whole(cJSON *object, const char *name, long value)
{
  cJSON_AddNumberToObject(object, name, (double)value);
}

enum { SCORE_NUMBERS = 11 };

/* The numbers of a score that a run reports, to be saved or restored. */
static void find_score_numbers(double *out[SCORE_NUMBERS], fg_score *score)
{
  fg_reader_error *const readers[] = {&score->diffusion, &score->nearest,
                                      &score->inverse_distance};
  int count = 0;
  out[count++] = &score->mean;
  out[count++] = &score->percentile_95;
  for (size_t k = 0; k < sizeof readers / sizeof *readers; ++k) {
    out[count++] = &readers[k]->mean;
    out[count++] = &readers[k]->percentile_95;
    out[count++] = &readers[k]->speed_weighted;
  }
}

static void add_score(cJSON *scale, const scale_result *result)
{
  fg_score score = result->score;
  double *number[SCORE_NUMBERS];
  if (!result->has_score)
    return;
  find_score_numbers(number, &score);
  cJSON *list = cJSON_AddArrayToObject(scale, "score");
  for (int k = 0; k < SCORE_NUMBERS; ++k) {
    char text[32];
    snprintf(text, sizeof text, "%.17g", *number[k]);
    cJSON_AddItemToArray(list, isfinite(*number[k]) ? cJSON_CreateRaw(text)
                                                    : cJSON_CreateNull());
  }
}

static void restore_score(scale_result *result, const cJSON *scale)
{
  const cJSON *list = cJSON_GetObjectItemCaseSensitive(scale, "score");
  double *number[SCORE_NUMBERS];
  result->has_score = cJSON_GetArraySize(list) == SCORE_NUMBERS;
  if (!result->has_score)
    return;
  find_score_numbers(number, &result->score);
  for (int k = 0; k < SCORE_NUMBERS; ++k)
    *number[k] = cJSON_GetNumberValue(cJSON_GetArrayItem(list, k)); /* null: NaN */
}

static void add_scale(cJSON *scales, const scale_result *result)
{
  cJSON *scale = cJSON_CreateObject();
  cJSON_AddItemToObject(scale, "wanted",
                        cJSON_CreateIntArray(result->wanted, result->wanted_count));
  add_whole(scale, "clusters", result->clusters);
  add_whole(scale, "icons", result->icons);
  add_whole(scale, "dropped", result->dropped);
  add_exact(scale, "time", result->time);
  add_exact(scale, "energy", result->energy);
  add_exact(scale, "area_fraction", result->area_fraction);
  add_score(scale, result);
  if (result->has_features)
    cJSON_AddItemToObject(scale, "features",
                          cJSON_CreateIntArray(result->features, FG_CRITICAL_KINDS));
  cJSON_AddItemToArray(scales, scale);
}

static void add_record(cJSON *root, const fg_run *scales)
{
  fg_run_record record;
  fg_run_describe(&record, scales);
  cJSON_AddItemToObject(root, "wanted",
                        cJSON_CreateIntArray(record.wanted, record.count));
  add_whole(root, "next", record.next);
  add_whole(root, "taken", record.taken);
  add_whole(root, "last_scale_clusters", record.last_clusters);
  add_whole(root, "last_scale_step", record.last_step);
  add_whole(root, "first_step", record.first.step);
  add_whole(root, "first_clusters", record.first.clusters);
  add_exact(root, "first_time", record.first.time);
  add_exact(root, "first_seconds", record.first.seconds);
}

/* The program's state as JSON. NULL without memory; to be freed by cJSON_free. */
static char *describe(const cli_run *run)
{
  const run_facts *facts = &run->facts;
  double now = clock_seconds();
  cJSON *root = cJSON_CreateObject();
  cJSON_AddItemToObject(root, "options", options_record(run->settings));
  add_whole(root, "table_bytes", (long)run->table.bytes);
  add_record(root, run->scales);
  add_whole(root, "rejected", facts->rejected);
  add_exact(root, "mass_drift", facts->mass_drift);
  add_exact(root, "largest_residual", facts->largest_residual);
  cJSON_AddBoolToObject(root, "energy_monotone", facts->energy_monotone);
  coarsening_add(root, facts);
  cJSON *scales = cJSON_AddArrayToObject(root, "scales");
  for (int k = 0; k < drawing_count(run->drawing); ++k)
    add_scale(scales, drawing_result(run->drawing, k));
  const common_look *look = drawing_look(run->drawing);
  add_exact(root, "slowest", look->speeds[0]);
  add_exact(root, "fastest", look->speeds[1]);
  add_exact(root, "azimuth", look->view[0]);
  add_exact(root, "elevation", look->view[1]);
  add_exact(root, "seconds_read", facts->seconds_read);
  add_exact(root, "seconds_evolve", run->earlier_evolve + now - run->evolving_since);
  add_exact(root, "seconds_icons", drawing_icon_seconds(run->drawing));
  add_exact(root, "seconds_pictures", drawing_picture_seconds(run->drawing));
  add_exact(root, "seconds_total", run->earlier_total + now - run->start);
  char *text = json_print(root);
  cJSON_Delete(root);
  return text;
}

static void warn(cli_run *run, const char *what)
{
  if (!run->save_failed) {
    progress_wipe(&run->progress);
    if (run->saved_step)
      complain("%s; the checkpoint of step %" PRId64 " stays, and the run goes on", what,
               run->saved_step);
    else
      complain("%s; the run goes on without a checkpoint", what);
  }
  run->save_failed = true;
}

static void warn_of_file(cli_run *run, const char *path)
{
  char text[1024];
  snprintf(text, sizeof text, "%s: cannot be written: %s", path, strerror(errno));
  warn(run, text);
}

/* On rank 0, before all write: flushes the files on which the checkpoint depends. */
static bool prepare(cli_run *run, char **note)
{
  if (!table_flush(&run->table, true)) {
    warn_of_file(run, run->table.path);
    return false;
  }
  if (output_synchronise(&run->output))
    return false; /* an error was printed */
  *note = describe(run);
  if (!*note)
    warn(run, "out of memory for a checkpoint");
  return *note;
}

/* On failure rank 0 has printed the reason. */
static bool save(cli_run *run)
{
  char *note = NULL;
  bool prepared = !ranks_leader() || prepare(run, &note), saved = false;
  if (!ranks_any(!prepared)) {
    saved = !fg_evolution_save(fg_run_evolution(run->scales), run->checkpoint, note);
    if (!saved)
      warn(run, fg_context_message(run->context));
    fg_context_clear(run->context);
  }
  cJSON_free(note);
  return saved;
}

int checkpoint_save(cli_run *run)
{
  if (run->step.step == run->saved_step)
    return EXIT_DONE;
  /* a failed drawing is reported at the end of the run */
  bool drawn = !ranks_leader() || drawing_wait(run->drawing);
  int code = ranks_agree(drawn ? EXIT_DONE : EXIT_FAILED);
  if (code)
    return code;
  double before = clock_seconds();
  bool saved = save(run);
  run->save_tried = clock_seconds();
  if (!saved)
    return EXIT_DONE;
  run->saved_step = run->step.step;
  run->save_failed = false;
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    fprintf(stderr,
            "flowgrain: checkpoint: step %" PRId64 ", t = %.3e, %.3f s to write\n",
            run->step.step, run->step.time, run->save_tried - before);
  }
  return EXIT_DONE;
}

bool checkpoint_is_due(const cli_run *run)
{
  bool due = clock_seconds() - run->save_tried >= run->settings->checkpoint;
  return ranks_any(due && ranks_leader());
}

static const cJSON *item_of(const cJSON *object, const char *name)
{
  return cJSON_GetObjectItemCaseSensitive(object, name);
}

static double real_of(const cJSON *object, const char *name)
{
  return cJSON_GetNumberValue(item_of(object, name));
}

static long whole_of(const cJSON *object, const char *name)
{
  double value = real_of(object, name);
  return value >= 0.0 && value <= 0x1p53 ? (long)value : 0;
}

static int list_of(int *out, int most, const cJSON *object, const char *name)
{
  int count = 0;
  const cJSON *item;
  cJSON_ArrayForEach(item, item_of(object, name)) if (count < most) out[count++] =
      item->valueint;
  return count;
}

/* Whether a file on which the checkpoint depends is missing. */
static bool lacks(const cli_run *run, int index, const char *end)
{
  char name[SCALE_NAME_BYTES];
  scale_name(name, index, end);
  if (file_is_there(run->output.work, name))
    return false;
  complain("%s: damaged: %s, which its checkpoint counts on, is not there",
           run->output.work, name);
  advise("Start anew with --force.");
  return true;
}

static bool scales_are_there(const cli_run *run, int count)
{
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int files = scale_file_ends(ends, run->settings, run->field);
  for (int k = 0; k < count; ++k)
    for (int n = 0; n < files; ++n)
      if (lacks(run, k, ends[n]))
        return false;
  return true;
}

static int restore_scales(cli_run *run, const cJSON *note)
{
  scale_result results[MAX_SCALES + 1] = {{.wanted_count = 0}};
  int count = 0;
  const cJSON *scale;
  cJSON_ArrayForEach(scale, item_of(note, "scales"))
  {
    if (count > MAX_SCALES)
      break;
    scale_result *result = &results[count++];
    result->wanted_count = list_of(result->wanted, MAX_SCALES, scale, "wanted");
    result->clusters = (int)whole_of(scale, "clusters");
    result->icons = (int)whole_of(scale, "icons");
    result->dropped = (int)whole_of(scale, "dropped");
    result->time = real_of(scale, "time");
    result->energy = real_of(scale, "energy");
    result->area_fraction = real_of(scale, "area_fraction");
    restore_score(result, scale);
    result->has_features = list_of(result->features, FG_CRITICAL_KINDS, scale,
                                   "features") == FG_CRITICAL_KINDS;
  }
  if (!scales_are_there(run, count))
    return EXIT_FAILED;
  const common_look look = {
      .speeds = {real_of(note, "slowest"), real_of(note, "fastest")},
      .view = {real_of(note, "azimuth"), real_of(note, "elevation")}};
  drawing_restore(run->drawing, results, count, &look, real_of(note, "seconds_icons"),
                  real_of(note, "seconds_pictures"));
  return output_go_on(&run->output, count);
}

static void restore_record(fg_run_record *out, const cJSON *note)
{
  *out = (fg_run_record){.next = (int)whole_of(note, "next"),
                         .taken = (int)whole_of(note, "taken"),
                         .last_clusters = (int)whole_of(note, "last_scale_clusters"),
                         .last_step = whole_of(note, "last_scale_step"),
                         .first = {.step = whole_of(note, "first_step"),
                                   .clusters = (int)whole_of(note, "first_clusters"),
                                   .time = real_of(note, "first_time"),
                                   .seconds = real_of(note, "first_seconds")}};
  out->count = list_of(out->wanted, MAX_SCALES, note, "wanted");
}

/* On all ranks. */
static void restore_counts(cli_run *run, const cJSON *note)
{
  run->facts.accepted = run->step.step;
  run->facts.rejected = whole_of(note, "rejected");
  run->facts.mass_drift = real_of(note, "mass_drift");
  run->facts.largest_residual = real_of(note, "largest_residual");
  run->facts.energy_monotone = cJSON_IsTrue(item_of(note, "energy_monotone"));
  coarsening_restore(&run->facts, note);
  run->facts.seconds_read += real_of(note, "seconds_read");
  run->earlier_evolve = real_of(note, "seconds_evolve");
  run->earlier_total = real_of(note, "seconds_total");
}

/* On rank 0. */
static int restore_results(cli_run *run, const cJSON *note, bool is_previous)
{
  int code = table_resume(&run->table, output_path(&run->output, TABLE_NAME),
                          whole_of(note, "table_bytes"));
  if (!code)
    code = restore_scales(run, note);
  return !code && is_previous ? output_use_previous(&run->output) : code;
}

/* Whether this rank's options are those of the checkpoint. */
static int check_note(const cli_run *run, const cJSON *note)
{
  if (note)
    return options_match(item_of(note, "options"), run->settings) ? EXIT_DONE
                                                                  : EXIT_FAILED;
  complain("%s: its checkpoint is not one of this program", run->settings->output);
  return EXIT_FAILED;
}

static int resume(cli_run *run, const fg_checkpoint *checkpoint)
{
  bool is_previous = *fg_checkpoint_damage(checkpoint);
  if (is_previous && ranks_leader())
    complain("%s; the previous checkpoint is used", fg_checkpoint_damage(checkpoint));
  cJSON *note = json_parse(fg_checkpoint_note(checkpoint));
  int code = ranks_agree(check_note(run, note));
  if (!code) {
    fg_run_record record;
    restore_record(&record, note);
    fg_status status = fg_run_resume(&run->step, run->scales, checkpoint, &record);
    if (status)
      code = complain_of(run->context, status, run->settings->output);
  }
  if (!code) {
    restore_counts(run, note);
    code =
        ranks_agree(ranks_leader() ? restore_results(run, note, is_previous) : EXIT_DONE);
  }
  cJSON_Delete(note);
  return code;
}

int checkpoint_resume(cli_run *run)
{
  fg_checkpoint *checkpoint;
  fg_status status = fg_checkpoint_open(&checkpoint, run->context, run->checkpoint);
  if (status) {
    int code = complain_of(run->context, status, run->settings->output);
    advise("Start anew with --force.");
    return code;
  }
  int code = resume(run, checkpoint);
  fg_checkpoint_destroy(checkpoint);
  return code;
}
