/* Prints the contents of a file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command/command.h"
#include "inputs.h"
#include "option/table.h"
#include "report/json.h"

static int name_count(const fg_inventory_vector *vector)
{
  int count = 0;
  while (count < 3 && vector->name[count])
    ++count;
  return count;
}

/* Prints all values, or the first and last few. */
static void print_values(const char *what, const fg_axis_value *values, int count,
                         int default_index)
{
  enum { MOST = 12, FIRST = 8, LAST = 2 };
  char text[CLEAN_BYTES];
  printf("  %s: %d\n", what, count);
  for (int n = 0; n < count && values && count > 0; ++n) {
    printf("    %d: %s%s\n", n, clean_text(text, values[n].words),
           default_index > 0 && n == default_index ? " (read unless --level says another)"
                                                   : "");
    if (count > MOST && n == FIRST - 1) {
      puts("    ...");
      n = count - LAST - 1;
    }
  }
}

static const char *axis_of(const fg_inventory_vector *vector, int k)
{
  static const char *const standard[] = {"x", "y", "z"};
  return vector->axis_name[k] ? vector->axis_name[k] : standard[k];
}

static void print_vector(const fg_inventory_vector *vector)
{
  char text[CLEAN_BYTES];
  printf("vectors: ");
  for (int k = 0; k < name_count(vector); ++k)
    printf("%s%s", k ? "," : "", clean_text(text, vector->name[k]));
  printf("\n  found by: %s\n", clean_text(text, vector->found_by));
  if (*vector->units)
    printf("  units: %s\n", clean_text(text, vector->units));
  if (vector->unusable) { /* without a known grid */
    printf("  cannot be read: %s\n", clean_text(text, vector->unusable));
    return;
  }
  printf("  grid:");
  for (int k = 0; k < vector->dimension; ++k)
    printf("%s %d", k ? " x" : "", vector->size[k]);
  if (vector->cells > 0)
    printf(", interpolated from %zu cells", vector->cells);
  if (vector->points > 0)
    printf(", interpolated from %zu points", vector->points);
  putchar('\n');
  for (int k = 0; k < vector->dimension; ++k)
    printf("  %s: %.6g to %.6g%s\n", axis_of(vector, k), vector->bounds[2 * k],
           vector->bounds[2 * k + 1], vector->periodic[k] ? ", periodic" : "");
  if (vector->chosen)
    printf("  chosen: %s\n", clean_text(text, vector->chosen));
  print_values("times", vector->time_value, vector->times, 0);
  print_values("levels", vector->level_value, vector->levels, vector->usual_level);
  printf("  missing: %.1f %%\n", 100.0 * vector->missing_share);
  if (vector->normal_share > 0.0)
    printf("  normal to the plane: %.1f %% of the mean square\n",
           100.0 * vector->normal_share);
  printf("  scale: %s\n", scale_words[vector->scale]);
  if (vector->absent)
    printf("  its coordinates are not in the file: %s\n",
           clean_text(text, vector->absent));
  if (vector->frame)
    printf("  components: %s\n", clean_text(text, vector->frame));
  if (fg_map_auto(vector))
    printf("  map: %s\n", fg_map_auto(vector));
  for (const char *line = vector->doubts; line && *line;) {
    const int length = (int)strcspn(line, "\n");
    printf("  doubt: %.*s\n", length, line);
    line += length + (line[length] == '\n');
  }
}

static void add_values(cJSON *object, const char *name, const fg_axis_value *values,
                       int count)
{
  cJSON *array = values ? cJSON_AddArrayToObject(object, name) : NULL;
  for (int n = 0; n < count && array; ++n) {
    cJSON *one = cJSON_CreateObject();
    if (isfinite(values[n].value))
      cJSON_AddNumberToObject(one, "value", values[n].value);
    cJSON_AddStringToObject(one, "units", values[n].units);
    cJSON_AddStringToObject(one, "words", values[n].words);
    cJSON_AddItemToArray(array, one);
  }
}

