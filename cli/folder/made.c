#include "folder/made.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder/file.h"
#include "report/json.h"
#include "report/past_run.h"

enum { REPORTS = 3 };

typedef struct made_files {
  cJSON *report[REPORTS]; /* NULL: there is none */
  char *foreign;
} made_files;

static bool names(const cJSON *list, const char *name)
{
  const cJSON *item;
  cJSON_ArrayForEach(item, list)
  {
    const char *text = cJSON_GetStringValue(item);
    if (text && strcmp(text, name) == 0)
      return true;
  }
  return false;
}

static bool report_names(const cJSON *report, const char *name)
{
  if (strcmp(name, REPORT_NAME) == 0 || strcmp(name, TABLE_NAME) == 0)
    return report != NULL;
  const char *page =
      cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(report, "page"));
  if (page && strcmp(name, page) == 0)
    return true;
  const cJSON *scale;
  cJSON_ArrayForEach(scale, cJSON_GetObjectItemCaseSensitive(report, "scales"))
  {
    if (names(scale, name))
      return true;
  }
  return names(cJSON_GetObjectItemCaseSensitive(report, "drawn"), name);
}

static bool are_made(const made_files *made, const char *name)
{
  for (int k = 0; k < REPORTS; ++k)
    if (report_names(made->report[k], name))
      return true;
  return false;
}

/* The report of a run of this program; NULL: there is none. */
static cJSON *read_report(const char *folder, const char *file)
{
  char *path = folder ? join_path(folder, file) : NULL;
  char *text = path && is_plain_file(path) ? read_text(path) : NULL;
  cJSON *tree = json_parse(text);
  const cJSON *program = cJSON_GetObjectItemCaseSensitive(tree, "program");
  if (!cJSON_IsString(program) || strcmp(program->valuestring, "flowgrain") != 0) {
    cJSON_Delete(tree);
    tree = NULL;
  }
  free(text);
  free(path);
  return tree;
}

static made_files read_reports(const char *folder, const char *work)
{
  return (made_files){.report = {read_report(folder, REPORT_NAME),
                                 read_report(work, REPORT_NAME),
                                 read_report(work, REPLACED_NAME)}};
}

static void clear_reports(made_files *made)
{
  for (int k = 0; k < REPORTS; ++k)
    cJSON_Delete(made->report[k]);
}

static int keep_foreign(const char *folder, const char *name, const void *data)
{
  (void)folder;
  const made_files *made = data;
  if (!are_made(made, name))
    snprintf(made->foreign, SCALE_NAME_BYTES, "%s", name);
  return EXIT_DONE;
}

int made_find_foreign(char name[SCALE_NAME_BYTES], const char *folder, const char *work)
{
  name[0] = '\0';
  made_files made = read_reports(folder, work);
  made.foreign = name;
  int code = for_names(folder, is_result, keep_foreign, &made);
  clear_reports(&made);
  return code;
}

int made_complain(const char *folder, const char *name)
{
  complain("%s: holds %s, which no run of flowgrain is known to have made", folder, name);
  advise("Choose another folder with -o, or move the file away.");
  return EXIT_FAILED;
}

static bool is_result_or_partial(const char *name)
{
  return is_result(name) || is_partial(name);
}

static int remove_made(const char *folder, const char *name, const void *data)
{
  return is_partial(name) || are_made(data, name) ? remove_file(folder, name) : EXIT_DONE;
}

int made_remove(const char *folder, const char *work)
{
  made_files made = read_reports(folder, work);
  int code = for_names(folder, is_result_or_partial, remove_made, &made);
  clear_reports(&made);
  return code;
}

typedef struct input_list {
  const char *const *inputs;
  int count;
} input_list;

static int refuse_input(const char *folder, const char *name, const void *data)
{
  const input_list *list = data;
  char *path = join_path(folder, name);
  int code = path ? check_is_no_input(path, list->inputs, list->count) : EXIT_FAILED;
  free(path);
  return code;
}

int made_check_inputs(const char *folder, const char *const *inputs, int count)
{
  const input_list list = {inputs, count};
  return for_names(folder, is_result, refuse_input, &list);
}

static int write_report(const char *folder, const cJSON *report)
{
  char *path = join_path(folder, REPORT_NAME), *text = json_print(report);
  int code = path && text ? write_text_file(path, text) : EXIT_FAILED;
  cJSON_free(text);
  free(path);
  return code;
}

int made_record(const char *path)
{
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  char *folder = join_texts(path, "");
  if (!folder)
    return complain_of_memory("a file's name");
  cut_to_parent(folder);
  int code = EXIT_DONE;
  cJSON *report = is_result(name) ? read_report(folder, REPORT_NAME) : NULL;
  if (report && !report_names(report, name)) {
    cJSON *drawn = cJSON_GetObjectItemCaseSensitive(report, "drawn");
    if (!drawn)
      drawn = cJSON_AddArrayToObject(report, "drawn");
    cJSON_AddItemToArray(drawn, cJSON_CreateString(name));
    code = write_report(folder, report);
  }
  cJSON_Delete(report);
  free(folder);
  return code;
}

int publish_file(char *partial, const char *path, int code)
{
  return replace_file(partial, path, code ? code : made_record(path));
}
