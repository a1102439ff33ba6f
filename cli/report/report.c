#include "report/report.h"

#include "report/coarsening.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder/files.h"
#include "folder/scale_files.h"
#include "option/recorded.h"
#include "option/table.h"
#include "report/communication.h"
#include "report/json.h"

static void add_parameters(cJSON *root, const run_facts *facts)
{
  const run_settings *settings = facts->settings;
  const fg_mesh_info *mesh = &facts->mesh;
  cJSON *object = cJSON_AddObjectToObject(root, "parameters");
  if (settings->evolution.nodes)
    cJSON_AddNumberToObject(object, "nodes", settings->evolution.nodes);
  json_add_text(object, "mesh", mesh->adaptive ? "adaptive" : "uniform");
  json_add_text(object, "scheme", scheme_words[settings->evolution.scheme]);
  if (mesh->alpha > 0.0) {
    cJSON_AddNumberToObject(object, "theta", mesh->theta);
    cJSON_AddNumberToObject(object, "alpha", mesh->alpha);
  }
  if (settings->evolution.residual > 0.0)
    cJSON_AddNumberToObject(object, "residual", settings->evolution.residual);
  json_add_text(object, "energy",
                settings->evolution.energy ? settings->evolution.energy : "flow");
  if (!scales_are_solid(facts->field))
    json_add_text(object, "extent", extent_words[settings->extent]);
  cJSON_AddNumberToObject(object, "anisotropy", mesh->anisotropy);
  cJSON_AddNumberToObject(object, "isotropic_below", mesh->isotropic_below);
  cJSON_AddNumberToObject(object, "coverage", mesh->coverage);
  cJSON_AddNumberToObject(object, "gamma", mesh->gamma);
  cJSON_AddNumberToObject(object, "noise", mesh->noise);
  /* a double cannot hold every seed */
  char seed[32];
  snprintf(seed, sizeof seed, "%llu",
           (unsigned long long)(settings->work.seed ? settings->work.seed : 1));
  cJSON_AddItemToObject(object, "seed", cJSON_CreateRaw(seed));
  if (settings_place(settings)) {
    cJSON_AddStringToObject(object, "lengths", settings->lengths ? "fair" : "free");
    cJSON_AddStringToObject(object, "start",
                            settings->start || settings->tolerance > 0.0 ? "even"
                                                                         : "clusters");
    cJSON_AddStringToObject(object, "effort", effort_words[settings->effort]);
    if (settings->tolerance > 0.0)
      cJSON_AddNumberToObject(object, "tolerance", settings->tolerance);
  }
  if (settings->arrows.count)
    cJSON_AddItemToObject(
        object, "arrows",
        cJSON_CreateIntArray(settings->arrows.number, settings->arrows.count));
  if (settings->clusters.count)
    cJSON_AddItemToObject(
        object, "clusters",
        cJSON_CreateIntArray(settings->clusters.number, settings->clusters.count));
  if (settings->times.count)
    json_add_numbers(object, "times", settings->times.time, settings->times.count);
  if (settings->max_time > 0.0)
    cJSON_AddNumberToObject(object, "max_time", settings->max_time);
  if (settings->max_steps)
    cJSON_AddNumberToObject(object, "max_steps", settings->max_steps);
  if (settings->work.threads)
    cJSON_AddNumberToObject(object, "threads", settings->work.threads);

  /* in the form of the command line, so that --resume can compare them */
  cJSON_AddItemToObject(root, "options", options_record(settings));

  cJSON *made = cJSON_AddObjectToObject(root, "mesh");
  cJSON_AddNumberToObject(made, "dimension", mesh->dimension);
  cJSON_AddItemToObject(made, "cells",
                        cJSON_CreateIntArray(mesh->cells, mesh->dimension));
  json_add_numbers(made, "spacing", mesh->spacing, mesh->dimension);
  cJSON_AddNumberToObject(made, "length", mesh->length);
  cJSON_AddNumberToObject(made, "active_cells", (double)mesh->active_cells);
  cJSON_AddNumberToObject(made, "domain_measure", mesh->domain_measure);
  json_add_text(made, "kernel", mesh->kernel);
  coarsening_add(made, facts);
}

static void add_files(cJSON *scale, const run_facts *facts, int index)
{
  char ends[SCALE_FILES][SCALE_END_BYTES], name[SCALE_NAME_BYTES];
  int files = scale_file_ends(ends, facts->settings, facts->field);
  for (int n = 0; n < files; ++n) {
    scale_name(name, index, ends[n]);
    /* further views have a number: "png-2" */
    char key[SCALE_END_BYTES];
    const char *dot = strrchr(ends[n], '.');
    snprintf(key, sizeof key, "%s%.*s", dot + 1, (int)(dot - ends[n]), ends[n]);
    cJSON_AddStringToObject(scale, key, name);
  }
}

static void add_reader(cJSON *object, const char *name, const fg_reader_error *reader)
{
  cJSON *error = cJSON_AddObjectToObject(object, name);
  cJSON_AddNumberToObject(error, "mean", reader->mean);
  cJSON_AddNumberToObject(error, "percentile_95", reader->percentile_95);
  cJSON_AddNumberToObject(error, "speed_weighted", reader->speed_weighted);
}

