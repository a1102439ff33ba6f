#include "report/series_index.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "folder/file.h"
#include "folder/files.h"
#include "option/recorded.h"
#include "option/table.h"
#include "report/json.h"
#include "report/past_run.h"

bool series_is_there(const char *folder)
{
  return file_is_there(folder, SERIES_NAME);
}

void panels_name(char out[PANELS_NAME_BYTES], int scale, const char *format)
{
  snprintf(out, PANELS_NAME_BYTES, "panels-%02d.%s", scale % 100, format);
}

static void add_place(cJSON *object, const char *name, const char *words_name, int index,
                      const char *words)
{
  cJSON_AddNumberToObject(object, name, index);
  if (words)
    cJSON_AddStringToObject(object, words_name, words);
}

static void add_members(cJSON *root, const series_index *index)
{
  cJSON *members = cJSON_AddArrayToObject(root, "members");
  for (int n = 0; n < index->count; ++n) {
    const series_member *member = &index->member[n];
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "folder", member->name);
    add_place(object, "time", "time_words", member->time, member->time_words);
    add_place(object, "level", "level_words", member->level, member->level_words);
    cJSON_AddItemToArray(members, object);
  }
}

static void add_panels(cJSON *root, const series_index *index)
{
  cJSON *panels = index->panel_scales ? cJSON_AddArrayToObject(root, "panels") : NULL;
  for (int scale = 0; scale < index->panel_scales; ++scale)
    for (int kind = 0; kind < FORMAT_KINDS; ++kind) {
      char name[PANELS_NAME_BYTES];
      panels_name(name, scale, format_words[kind]);
      if (index->panel_formats & (1U << kind))
        cJSON_AddItemToArray(panels, cJSON_CreateString(name));
    }
}

static cJSON *describe(const series_index *index)
{
  const run_settings *settings = index->settings;
  cJSON *root = cJSON_CreateObject();
  cJSON_AddStringToObject(root, "program", "flowgrain");
  cJSON_AddStringToObject(root, "version", fg_version());
  cJSON *input = cJSON_AddObjectToObject(root, "input");
  files_record(input, &settings->reading);
  cJSON_AddItemToObject(root, "options", options_record(settings));
  cJSON *range = cJSON_AddArrayToObject(root, "speed_range");
  for (int k = 0; k < 2; ++k) {
    char text[32]; /* cJSON may write only 15 digits of a number */
    snprintf(text, sizeof text, "%.17g", index->speeds[k]);
    cJSON_AddItemToArray(range, cJSON_CreateRaw(text));
  }
  add_members(root, index);
  add_panels(root, index);
  return root;
}

int index_write(const series_index *index)
{
  cJSON *root = describe(index);
  char *text = json_print(root), *path = join_path(index->settings->output, SERIES_NAME);
  int code = text && path ? write_text_file(path, text) : complain_of_memory(SERIES_NAME);
  free(path);
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}

/* NULL: missing, or an error was printed. */
static cJSON *read_index(const char *folder)
{
  char *path = join_path(folder, SERIES_NAME);
  char *text = path ? read_text(path) : NULL;
  cJSON *root = json_parse(text);
  const char *program =
      cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "program"));
  if (text && (!program || strcmp(program, "flowgrain") != 0)) {
    complain("%s: is not the index of a series of runs", path);
    cJSON_Delete(root);
    root = NULL;
  }
  free(text);
  free(path);
  return root;
}

static bool take_speeds(double speeds[2], const cJSON *root)
{
  const cJSON *range = cJSON_GetObjectItemCaseSensitive(root, "speed_range");
  for (int k = 0; k < 2; ++k)
    speeds[k] = cJSON_GetNumberValue(cJSON_GetArrayItem(range, k));
  return speeds[1] > speeds[0];
}

int index_read_speeds(double speeds[2], const char *folder)
{
  cJSON *root = read_index(folder);
  bool taken = root && take_speeds(speeds, root);
  cJSON_Delete(root);
  if (root && !taken)
    complain("%s: its %s has no colour range", folder, SERIES_NAME);
  return taken ? EXIT_DONE : EXIT_FAILED;
}

static const char *name_at(const cJSON *root, int n)
{
  const cJSON *members = cJSON_GetObjectItemCaseSensitive(root, "members");
  return cJSON_GetStringValue(
      cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(members, n), "folder"));
}

static bool has_members(const series_index *index, const cJSON *root)
{
  const cJSON *members = cJSON_GetObjectItemCaseSensitive(root, "members");
  bool same = cJSON_GetArraySize(members) == index->count;
  for (int n = 0; n < index->count && same; ++n) {
    const char *name = name_at(root, n);
    same = name && strcmp(name, index->member[n].name) == 0;
  }
  if (!same) {
    complain("%s: holds a series of other times or levels", index->settings->output);
    advise("Say the same to go on, or start anew with --force.");
  }
  return same;
}

bool index_matches(series_index *index)
{
  const run_settings *settings = index->settings;
  cJSON *root = read_index(settings->output);
  const cJSON *options = cJSON_GetObjectItemCaseSensitive(root, "options");
  bool same = root &&
              files_match(cJSON_GetObjectItemCaseSensitive(root, "input"),
                          &settings->reading, settings->output) &&
              options_match(options, settings) && has_members(index, root) &&
              take_speeds(index->speeds, root);
  cJSON_Delete(root);
  return same;
}

/* "time-0001", "level-012", or both; no path to another folder. */
static bool is_member_name(const char *name)
{
  return (strncmp(name, "time-", 5) == 0 || strncmp(name, "level-", 6) == 0) &&
         strlen(name) < MEMBER_NAME_BYTES &&
         strspn(name, "time-lv0123456789") == strlen(name);
}

int index_names(char (**names)[MEMBER_NAME_BYTES], int *count, const char *folder)
{
  *names = NULL;
  *count = 0;
  if (!series_is_there(folder))
    return EXIT_DONE;
  cJSON *root = read_index(folder);
  const int all = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(root, "members"));
  if (root)
    *names = calloc((size_t)all + 1, sizeof **names);
  for (int n = 0; n < all && *names; ++n) {
    const char *name = name_at(root, n);
    if (name && is_member_name(name))
      snprintf((*names)[(*count)++], MEMBER_NAME_BYTES, "%s", name);
  }
  int code = !root ? EXIT_FAILED : *names ? EXIT_DONE : complain_of_memory("names");
  cJSON_Delete(root);
  return code;
}

bool index_has_panels(const char *folder, const char *name)
{
  cJSON *root = series_is_there(folder) ? read_index(folder) : NULL;
  const cJSON *panels = cJSON_GetObjectItemCaseSensitive(root, "panels");
  bool found = false;
  for (int n = 0; n < cJSON_GetArraySize(panels) && !found; ++n) {
    const char *its = cJSON_GetStringValue(cJSON_GetArrayItem(panels, n));
    found = its && strcmp(its, name) == 0;
  }
  cJSON_Delete(root);
  return found;
}
