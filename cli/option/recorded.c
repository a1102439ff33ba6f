#include "option/recorded.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "option/table.h"
#include "report/json.h"

/* Options without influence on results: place of output, speed, duration; and files,
 * whose paths depend on the working directory: files_match compares those of a finished
 * run, a checkpoint what was read of them. */
static const char *const no_part[] = {
    "output",    "vars-from", "mesh-from",  "max-memory", "max-time",
    "max-steps", "threads",   "checkpoint", "resume",     "force",
    "quiet",     "verbose",   "help",       "version",
};

enum { VALUE_BYTES = 2048 };

static bool counts(const option_entry *option)
{
  if (!(option->commands & COMMAND_RUN))
    return false;
  for (size_t k = 0; k < sizeof no_part / sizeof no_part[0]; ++k)
    if (strcmp(no_part[k], option->name) == 0)
      return false;
  return true;
}

static void print_number(char *text, double value)
{
  snprintf(text, VALUE_BYTES, "%.15g", value);
  if (strtod(text, NULL) < value || strtod(text, NULL) > value)
    snprintf(text, VALUE_BYTES, "%.17g", value);
}

static void print_range(char *text, const void *place)
{
  double ends[2];
  memcpy(ends, place, sizeof ends);
  if (ends[1] > ends[0])
    snprintf(text, VALUE_BYTES, "%.17g,%.17g", ends[0], ends[1]);
}

static void print_numbers(char *text, const number_list *list)
{
  size_t used = 0;
  for (int k = 0; k < list->count && used < VALUE_BYTES; ++k)
    used += (size_t)snprintf(text + used, VALUE_BYTES - used, "%s%d", k ? "," : "",
                             list->number[k]);
}

static void print_times(char *text, const time_list *list)
{
  char number[VALUE_BYTES];
  size_t used = 0;
  for (int k = 0; k < list->count && used < VALUE_BYTES; ++k) {
    print_number(number, list->time[k]);
    used +=
        (size_t)snprintf(text + used, VALUE_BYTES - used, "%s%s", k ? "," : "", number);
  }
}

static void print_views(char *text, const picture_settings *settings)
{
  size_t used = 0;
  for (int k = 0; k < settings->view_count && used < VALUE_BYTES; ++k)
    used += (size_t)snprintf(text + used, VALUE_BYTES - used, "%s%.15g,%.15g",
                             k ? " " : "", settings->views[k][0], settings->views[k][1]);
}

static void print_formats(char *text, unsigned formats)
{
  size_t used = 0;
  for (int kind = 0; kind < FORMAT_KINDS; ++kind)
    if (formats & (1U << kind))
      used += (size_t)snprintf(text + used, VALUE_BYTES - used, "%s%s", used ? "," : "",
                               format_words[kind]);
}

static void print_center(char *text, const fg_map_options *map)
{
  if (map->has_center)
    snprintf(text, VALUE_BYTES, map->has_center_latitude ? "%.15g,%.15g" : "%.15g",
             map->center[0], map->center[1]);
}

static void print_region(char *text, const fg_map_options *map)
{
  const double *region = map->region;
  size_t used = 0;
  for (int k = 0; k < 4 + 2 * map->region_is_box && map->has_region; ++k)
    used += (size_t)snprintf(text + used, VALUE_BYTES - used, "%s%.15g", k ? "," : "",
                             region[k]);
}

/* Prints the value in the form of the command line; "" if not given. */
static void print_value(char text[VALUE_BYTES], const run_settings *settings,
                        const option_entry *option)
{
  const void *place = (const char *)settings + option_place(command_find("run"), option);
  text[0] = '\0';
  const char *words;
  double number;
  uint64_t seed;
  int whole;
  bool flag;
  switch (option->kind) {
  case OPTION_PLACES: /* the index, in whatever form it was given */
    whole = strcmp(option->name, "time") == 0 ? settings->reading.time
                                              : settings->reading.level;
    if (whole)
      snprintf(text, VALUE_BYTES, "%d", whole);
    break;
  case OPTION_WORDS: /* an empty text counts as given */
    memcpy(&words, place, sizeof words);
    snprintf(text, VALUE_BYTES, "%s", !words ? "" : *words ? words : "''");
    break;
  case OPTION_TEXT:
  case OPTION_PALETTE:
  case OPTION_COLOR:
    memcpy(&words, place, sizeof words);
    snprintf(text, VALUE_BYTES, "%s", words ? words : "");
    break;
  case OPTION_WHOLE:
    memcpy(&whole, place, sizeof whole);
    if (whole)
      snprintf(text, VALUE_BYTES, "%d", whole);
    break;
  case OPTION_SEED:
    memcpy(&seed, place, sizeof seed);
    if (seed)
      snprintf(text, VALUE_BYTES, "%" PRIu64, seed);
    break;
  case OPTION_RANGE:
    print_range(text, place);
    break;
  case OPTION_NUMBER:
  case OPTION_LENGTH:
    memcpy(&number, place, sizeof number);
    if (number > 0.0 || number < 0.0)
      print_number(text, number);
    break;
  case OPTION_FLAG:
    memcpy(&flag, place, sizeof flag);
    snprintf(text, VALUE_BYTES, "%s", flag ? "yes" : "");
    break;
  case OPTION_CHOICE:
    memcpy(&whole, place, sizeof whole);
    if (whole)
      snprintf(text, VALUE_BYTES, "%s", option->words[whole]);
    break;
  case OPTION_NUMBERS:
    print_numbers(text, place);
    break;
  case OPTION_TIMES:
    print_times(text, place);
    break;
  case OPTION_FORMATS:
    print_formats(text, settings->formats);
    break;
  case OPTION_CENTER:
    print_center(text, place);
    break;
  case OPTION_REGION:
    print_region(text, place);
    break;
  case OPTION_VIEW:
    print_views(text, &settings->picture);
    break;
  case OPTION_HELP:
  case OPTION_VERSION:
    break;
  }
}

