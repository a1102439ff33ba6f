/* Says what a file holds. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "command/command.h"
#include "option/table.h"
#include "sandbox.h"

static int name_count(const fg_inventory_vector *vector)
{
  int count = 0;
  while (count < 3 && vector->name[count])
    ++count;
  return count;
}

/* All of them, or the first and last few. */
static void print_values(const char *what, const fg_axis_value *values, int count)
{
  enum { MOST = 12, FIRST = 8, LAST = 2 };
  char room[CLEAN_BYTES];
  printf("  %s: %d\n", what, count);
  for (int n = 0; n < count && values && count > 0; ++n) {
    printf("    %d: %s\n", n, clean_text(room, values[n].words));
    if (count > MOST && n == FIRST - 1) {
      puts("    ...");
      n = count - LAST - 1;
    }
  }
}

static void print_vector(const fg_inventory_vector *vector)
{
  static const char axis[] = "xyz";
  char room[CLEAN_BYTES];
  printf("vectors: ");
  for (int k = 0; k < name_count(vector); ++k)
    printf("%s%s", k ? "," : "", clean_text(room, vector->name[k]));
  printf("\n  found by: %s\n", clean_text(room, vector->found_by));
  if (*vector->units)
    printf("  units: %s\n", clean_text(room, vector->units));
  if (vector->unusable) { /* its grid is not known */
    printf("  cannot be read: %s\n", clean_text(room, vector->unusable));
    return;
  }
  printf("  grid:");
  for (int k = 0; k < vector->dimension; ++k)
    printf("%s %d", k ? " x" : "", vector->size[k]);
  if (vector->cells > 0)
    printf(", interpolated from %zu cells", vector->cells);
  putchar('\n');
  for (int k = 0; k < vector->dimension; ++k)
    printf("  %c: %.6g to %.6g%s\n", axis[k], vector->bounds[2 * k],
           vector->bounds[2 * k + 1], vector->periodic[k] ? ", periodic" : "");
  print_values("times", vector->time_value, vector->times);
  print_values("levels", vector->level_value, vector->levels);
  printf("  missing: %.1f %%\n", 100.0 * vector->missing_share);
  if (vector->normal_share > 0.0)
    printf("  normal to the plane: %.1f %% of the mean square\n",
           100.0 * vector->normal_share);
  printf("  scale: %s\n", scale_words[vector->scale]);
  if (vector->frame)
    printf("  components: %s\n", clean_text(room, vector->frame));
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
  if (vector->unusable) { /* its grid is not known */
    cJSON_AddStringToObject(object, "unusable", vector->unusable);
    return;
  }
  cJSON_AddItemToObject(object, "size",
                        cJSON_CreateIntArray(vector->size, vector->dimension));
  if (vector->cells > 0)
    cJSON_AddNumberToObject(object, "cells", (double)vector->cells);
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
  if (vector->frame)
    cJSON_AddStringToObject(object, "frame", vector->frame);
}

static int print_json(const char *file, const fg_inventory *inventory)
{
  cJSON *root = cJSON_CreateObject();
  cJSON_AddStringToObject(root, "file", file);
  cJSON_AddStringToObject(root, "format", fg_inventory_format(inventory));
  cJSON *array = cJSON_AddArrayToObject(root, "vectors");
  for (int k = 0; k < fg_inventory_vector_count(inventory); ++k)
    add_vector(array, fg_inventory_vector_at(inventory, k));
  char *text = cJSON_Print(root);
  if (text)
    puts(text);
  else
    complain("out of memory for the JSON text");
  int code = text ? EXIT_DONE : EXIT_FAILED;
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}

int command_info(const void *given)
{
  const info_settings *settings = given;
  if (sandbox_reading(settings->file, NULL))
    return EXIT_FAILED;
  fg_context *context;
  if (create_context(&context))
    return EXIT_FAILED;
  fg_inventory *inventory = NULL;
  int code = EXIT_DONE;
  fg_status status = fg_inventory_read(&inventory, context, settings->file);
  if (status)
    code = complain_of(context, status, settings->file);
  else if (settings->json)
    code = print_json(settings->file, inventory);
  else {
    printf("file: %s\nformat: %s\n", settings->file, fg_inventory_format(inventory));
    for (int k = 0; k < fg_inventory_vector_count(inventory); ++k)
      print_vector(fg_inventory_vector_at(inventory, k));
  }
  if (!status && fg_inventory_vector_count(inventory) == 0) {
    complain("%s: holds no vector field", settings->file);
    advise("`flowgrain run --vars U,V` takes variables by any names.");
    code = EXIT_FAILED;
  }
  fg_inventory_destroy(inventory);
  fg_context_destroy(context);
  return code;
}
