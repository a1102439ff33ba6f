#include "option/recorded.h"

#include <cjson/cJSON.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "option/table.h"

/* Options without influence on results: place of output, speed, duration; and files, as
 * paths depend on the working directory (their contents are compared). */
static const char *const no_part[] = {
    "output",    "vars-from", "mesh-from",  "max-memory", "max-time",
    "max-steps", "threads",   "checkpoint", "resume",     "force",
    "quiet",     "verbose",   "help",       "version",
};

enum { VALUE_BYTES = 1024 };

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
  if (map->has_region)
    snprintf(text, VALUE_BYTES, "%.15g,%.15g,%.15g,%.15g", region[0], region[1],
             region[2], region[3]);
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
