#include "json_report.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder.h"
#include "said.h"
#include "traffic.h"

static const char *const scale_words[] = {"auto", "geo", "map", "plain"};
static const char *const scheme_words[] = {"bdf2", "euler", "theta"};
static const char *const extent_words[] = {"cluster", "territory"};

static void add_text(cJSON *object, const char *name, const char *text)
{
  if (text)
    cJSON_AddStringToObject(object, name, text);
  else
    cJSON_AddNullToObject(object, name);
}

static void add_numbers(cJSON *object, const char *name, const double *numbers, int count)
{
  cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(numbers, count));
}

static void add_words(cJSON *object, const char *name, const char *const *words,
                      int count)
{
  cJSON *array = cJSON_AddArrayToObject(object, name);
  for (int k = 0; k < count; ++k)
    cJSON_AddItemToArray(array, cJSON_CreateString(words[k]));
}

static void add_input(cJSON *root, const run_facts *facts)
{
  const cli_settings *said = facts->settings;
  const fg_field_arrays *field = fg_field_contents(facts->field);
  cJSON *input = cJSON_AddObjectToObject(root, "input");
  add_text(input, "path", said->operand);
  char *absolute = realpath(said->operand, NULL);
  add_text(input, "absolute", absolute);
  free(absolute);
  add_text(input, "vars", said->vars);
  absolute = said->vars_from ? realpath(said->vars_from, NULL) : NULL;
  add_text(input, "vars_from", absolute ? absolute : said->vars_from);
  free(absolute);
  add_text(input, "mask", said->mask);
  cJSON_AddNumberToObject(input, "time", said->time);
  cJSON_AddNumberToObject(input, "level", said->level);
  if (facts->time_count) {
    cJSON_AddNumberToObject(input, "times", facts->time_count);
    cJSON_AddNumberToObject(input, "levels", facts->level_count);
  }
  add_text(input, "scale", scale_words[said->scale]);

  cJSON *read = cJSON_AddObjectToObject(root, "field");
  add_words(read, "velocity", field->velocity_name, field->dimension);
  add_text(read, "velocity_units", field->velocity_units);
  add_words(read, "axes", field->axis_name, field->dimension);
  add_words(read, "axis_units", field->axis_units, field->dimension);
  cJSON_AddItemToObject(read, "size",
                        cJSON_CreateIntArray(field->size, field->dimension));
  double bounds[6], periods[3];
  for (int k = 0; k < field->dimension; ++k) {
    bounds[2 * k] = field->axis[k][0];
    bounds[2 * k + 1] = field->axis[k][field->size[k] - 1];
    periods[k] = field->period[k];
  }
  add_numbers(read, "bounds", bounds, 2 * field->dimension);
  add_numbers(read, "period", periods, field->dimension);
  add_text(read, "scale", scale_words[field->scale]);
  add_text(read, "title", field->title);
  add_text(read, "time", field->time);
  add_text(read, "level", field->level);
}

static void add_parameters(cJSON *root, const run_facts *facts)
{
  const cli_settings *said = facts->settings;
  const fg_mesh_info *mesh = facts->mesh;
  cJSON *object = cJSON_AddObjectToObject(root, "parameters");
  if (said->nodes)
    cJSON_AddNumberToObject(object, "nodes", said->nodes);
  cJSON_AddStringToObject(object, "mesh", "uniform");
  add_text(object, "scheme", scheme_words[said->scheme]);
  add_text(object, "energy", said->energy ? said->energy : "flow");
  if (!scales_are_solid(facts->field))
    add_text(object, "extent", extent_words[said->extent]);
  cJSON_AddNumberToObject(object, "anisotropy", mesh->anisotropy);
  cJSON_AddNumberToObject(object, "coverage", mesh->coverage);
  cJSON_AddNumberToObject(object, "gamma", mesh->gamma);
  /* a double would round a large seed */
  char seed[32];
  snprintf(seed, sizeof seed, "%llu", (unsigned long long)(said->seed ? said->seed : 1));
  cJSON_AddItemToObject(object, "seed", cJSON_CreateRaw(seed));
  if (said->cluster_count)
    cJSON_AddItemToObject(object, "clusters",
                          cJSON_CreateIntArray(said->clusters, said->cluster_count));
  if (said->max_time > 0.0)
    cJSON_AddNumberToObject(object, "max_time", said->max_time);
  if (said->max_steps)
    cJSON_AddNumberToObject(object, "max_steps", said->max_steps);
  if (said->threads)
    cJSON_AddNumberToObject(object, "threads", said->threads);

  /* as they were said, so that --resume can tell whether this is its run */
  cJSON_AddItemToObject(root, "options", said_options(said));

  cJSON *made = cJSON_AddObjectToObject(root, "mesh");
  cJSON_AddNumberToObject(made, "dimension", mesh->dimension);
  cJSON_AddItemToObject(made, "cells",
                        cJSON_CreateIntArray(mesh->cells, mesh->dimension));
  add_numbers(made, "spacing", mesh->spacing, mesh->dimension);
  cJSON_AddNumberToObject(made, "length", mesh->length);
  cJSON_AddNumberToObject(made, "active_cells", (double)mesh->active_cells);
  cJSON_AddNumberToObject(made, "domain_measure", mesh->domain_measure);
  add_text(made, "kernel", mesh->kernel);
}

