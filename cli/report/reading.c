#include "report/reading.h"

#include <stdio.h>

#include "inputs.h"
#include "option/recorded.h"
#include "option/table.h"

void reading_find(reading_facts *facts, fg_input *input)
{
  fg_context *context;
  const fg_inventory *inventory = NULL;
  if (!input || fg_context_create(&context))
    return;
  inputs_give(context);
  fg_input_inventory(&inventory, context, input);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  if (vector) {
    facts->times = vector->times;
    facts->levels = vector->levels;
    snprintf(facts->found_by, sizeof facts->found_by, "%s", vector->found_by);
    snprintf(facts->frame, sizeof facts->frame, "%s", vector->frame ? vector->frame : "");
  }
  fg_context_destroy(context);
}

/* The options of the map; "field" has the grid that was read. */
static void add_map(cJSON *input, const fg_map_options *map)
{
  cJSON *object = cJSON_AddObjectToObject(input, "map");
  json_add_text(object, "projection", map->projection ? map->projection : "auto");
  if (map->has_center)
    json_add_numbers(object, "center", map->center, map->has_center_latitude ? 2 : 1);
  if (map->has_region)
    json_add_numbers(object, "region", map->region, map->region_is_box ? 6 : 4);
  if (map->samples)
    cJSON_AddNumberToObject(object, "samples", map->samples);
}

static void add_input(cJSON *root, const reading_facts *facts)
{
  const reading_settings *settings = facts->settings;
  cJSON *input = cJSON_AddObjectToObject(root, "input");
  files_record(input, settings);
  json_add_text(input, "vars", settings->vars);
  json_add_text(input, "at", settings->at);
  json_add_text(input, "mask", settings->mask);
  json_add_text(input, "missing", settings->missing);
  json_add_text(input, "block", settings->block);
  json_add_text(input, "slice", settings->slice);
  cJSON_AddNumberToObject(input, "time", settings->time);
  cJSON_AddNumberToObject(input, "level", settings->level);
  if (facts->times) {
    cJSON_AddNumberToObject(input, "times", facts->times);
    cJSON_AddNumberToObject(input, "levels", facts->levels);
  }
  json_add_text(input, "scale", scale_words[settings->scale]);
  if (settings->frame != FG_FRAME_AUTO)
    json_add_text(input, "frame", frame_words[settings->frame]);
  add_map(input, &settings->map);
}

static void add_field(cJSON *root, const reading_facts *facts)
{
  const fg_field_arrays *field = fg_field_contents(facts->field);
  cJSON *read = cJSON_AddObjectToObject(root, "field");
  json_add_words(read, "velocity", field->velocity_name, field->dimension);
  json_add_text(read, "velocity_units", field->velocity_units);
  json_add_words(read, "axes", field->axis_name, field->dimension);
  cJSON_AddItemToObject(read, "size",
                        cJSON_CreateIntArray(field->size, field->dimension));
  double bounds[6], periods[3];
  char text[3][CLEAN_BYTES] = {{0}};
  const char *const units[3] = {text[0], text[1], text[2]};
  for (int k = 0; k < field->dimension; ++k) {
    bounds[2 * k] = fg_field_measured(facts->field, k, field->axis[k][0]);
    bounds[2 * k + 1] =
        fg_field_measured(facts->field, k, field->axis[k][field->size[k] - 1]);
    fg_field_measured_units(text[k], sizeof text[k], facts->field, k);
    periods[k] = field->period[k];
  }
  json_add_words(read, "axis_units", units, field->dimension);
  json_add_numbers(read, "bounds", bounds, 2 * field->dimension);
  json_add_numbers(read, "period", periods, field->dimension);
  json_add_text(read, "scale", scale_words[field->scale]);
  json_add_text(read, "projection", field->projection);
  json_add_text(read, "title", field->title);
  json_add_text(read, "time", field->time);
  json_add_text(read, "level", field->level);
  json_add_text(read, "found_by", *facts->found_by ? facts->found_by : NULL);
  json_add_text(read, "frame", *facts->frame ? facts->frame : NULL);
  json_add_text(read, "doubts", field->doubts);
  cJSON_AddNumberToObject(read, "missing_share", fg_field_missing_share(facts->field));
  if (fg_field_normal_share(facts->field) > 0.0)
    cJSON_AddNumberToObject(read, "normal_share", fg_field_normal_share(facts->field));
}

void reading_report(cJSON *root, const reading_facts *facts)
{
  add_input(root, facts);
  if (facts->field)
    add_field(root, facts);
}