static void add_vector(cJSON *array, const fg_inventory_vector *vector)
{
  cJSON *object = cJSON_CreateObject();
  cJSON *names = cJSON_AddArrayToObject(object, "vars");
  for (int k = 0; k < name_count(vector); ++k)
    cJSON_AddItemToArray(names, cJSON_CreateString(vector->name[k]));
  cJSON_AddNumberToObject(object, "components", vector->components);
  cJSON_AddStringToObject(object, "units", vector->units);
  cJSON_AddStringToObject(object, "found_by", vector->found_by);
  cJSON_AddItemToArray(array, object);
  if (vector->unusable) { /* without a known grid */
    cJSON_AddStringToObject(object, "unusable", vector->unusable);
    return;
  }
  cJSON_AddItemToObject(object, "size",
                        cJSON_CreateIntArray(vector->size, vector->dimension));
  if (vector->cells > 0)
    cJSON_AddNumberToObject(object, "cells", (double)vector->cells);
  if (vector->points > 0)
    cJSON_AddNumberToObject(object, "points", (double)vector->points);
  cJSON_AddItemToObject(object, "bounds",
                        cJSON_CreateDoubleArray(vector->bounds, 2 * vector->dimension));
  cJSON_AddBoolToObject(object, "periodic",
                        vector->periodic[0] || vector->periodic[1] ||
                            vector->periodic[2]);
  cJSON *axes = cJSON_AddArrayToObject(object, "periodic_axes");
  for (int k = 0; k < vector->dimension; ++k)
    cJSON_AddItemToArray(axes, cJSON_CreateBool(vector->periodic[k]));
  cJSON_AddNumberToObject(object, "times", vector->times);
  cJSON_AddNumberToObject(object, "levels", vector->levels);
  add_values(object, "time_values", vector->time_value, vector->times);
  add_values(object, "level_values", vector->level_value, vector->levels);
  cJSON_AddNumberToObject(object, "missing_share", vector->missing_share);
  if (vector->normal_share > 0.0)
    cJSON_AddNumberToObject(object, "normal_share", vector->normal_share);
  cJSON_AddStringToObject(object, "scale", scale_words[vector->scale]);
  if (vector->levels > 1)
    cJSON_AddNumberToObject(object, "usual_level", vector->usual_level);
  if (vector->absent)
    cJSON_AddStringToObject(object, "absent", vector->absent);
  if (vector->chosen)
    cJSON_AddStringToObject(object, "chosen", vector->chosen);
  cJSON *names_of_axes = cJSON_AddArrayToObject(object, "axes");
  for (int k = 0; k < vector->dimension; ++k)
    cJSON_AddItemToArray(names_of_axes, cJSON_CreateString(axis_of(vector, k)));
  if (vector->frame)
    cJSON_AddStringToObject(object, "frame", vector->frame);
  if (vector->doubts)
    cJSON_AddStringToObject(object, "doubts", vector->doubts);
  if (fg_map_auto(vector))
    cJSON_AddStringToObject(object, "map", fg_map_auto(vector));
}

/* The inventory to print: of the whole file, or of the chosen vector. */
typedef struct listing {
  const char *file;
  const fg_inventory *inventory; /* the input's, or `all` */
  fg_inventory *all;
  fg_input *input;
  bool is_chosen;
  fg_inventory_vector chosen;
  fg_field *field; /* the chosen vector as read, whose texts `chosen` has */
  int looks;       /* times that were read for one with values */
} listing;

static int count_of(const listing *list)
{
  return list->is_chosen ? 1 : fg_inventory_vector_count(list->inventory);
}

static const fg_inventory_vector *vector_at(const listing *list, int k)
{
  return list->is_chosen ? &list->chosen : fg_inventory_vector_at(list->inventory, k);
}

static int print_json(const listing *list)
{
  cJSON *root = cJSON_CreateObject();
  cJSON_AddStringToObject(root, "file", list->file);
  cJSON_AddStringToObject(root, "format", fg_inventory_format(list->inventory));
  cJSON *array = cJSON_AddArrayToObject(root, "vectors");
  for (int k = 0; k < count_of(list); ++k)
    add_vector(array, vector_at(list, k));
  char *text = json_print(root);
  if (text)
    puts(text);
  else
    complain("out of memory for the JSON text");
  int code = text ? EXIT_DONE : EXIT_FAILED;
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}

static void print_text(const listing *list)
{
  printf("file: %s\nformat: %s\n", list->file, fg_inventory_format(list->inventory));
  for (int k = 0; k < count_of(list); ++k)
    print_vector(vector_at(list, k));
}