static void add_files(cJSON *scale, const run_facts *facts, int index)
{
  char ends[SCALE_FILES][SCALE_END_BYTES], name[SCALE_NAME_BYTES];
  int files = scale_file_ends(ends, facts->settings, facts->field);
  for (int n = 0; n < files; ++n) {
    scale_name(name, index, ends[n]);
    /* further views are called after their place: "png-2" */
    char key[SCALE_END_BYTES];
    const char *dot = strrchr(ends[n], '.');
    snprintf(key, sizeof key, "%s%.*s", dot + 1, (int)(dot - ends[n]), ends[n]);
    cJSON_AddStringToObject(scale, key, name);
  }
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
  add_files(scale, facts, index);
  cJSON_AddItemToArray(scales, scale);
}

static void add_outcome(cJSON *root, const run_facts *facts)
{
  cJSON *scales = cJSON_AddArrayToObject(root, "scales");
  for (int k = 0; k < drawing_count(facts->drawing); ++k)
    add_scale(scales, facts, k);
  add_numbers(root, "speed_range", drawing_speeds(facts->drawing), 2);
  cJSON_AddStringToObject(root, "ended", facts->ended);
  cJSON *steps = cJSON_AddObjectToObject(root, "steps");
  cJSON_AddNumberToObject(steps, "accepted", (double)facts->accepted);
  cJSON_AddNumberToObject(steps, "rejected", (double)facts->rejected);
  cJSON_AddNumberToObject(root, "mass_drift", facts->mass_drift);
  cJSON_AddBoolToObject(root, "energy_monotone", facts->energy_monotone);
  traffic_add(root, facts);
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
  add_input(root, facts);
  add_parameters(root, facts);
  add_outcome(root, facts);
  char *text = cJSON_Print(root);
  if (text)
    code = write_text(path, text);
  else
    complain("out of memory for run.json");
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}

char *read_text(const char *path)
{
  FILE *stream = fopen(path, "rb");
  if (!stream) {
    complain_of_file(path, "cannot be read");
    return NULL;
  }
  char *text = NULL;
  size_t used = 0, room = 0, got = 0;
  do {
    used += got;
    if (room - used < 4096) {
      room = room ? 2 * room : 65536;
      char *larger = realloc(text, room);
      if (!larger) {
        complain("%s: out of memory: %zu bytes", path, room);
        free(text);
        fclose(stream);
        return NULL;
      }
      text = larger;
    }
    got = fread(text + used, 1, room - used - 1, stream);
  } while (got);
  text[used] = '\0';
  if (ferror(stream)) {
    complain_of_file(path, "cannot be read");
    free(text);
    text = NULL;
  }
  fclose(stream);
  return text;
}

static const char *text_of(const cJSON *object, const char *name)
{
  return cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
}

/* A number of run.json within [least, most]; NaN and absent become `otherwise`. */
static double number_of(const cJSON *object, const char *name, double least, double most,
                        double otherwise)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
  if (!cJSON_IsNumber(item) || !(item->valuedouble >= least) ||
      !(item->valuedouble <= most))
    return otherwise;
  return item->valuedouble;
}