cJSON *options_record(const run_settings *settings)
{
  cJSON *object = cJSON_CreateObject();
  const option_entry *option;
  for (size_t k = 0; object && (option = option_at(k)); ++k) {
    char text[VALUE_BYTES];
    if (!counts(option))
      continue;
    print_value(text, settings, option);
    if (*text)
      cJSON_AddStringToObject(object, option->name, text);
  }
  return object;
}

static void print_phrase(char text[VALUE_BYTES + 64], const option_entry *option,
                         const char *value)
{
  bool bare = !*value || option->kind == OPTION_FLAG;
  snprintf(text, VALUE_BYTES + 64, "%s --%s%s%s", *value ? "with" : "without",
           option->name, bare ? "" : " ", bare ? "" : value);
}

bool options_match(const cJSON *earlier, const run_settings *settings)
{
  const option_entry *option;
  for (size_t k = 0; (option = option_at(k)); ++k) {
    char now[VALUE_BYTES], one[VALUE_BYTES + 64], other[VALUE_BYTES + 64];
    if (!counts(option))
      continue;
    print_value(now, settings, option);
    const char *then =
        cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(earlier, option->name));
    if (!then)
      then = "";
    if (strcmp(then, now) == 0)
      continue;
    print_phrase(one, option, then);
    print_phrase(other, option, now);
    complain("%s: its run was begun %s; this command goes %s", settings->output, one,
             other);
    advise("Say the same options to go on, or start anew with --force.");
    return false;
  }
  return true;
}

static const struct {
  const char *name, *option;
  size_t place; /* of its path among reading_settings */
} further_files[] = {
    {"vars_from", "vars-from", offsetof(reading_settings, vars_from)},
    {"mesh_from", "mesh-from", offsetof(reading_settings, mesh_from)},
};
enum { FURTHER_FILES = sizeof further_files / sizeof *further_files };

static const char *further_path(const reading_settings *reading, int k)
{
  const char *path;
  memcpy(&path, (const char *)reading + further_files[k].place, sizeof path);
  return path;
}

/* The path from the root; NULL: there is no such file. For free(). */
static char *absolute_path(const char *path)
{
  return path && !input_is_standard(path) ? realpath(path, NULL) : NULL;
}

void files_record(cJSON *input, const reading_settings *reading)
{
  char *absolute = absolute_path(reading->input);
  json_add_text(input, "path", reading->input);
  json_add_text(input, "absolute", absolute);
  free(absolute);
  for (int k = 0; k < FURTHER_FILES; ++k) {
    const char *path = further_path(reading, k);
    absolute = absolute_path(path);
    json_add_text(input, further_files[k].name, absolute ? absolute : path);
    free(absolute);
  }
}

static const char *text_of(const cJSON *object, const char *name)
{
  return cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
}

/* The same file can have several paths; synth:NAME has none. */
static bool same_input(const cJSON *input, const char *operand)
{
  char *absolute = absolute_path(operand);
  const char *earlier = text_of(input, "absolute"), *name = text_of(input, "path");
  const bool same = absolute && earlier ? strcmp(absolute, earlier) == 0
                                        : name && strcmp(name, operand) == 0;
  free(absolute);
  return same;
}

/* Prints the difference of a further file. */
static bool same_further(const cJSON *input, const reading_settings *reading, int k,
                         const char *folder)
{
  const char *then = text_of(input, further_files[k].name);
  const char *path = further_path(reading, k);
  char *absolute = absolute_path(path);
  const char *now = absolute ? absolute : path;
  const bool same = then && now ? strcmp(then, now) == 0 : !then && !now;
  if (!same) {
    complain("%s: its run was begun %s --%s%s%s; this command goes %s --%s%s%s", folder,
             then ? "with" : "without", further_files[k].option, then ? " " : "",
             then ? then : "", now ? "with" : "without", further_files[k].option,
             now ? " " : "", now ? now : "");
    advise("Say the same options to go on, or start anew with --force.");
  }
  free(absolute);
  return same;
}

bool files_match(const cJSON *input, const reading_settings *reading, const char *folder)
{
  bool same = same_input(input, reading->input);
  if (!same) {
    const char *earlier = text_of(input, "path");
    complain("%s: holds the results of a run on %s", folder,
             earlier ? input_name(earlier) : "another input");
    advise("Choose another folder with -o, or replace its results with --force.");
  }
  for (int k = 0; k < FURTHER_FILES && same; ++k)
    same = same_further(input, reading, k, folder);
  return same;
}