/* Sets the grid from the field as read. */
static void take_grid(fg_inventory_vector *vector, const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t samples = 1, missing = 0;
  const bool is_cut = a->dimension < vector->dimension;
  vector->dimension = a->dimension;
  for (int k = 0; k < a->dimension && k < 3; ++k) {
    if (is_cut)
      vector->axis_name[k] = a->axis_name[k];
    vector->size[k] = a->size[k];
    vector->bounds[2 * k] = a->axis[k][0];
    vector->bounds[2 * k + 1] = a->axis[k][a->size[k] - 1];
    vector->periodic[k] = a->period[k] > 0.0;
    samples *= (size_t)a->size[k];
  }
  for (size_t n = 0; n < samples; ++n) {
    bool valid = !a->valid || a->valid[n];
    for (int k = 0; k < a->dimension && k < 3; ++k)
      valid = valid && isfinite(a->velocity[k][n]);
    missing += !valid;
  }
  vector->missing_share = (double)missing / (double)samples;
  vector->scale = a->scale;
  vector->normal_share = fg_field_normal_share(field);
  vector->doubts = a->doubts;
}

static bool chooses(const reading_settings *reading)
{
  return reading->vars || reading->vars_from || reading->mesh_from || reading->at ||
         reading->block || reading->slice || reading->frame || reading->scale ||
         reading->missing;
}

/* So many times are looked at for one that has values. */
enum { MOST_LOOKS = 32 };

/* The time of a look, number 1 to looks - 1: the last one first, then evenly. */
static int time_of_look(int look, int looks, int times)
{
  const int even = look == 1 ? looks - 1 : look - 1;
  return (int)((int64_t)even * (times - 1) / (looks - 1));
}

/* Reads the chosen vector at the first time that has values; *looks: of so many that are
 * looked at. */
static fg_status read_any(fg_field **out, int *looks, fg_context *context,
                          fg_input *input, int times)
{
  fg_status status = fg_input_field(out, context, input, 0, 0, 0, 1);
  *looks = status != FG_STATUS_FILE_FORMAT ? 1 : times < MOST_LOOKS ? times : MOST_LOOKS;
  for (int look = 1; look < *looks && status == FG_STATUS_FILE_FORMAT; ++look) {
    fg_context_clear(context);
    status =
        fg_input_field(out, context, input, time_of_look(look, *looks, times), 0, 0, 1);
  }
  return status;
}

/* Lists the vector that the options choose with its grid as read at a time that has
 * values (models start from rest, observations have gaps). */
static fg_status list_chosen(listing *list, fg_context *context,
                             const fg_read_options *options)
{
  fg_status status = fg_input_open(&list->input, context, list->file, options);
  if (!status)
    status = fg_input_inventory(&list->inventory, context, list->input);
  list->is_chosen = !status && fg_inventory_vector_count(list->inventory) > 0;
  if (!list->is_chosen)
    return status;
  list->chosen = *fg_inventory_vector_at(list->inventory, 0);
  status = read_any(&list->field, &list->looks, context, list->input, list->chosen.times);
  if (!status)
    take_grid(&list->chosen, list->field);
  return status;
}

/* Prints the error of reading, which names the contents of the file. */
static int complain_of_none(fg_context *context, const listing *list,
                            const fg_read_options *options)
{
  fg_field *field = NULL;
  const fg_status status = fg_field_read(&field, context, list->file, options);
  fg_field_destroy(field);
  if (status)
    return complain_of(context, status, list->file);
  complain("%s: holds no vector field", list->file);
  advise("`flowgrain run --vars U,V` takes variables by any names.");
  return EXIT_FAILED;
}

/* Says of how many times the error is. */
static int complain_of_chosen(fg_context *context, fg_status status, const listing *list)
{
  const int code = complain_of(context, status, list->file);
  if (status == FG_STATUS_FILE_FORMAT && list->looks > 1)
    advise(list->looks < list->chosen.times
               ? "The same holds for %d of its %d times; the others were not looked at."
               : "The same holds for all of its %d times.",
           list->looks, list->chosen.times);
  return code;
}

int command_info(const void *given)
{
  const info_settings *settings = given;
  fg_read_options options = settings_reading(&settings->reading);
  listing list = {.file = settings->reading.input};
  fg_context *context;
  options.map = NULL;
  const bool chosen = chooses(&settings->reading);
  if (create_context(&context))
    return EXIT_FAILED;
  int code = EXIT_DONE;
  fg_status status = chosen ? list_chosen(&list, context, &options)
                            : fg_inventory_read(&list.all, context, list.file);
  if (!chosen)
    list.inventory = list.all;
  if (status)
    code = complain_of_chosen(context, status, &list);
  else if (settings->json)
    code = print_json(&list);
  else
    print_text(&list);
  if (!status && count_of(&list) == 0)
    code = complain_of_none(context, &list, &options);
  fg_field_destroy(list.field);
  fg_inventory_destroy(list.all);
  fg_input_close(list.input);
  fg_context_destroy(context);
  return code;
}