run_ending report_ending(const char *folder)
{
  if (!file_is_there(folder, REPORT_NAME))
    return ENDING_NONE;
  char *path = join_path(folder, REPORT_NAME);
  char *text = path ? read_text(path) : NULL;
  cJSON *tree = text ? cJSON_Parse(text) : NULL;
  const char *ended = text_of(tree, "ended");
  run_ending ending = ENDING_COMPLETE;
  if (ended && strcmp(ended, "interrupted") == 0)
    ending = ENDING_INTERRUPTED;
  if (ended && (strcmp(ended, "time") == 0 || strcmp(ended, "steps") == 0))
    ending = ENDING_LIMIT;
  cJSON_Delete(tree);
  free(text);
  free(path);
  return ending;
}

/* Paths of one file may differ; synth:NAME has no path. */
static bool same_input(const cJSON *input, const char *operand)
{
  char *absolute = realpath(operand, NULL);
  const char *earlier = text_of(input, "absolute");
  const char *name = text_of(input, "path");
  bool same = absolute && earlier ? strcmp(absolute, earlier) == 0
                                  : name && strcmp(name, operand) == 0;
  free(absolute);
  return same;
}

bool report_is_of(const char *folder, const cli_settings *settings)
{
  cli_report report;
  bool same = !report_read(&report, folder);
  if (same) {
    const cJSON *input = cJSON_GetObjectItemCaseSensitive(report.tree, "input");
    same = same_input(input, settings->operand);
    if (!same) {
      complain("%s: holds the results of a run on %s", folder, report.input);
      advise("Choose another folder with -o, or replace its results with --force.");
    }
  }
  if (same)
    same =
        said_the_same(cJSON_GetObjectItemCaseSensitive(report.tree, "options"), settings);
  report_clear(&report);
  return same;
}

static const cJSON *scale_at(const cli_report *report, int index)
{
  return cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(report->tree, "scales"),
                            index);
}

static void fill_reading(cli_report *out, const cJSON *input)
{
  out->reading.vars = text_of(input, "vars");
  out->reading.vars_from = text_of(input, "vars_from");
  out->reading.mask = text_of(input, "mask");
  out->reading.time = (int)number_of(input, "time", 0.0, 1e9, 0.0);
  out->reading.level = (int)number_of(input, "level", 0.0, 1e9, 0.0);
  const char *scale = text_of(input, "scale");
  for (int k = 0; scale && k < 4; ++k)
    if (strcmp(scale, scale_words[k]) == 0)
      out->reading.scale = (fg_scale)k;
  out->input = text_of(input, "path");
  out->input_absolute = text_of(input, "absolute");
}

int report_read(cli_report *out, const char *folder)
{
  memset(out, 0, sizeof *out);
  char *path = join_path(folder, REPORT_NAME);
  char *text = path ? read_text(path) : NULL;
  int code = EXIT_FAILED;
  if (!text)
    goto cleanup;
  out->tree = cJSON_Parse(text);
  fill_reading(out, cJSON_GetObjectItemCaseSensitive(out->tree, "input"));
  const cJSON *mesh = cJSON_GetObjectItemCaseSensitive(out->tree, "mesh");
  out->dimension = (int)number_of(mesh, "dimension", 2.0, 3.0, 2.0);
  const cJSON *scales = cJSON_GetObjectItemCaseSensitive(out->tree, "scales");
  out->scale_count = cJSON_GetArraySize(scales);
  const cJSON *range = cJSON_GetObjectItemCaseSensitive(out->tree, "speed_range");
  for (int k = 0; k < 2; ++k) {
    const cJSON *end = cJSON_GetArrayItem(range, k);
    out->speeds[k] = cJSON_IsNumber(end) ? end->valuedouble : 0.0;
  }
  if (!out->input || out->scale_count < 1)
    complain("%s: is not the report of a finished run (%s)", path,
             out->tree ? "it names no input or no scales" : "it is not JSON");
  else
    code = EXIT_DONE;
cleanup:
  free(text);
  free(path);
  return code;
}

int report_scale_clusters(const cli_report *report, int index)
{
  return (int)number_of(scale_at(report, index), "clusters", 0.0, 1e9, 0.0);
}

const char *report_scale_icons(const cli_report *report, int index)
{
  return text_of(scale_at(report, index), "geojson");
}

double report_scale_time(const cli_report *report, int index)
{
  return number_of(scale_at(report, index), "time", 0.0, 1e300, 0.0);
}

void report_clear(cli_report *report)
{
  cJSON_Delete(report->tree);
  memset(report, 0, sizeof *report);
}
