#include "folder/made.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "folder/file.h"
#include "report/past_run.h"

typedef struct search {
  const cJSON *report; /* NULL: of no run */
  char *found;
} search;

static bool scale_names(const cJSON *scale, const char *name)
{
  const cJSON *item;
  cJSON_ArrayForEach(item, scale)
  {
    const char *text = cJSON_GetStringValue(item);
    if (text && strcmp(text, name) == 0)
      return true;
  }
  return false;
}

static bool run_made(const cJSON *report, const char *name)
{
  if (!report)
    return false;
  if (strcmp(name, REPORT_NAME) == 0 || strcmp(name, TABLE_NAME) == 0)
    return true;
  const cJSON *scale;
  cJSON_ArrayForEach(scale, cJSON_GetObjectItemCaseSensitive(report, "scales"))
  {
    if (scale_names(scale, name))
      return true;
  }
  return false;
}

static int keep_foreign(const char *folder, const char *name, const void *data)
{
  (void)folder;
  const search *s = data;
  if (!run_made(s->report, name))
    snprintf(s->found, SCALE_NAME_BYTES, "%s", name);
  return EXIT_DONE;
}

/* The report of a run of this program; NULL: there is none. */
static cJSON *read_report(const char *folder)
{
  char *path = join_path(folder, REPORT_NAME);
  char *text = path && is_plain_file(path) ? read_text(path) : NULL;
  cJSON *tree = text ? cJSON_Parse(text) : NULL;
  const cJSON *program = cJSON_GetObjectItemCaseSensitive(tree, "program");
  if (!cJSON_IsString(program) || strcmp(program->valuestring, "flowgrain") != 0) {
    cJSON_Delete(tree);
    tree = NULL;
  }
  free(text);
  free(path);
  return tree;
}

int made_find_foreign(char name[SCALE_NAME_BYTES], const char *folder)
{
  name[0] = '\0';
  cJSON *report = read_report(folder);
  const search s = {report, name};
  int code = for_names(folder, is_result, keep_foreign, &s);
  cJSON_Delete(report);
  return code;
}

int made_complain(const char *folder, const char *name)
{
  complain("%s: holds %s, which no run of flowgrain is known to have made", folder, name);
  advise("Choose another folder with -o, or move the file away.");
  return EXIT_FAILED;
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