static void add_error(cJSON *scale, const fg_score *score)
{
  cJSON *error = cJSON_AddObjectToObject(scale, "error");
  cJSON_AddNumberToObject(error, "mean", score->mean);
  cJSON_AddNumberToObject(error, "percentile_95", score->percentile_95);
  add_reader(error, "diffusion", &score->diffusion);
  add_reader(error, "nearest", &score->nearest);
  add_reader(error, "inverse_distance", &score->inverse_distance);
}

static void add_features(cJSON *scale, const int count[FG_CRITICAL_KINDS])
{
  cJSON *features = cJSON_AddObjectToObject(scale, "features");
  for (int k = 0; k < FG_CRITICAL_KINDS; ++k)
    cJSON_AddNumberToObject(features, fg_critical_kind_word((fg_critical_kind)k),
                            count[k]);
}

static void add_scale(cJSON *scales, const run_facts *facts, int index)
{
  const scale_result *result = drawing_result(facts->drawing, index);
  cJSON *scale = cJSON_CreateObject();
  cJSON_AddNumberToObject(scale, "index", index);
  cJSON_AddNumberToObject(scale, "clusters", result->clusters);
  cJSON_AddNumberToObject(scale, "icons", result->icons);
  cJSON_AddNumberToObject(scale, "dropped", result->dropped);
  cJSON_AddItemToObject(scale, "wanted",
                        cJSON_CreateIntArray(result->wanted, result->wanted_count));
  cJSON_AddNumberToObject(scale, "time", result->time);
  cJSON_AddNumberToObject(scale, "energy", result->energy);
  cJSON_AddNumberToObject(scale, "area_fraction", result->area_fraction);
  if (result->has_score)
    add_error(scale, &result->score);
  if (result->has_features)
    add_features(scale, result->features);
  add_files(scale, facts, index);
  cJSON_AddItemToArray(scales, scale);
}

const char *report_ending_word(fg_run_outcome ended)
{
  static const char *const words[] = {
      [FG_RUN_GO_ON] = "interrupted",     [FG_RUN_ALL] = "scales",
      [FG_RUN_STATIONARY] = "stationary", [FG_RUN_AT_TIME] = "time",
      [FG_RUN_AT_STEPS] = "steps",        [FG_RUN_STOPPED] = "interrupted"};
  return words[ended];
}

static void add_outcome(cJSON *root, const run_facts *facts)
{
  cJSON *scales = cJSON_AddArrayToObject(root, "scales");
  for (int k = 0; k < drawing_count(facts->drawing); ++k)
    add_scale(scales, facts, k);
  if (facts->has_page)
    cJSON_AddStringToObject(root, "page", VIEW_NAME);
  json_add_numbers(root, "speed_range", drawing_look(facts->drawing)->speeds, 2);
  if (scales_are_solid(facts->field))
    json_add_numbers(root, "view", drawing_look(facts->drawing)->view, 2);
  cJSON_AddStringToObject(root, "ended", report_ending_word(facts->ended));
  cJSON *steps = cJSON_AddObjectToObject(root, "steps");
  cJSON_AddNumberToObject(steps, "accepted", (double)facts->accepted);
  cJSON_AddNumberToObject(steps, "rejected", (double)facts->rejected);
  cJSON_AddNumberToObject(root, "mass_drift", facts->mass_drift);
  if (facts->largest_residual > 0.0)
    cJSON_AddNumberToObject(root, "largest_residual", facts->largest_residual);
  cJSON_AddBoolToObject(root, "energy_monotone",
                        facts->energy_monotone && !coarsening_raised_energy(facts));
  cJSON_AddBoolToObject(root, "energy_monotone_between_coarsenings",
                        facts->energy_monotone);
  communication_add(root, facts);
  cJSON *seconds = cJSON_AddObjectToObject(root, "seconds");
  cJSON_AddNumberToObject(seconds, "read", facts->seconds_read);
  cJSON_AddNumberToObject(seconds, "evolve", facts->seconds_evolve);
  cJSON_AddNumberToObject(seconds, "icons", drawing_icon_seconds(facts->drawing));
  cJSON_AddNumberToObject(seconds, "pictures", drawing_picture_seconds(facts->drawing));
  cJSON_AddNumberToObject(seconds, "total", facts->seconds_total);
}

static int write_text(const char *path, const char *text)
{
  FILE *stream = fopen(path, "w");
  if (!stream)
    return complain_of_file(path, "cannot be written");
  bool failed = fputs(text, stream) < 0 || fputc('\n', stream) == EOF;
  failed = fclose(stream) != 0 || failed;
  return failed ? complain_of_file(path, "cannot be written") : EXIT_DONE;
}

int report_write(const char *path, const run_facts *facts)
{
  int code = EXIT_FAILED;
  cJSON *root = cJSON_CreateObject();
  cJSON_AddStringToObject(root, "program", "flowgrain");
  cJSON_AddStringToObject(root, "version", fg_version());
  reading_report(root, &facts->reading);
  add_parameters(root, facts);
  add_outcome(root, facts);
  char *text = json_print(root);
  if (text)
    code = write_text(path, text);
  else
    complain_of_memory("run.json");
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}
