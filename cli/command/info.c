/* Prints the contents of a file, and what a run with the same options reads of it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "command/command.h"
#include "inputs.h"
#include "option/table.h"
#include "report/reading.h"
#include "series/places.h"

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

/* Grid, share of missing samples, scale and doubts. */
static void print_grid(const fg_inventory_vector *vector, const char *const *units)
{
  char text[CLEAN_BYTES];
  printf("  grid:");
  for (int k = 0; k < vector->dimension; ++k)
    printf("%s %d", k ? " x" : "", vector->size[k]);
  if (vector->cells > 0)
    printf(", interpolated from %zu cells", vector->cells);
  if (vector->points > 0)
    printf(", interpolated from %zu points", vector->points);
  putchar('\n');
  for (int k = 0; k < vector->dimension; ++k) {
    printf("  %s: %.6g to %.6g", clean_text(text, axis_of(vector, k)),
           vector->bounds[2 * k], vector->bounds[2 * k + 1]);
    printf("%s%s%s\n", units && *units[k] ? " " : "",
           units ? clean_text(text, units[k]) : "",
           vector->periodic[k] ? ", periodic" : "");
  }
  printf("  missing: %.1f %%\n", 100.0 * vector->missing_share);
  if (vector->normal_share > 0.0)
    printf("  normal to the plane: %.1f %% of the mean square\n",
           100.0 * vector->normal_share);
  printf("  scale: %s\n", scale_words[vector->scale]);
  for (const char *line = vector->doubts; line && *line;) {
    const int length = (int)strcspn(line, "\n");
    printf("  doubt: %.*s\n", length, line);
    line += length + (line[length] == '\n');
  }
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
  if (vector->chosen)
    printf("  chosen: %s\n", clean_text(text, vector->chosen));
  print_values("times", vector->time_value, vector->times, 0);
  print_values("levels", vector->level_value, vector->levels, vector->usual_level);
  if (vector->absent)
    printf("  its coordinates are not in the file: %s\n",
           clean_text(text, vector->absent));
  if (vector->frame)
    printf("  components: %s\n", clean_text(text, vector->frame));
  if (fg_map_auto(vector))
    printf("  map: %s\n", fg_map_auto(vector));
  if (vector->size[0] > 0)
    print_grid(vector, NULL);
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

/* What is printed: the vectors of the file, or the chosen one, and what a run reads. */
typedef struct listing {
  reading_settings reading;
  fg_context *context;
  const fg_inventory *inventory; /* of all, or of the chosen one */
  bool is_chosen;
  fg_inventory_vector chosen;
  fg_field *own; /* the chosen vector on its own grid, whose texts `chosen` has */
  chosen_places places;
  reading_facts facts; /* without a field: it is refused, as the last complaint says */
  fg_field *field;
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
  cJSON_AddStringToObject(root, "file", list->reading.input);
  cJSON_AddStringToObject(root, "format", fg_inventory_format(list->inventory));
  cJSON *array = cJSON_AddArrayToObject(root, "vectors");
  for (int k = 0; k < count_of(list); ++k)
    add_vector(array, vector_at(list, k));
  reading_report(root, &list->facts);
  if (!list->field) {
    json_add_text(root, "refused", last_complaint());
    json_add_text(root, "hint", *last_advice() ? last_advice() : NULL);
  }
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

/* Sets the grid from a field. */
static void take_grid(fg_inventory_vector *vector, const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  vector->dimension = a->dimension;
  for (int k = 0; k < a->dimension && k < 3; ++k) {
    vector->axis_name[k] = a->axis_name[k];
    vector->size[k] = a->size[k];
    vector->bounds[2 * k] = fg_field_measured(field, k, a->axis[k][0]);
    vector->bounds[2 * k + 1] = fg_field_measured(field, k, a->axis[k][a->size[k] - 1]);
    vector->periodic[k] = a->period[k] > 0.0;
  }
  vector->missing_share = fg_field_missing_share(field);
  vector->scale = a->scale;
  vector->normal_share = fg_field_normal_share(field);
  vector->doubts = a->doubts;
}

static void print_place(const char *what, const fg_selection *selected, int count,
                        const char *words)
{
  char text[CLEAN_BYTES];
  if (!words && count < 2)
    return;
  printf("  %s: %s", what, clean_text(text, words ? words : ""));
  if (count > 1)
    printf("%s(%d of 0 to %d)", words ? " " : "", selected->index[0], count - 1);
  if (selected->count > 1)
    printf(", the first of %d", selected->count);
  putchar('\n');
}

static void print_reading(const listing *list)
{
  char text[CLEAN_BYTES];
  if (!list->field) {
    printf("run refuses: %s\n", last_complaint());
    if (*last_advice())
      printf("  %s\n", last_advice());
    return;
  }
  const fg_field_arrays *field = fg_field_contents(list->field);
  fg_inventory_vector as_read = {.dimension = 0};
  printf("run reads: ");
  for (int k = 0; k < field->dimension; ++k)
    printf("%s%s", k ? "," : "", clean_text(text, field->velocity_name[k]));
  putchar('\n');
  print_place("time", &list->places.time, list->facts.times, field->time);
  print_place("level", &list->places.level, list->facts.levels, field->level);
  if (field->projection)
    printf("  projection: %s\n", clean_text(text, field->projection));
  if (list->reading.map.has_region && field->projection)
    printf("  region: %g to %g east, %g to %g north\n", list->reading.map.region[0],
           list->reading.map.region[1], list->reading.map.region[2],
           list->reading.map.region[3]);
  take_grid(&as_read, list->field);
  char text_of[3][CLEAN_BYTES] = {{0}};
  const char *const units[3] = {text_of[0], text_of[1], text_of[2]};
  for (int k = 0; k < field->dimension; ++k)
    fg_field_measured_units(text_of[k], sizeof text_of[k], list->field, k);
  print_grid(&as_read, units);
}

static void print_text(const listing *list)
{
  printf("file: %s\nformat: %s\n", list->reading.input,
         fg_inventory_format(list->inventory));
  for (int k = 0; k < count_of(list); ++k)
    print_vector(vector_at(list, k));
  print_reading(list);
}

static bool chooses(const reading_settings *reading)
{
  const char *const texts[] = {
      reading->vars,      reading->vars_from,  reading->mesh_from,     reading->mask,
      reading->missing,   reading->at,         reading->slice,         reading->block,
      reading->time_text, reading->level_text, reading->map.projection};
  bool any = reading->scale || reading->frame || reading->map.has_center ||
             reading->map.has_region;
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n)
    any = any || texts[n];
  return any;
}

/* Reads what a run with these options reads. Returns its exit code. */
static int read_as_run(listing *list)
{
  keep_complaints(true);
  int code = places_find(&list->places, &list->reading, true);
  if (!code) {
    list->reading.time = list->places.time.index[0];
    list->reading.level = list->places.level.index[0];
    code = places_field(&list->field, list->context, &list->places, &list->reading);
  }
  keep_complaints(false);
  fg_context_clear(list->context);
  list->facts = (reading_facts){.settings = &list->reading, .field = list->field};
  reading_find(&list->facts, list->places.input);
  return code;
}

/* Sets the chosen vector's own grid, which is the run's unless it is laid on a map. */
static void find_own_grid(listing *list)
{
  fg_read_options options = settings_reading(&list->reading);
  const fg_field *field = list->field;
  list->chosen = *fg_inventory_vector_at(list->inventory, 0);
  options.map = NULL;
  if (field && (fg_field_contents(field)->projection || list->reading.map.has_region) &&
      !fg_field_read(&list->own, list->context, list->reading.input, &options))
    field = list->own;
  if (field)
    take_grid(&list->chosen, field);
}

static fg_status find_vectors(listing *list)
{
  const bool all = !chooses(&list->reading);
  if (!list->places.input)
    return FG_STATUS_OK; /* the run's complaint says why */
  const fg_status status = (all ? fg_input_vectors : fg_input_inventory)(
      &list->inventory, list->context, list->places.input);
  list->is_chosen = !all && !status && fg_inventory_vector_count(list->inventory) > 0;
  if (list->is_chosen)
    find_own_grid(list);
  return status;
}

int command_info(const void *given)
{
  const info_settings *settings = given;
  listing list = {.reading = settings->reading};
  if (create_context(&list.context))
    return EXIT_FAILED;
  int code = read_as_run(&list);
  const fg_status status = find_vectors(&list);
  const bool listed = !status && list.inventory;
  if (status && !code)
    code = complain_of(list.context, status, list.reading.input);
  else if (code && (!listed || list.is_chosen || count_of(&list) == 0))
    repeat_complaint();
  else
    code = EXIT_DONE;
  if (listed && settings->json)
    code = print_json(&list) ? EXIT_FAILED : code;
  else if (listed)
    print_text(&list);
  fg_field_destroy(list.field);
  fg_field_destroy(list.own);
  places_clear(&list.places);
  fg_context_destroy(list.context);
  return code;
}
