/* Tables as a format. */
#include "read/table/table.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "file/number_text.h"
#include "interpret/time_words.h"

enum { LOOKED_AT = 4096, LEVEL_BYTES = 2 * FG__TABLE_NAME + FG__NUMBER_BYTES + 8 };

/* Text, but no markup: the last format that is tried. A word in brackets is a heading, as
 * CFD-Post's [Name]; an array of JSON has none behind its bracket. */
static bool is_text(const unsigned char *bytes, size_t size)
{
  size_t first = 0, shown = 0;
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
    first = 3;
  for (size_t i = first; i < size && i < LOOKED_AT; ++i) {
    if ((bytes[i] < ' ' && !strchr("\t\n\r\f", bytes[i])) || bytes[i] == 0 ||
        bytes[i] == 0x7f)
      return false;
    if (shown == 0 && (bytes[i] == '[' ? i + 1 == size || !isalpha(bytes[i + 1])
                                       : strchr("<{", bytes[i]) != NULL))
      return false;
    shown += bytes[i] > ' ';
  }
  return shown > 0;
}

fg_status fg__table_open(fg__table *out, fg_context *context, const fg__source *source)
{
  *out = (fg__table){.context = context, .path = source->path};
  fg_status status = fg__table_find_layout(out, source);
  if (status != FG_STATUS_OK)
    return status;
  out->column = fg__allocate((size_t)out->columns, sizeof *out->column);
  if (!out->column)
    return fg__fail_memory(context, "columns", (size_t)out->columns * 200);
  return fg__table_find_names(out, source);
}

void fg__table_clear(fg__table *table)
{
  free(table->column);
  table->column = NULL;
}

/* A column's units, or those that its name implies. */
static const char *units_of(const fg__table_column *column)
{
  return !column->units[0] && strcmp(column->plain, "sknt") == 0 ? "kn" : column->units;
}

/* Names and units of what is read; borrowed from the table. */
static fg_field_arrays words_of(const fg__table *table, const fg__table_vector *vector,
                                const fg_read_options *options)
{
  fg_field_arrays words = {.scale = vector->geographic ? FG_SCALE_GEO : options->scale,
                           .velocity_units =
                               units_of(&table->column[vector->velocity[0]])};
  if (words.scale == FG_SCALE_AUTO)
    words.scale = FG_SCALE_PLAIN;
  for (int k = 0; k < vector->dimension && k < 3; ++k) {
    const fg__table_column *place = &table->column[vector->position[k]];
    if (vector->polar.sense == 0)
      words.velocity_name[k] = table->column[vector->velocity[k]].name;
    words.axis_name[k] = place->name;
    words.axis_units[k] = place->units;
    if (vector->geographic) {
      words.axis_name[k] = k == 0 ? "longitude" : "latitude";
      words.axis_units[k] = k == 0 ? "°E" : "°N";
    } else if (!table->named) {
      words.axis_name[k] = words.velocity_name[k] = NULL;
    }
  }
  return words;
}

static fg_status open_chosen(fg__table *table, fg__table_vector *vector,
                             fg_context *context, const fg__source *source,
                             const fg_read_options *options)
{
  fg_read_options own = *options;
  own.level = 0; /* looked at with the rows */
  fg_status status = fg__check_one_file(context, source, &own, "a table");
  *table = (fg__table){0};
  if (status == FG_STATUS_OK)
    status = fg__table_open(table, context, source);
  return status == FG_STATUS_OK ? fg__table_choose(vector, table, options) : status;
}

/* The times and levels of a table, and which ones are read. */
typedef struct table_choice {
  int times, levels;
  double *time, *level;
  bool dated; /* times are seconds from 1970-01-01 on */
  char chosen_time[FG__TIME_BYTES], chosen_level[LEVEL_BYTES]; /* "": no choice */
} table_choice;

static void clear_choice(table_choice *choice)
{
  free(choice->time);
  free(choice->level);
  *choice = (table_choice){0};
}

/* "t = 2.5", or a date. */
static fg_status write_time(char out[FG__TIME_BYTES], const fg__table *table,
                            const table_choice *choice, double time)
{
  return choice->dated ? fg__date_write(out, table->context, time)
                       : fg__time_write(out, table->context, time);
}

/* "z = 2.5 m" */
static fg_status write_level(char out[LEVEL_BYTES], const fg__table *table,
                             const fg__table_vector *vector, double level)
{
  const fg__table_column *column = &table->column[vector->level];
  char number[FG__NUMBER_BYTES];
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(table->context, "a locale", 1);
  fg__number_write(number, level);
  fg__number_locale_end(&locale);
  snprintf(out, LEVEL_BYTES, "%s = %s%s%s", column->name, number,
           column->units[0] ? " " : "", column->units);
  return FG_STATUS_OK;
}

/* The rows of one time and level. Points and choice are to be cleared even after a
 * failure. */
static fg_status read_rows(fg__scatter *points, table_choice *choice,
                           const fg__table *table, const fg__table_vector *vector,
                           int time, int level)
{
  *choice = (table_choice){.times = 1, .levels = 1};
  fg_status status = fg__table_rows(points, table, vector);
  if (status == FG_STATUS_OK)
    status = fg__scatter_choose(points, false, time, &choice->times, &choice->time);
  if (status == FG_STATUS_OK)
    status = fg__scatter_choose(points, true, level, &choice->levels, &choice->level);
  choice->dated = points->dated;
  if (status == FG_STATUS_OK && choice->time)
    status = write_time(choice->chosen_time, table, choice, choice->time[time]);
  if (status == FG_STATUS_OK && choice->level)
    status = write_level(choice->chosen_level, table, vector, choice->level[level]);
  return status;
}

/* The words of what was chosen. */
static void add_choice(fg_field_arrays *words, const table_choice *choice)
{
  words->time = choice->chosen_time[0] ? choice->chosen_time : NULL;
  words->level = choice->chosen_level[0] ? choice->chosen_level : NULL;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg__table table;
  fg__table_vector vector;
  fg__scatter points = {0};
  table_choice choice = {0};
  fg__scatter_between between;
  *out = NULL;
  fg_status status = open_chosen(&table, &vector, context, source, options);
  if (status == FG_STATUS_OK)
    status = read_rows(&points, &choice, &table, &vector, options->time, options->level);
  if (status == FG_STATUS_OK) {
    fg_field_arrays words = words_of(&table, &vector, options);
    add_choice(&words, &choice);
    status = fg__scatter_field(out, &between, &points, &words, slab);
  }
  clear_choice(&choice);
  fg__scatter_clear(&points);
  fg__table_clear(&table);
  return status;
}

static fg_status read_sphere(fg__sphere **out, fg_context *context,
                             const fg__source *source, const fg_read_options *options)
{
  fg__table table;
  fg__table_vector vector;
  fg__scatter points = {0};
  table_choice choice = {0};
  *out = NULL;
  fg_status status = open_chosen(&table, &vector, context, source, options);
  if (status == FG_STATUS_OK && vector.geographic) {
    status = read_rows(&points, &choice, &table, &vector, options->time, options->level);
    fg_field_arrays words = words_of(&table, &vector, options);
    add_choice(&words, &choice);
    if (status == FG_STATUS_OK)
      status = fg__scatter_sphere(out, &points, &words);
  }
  clear_choice(&choice);
  fg__scatter_clear(&points);
  fg__table_clear(&table);
  return status;
}

static fg_status add_entry(fg_inventory *inventory, const fg__table *table,
                           const fg__table_vector *vector, const fg_field *field,
                           fg_inventory_vector *entry, const table_choice *choice)
{
  const size_t times = choice->time ? (size_t)choice->times : 0;
  const size_t levels = choice->level ? (size_t)choice->levels : 0,
               count = times + levels;
  fg_axis_value *values = fg__allocate(count, sizeof *values);
  char(*words)[LEVEL_BYTES] = fg__allocate(count, sizeof *words);
  fg_status status =
      values && words ? FG_STATUS_OK
                      : fg__fail_memory(table->context, "times", count * sizeof *words);
  for (size_t i = 0; i < times && status == FG_STATUS_OK; ++i) {
    status = write_time(words[i], table, choice, choice->time[i]);
    values[i] = (fg_axis_value){choice->time[i], "", words[i]};
  }
  for (size_t i = times; i < count && status == FG_STATUS_OK; ++i) {
    status = write_level(words[i], table, vector, choice->level[i - times]);
    values[i] = (fg_axis_value){choice->level[i - times],
                                table->column[vector->level].units, words[i]};
  }
  entry->times = choice->times;
  entry->time_value = times > 0 ? values : NULL;
  entry->levels = choice->levels;
  entry->level_value = levels > 0 ? values + times : NULL;
  if (status == FG_STATUS_OK)
    status = fg__scatter_describe(inventory, table->context, field, *entry);
  free(values);
  free(words);
  return status;
}

/* Adds "; rows of every height, 2 to 998 m" where values differ and tell no rows apart.
 */
static void add_untold(char *out, size_t size, const fg__table_column *column,
                       const double *value, size_t count, bool dated, fg_context *context)
{
  char ends[2][FG__TIME_BYTES];
  double end[2] = {HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; value && i < count; ++i) {
    end[0] = fmin(end[0], value[i]);
    end[1] = fmax(end[1], value[i]);
  }
  const size_t used = strlen(out);
  if (!(end[0] < end[1]))
    return;
  for (int k = 0; k < 2; ++k)
    if (!dated || fg__date_write(ends[k], context, end[k]) != FG_STATUS_OK)
      snprintf(ends[k], sizeof ends[k], "%g", end[k]);
  snprintf(out + used, size - used, "; rows of every %s, %s to %s%s%s", column->name,
           ends[0], ends[1], column->units[0] && !dated ? " " : "",
           dated ? "" : column->units);
}

static fg_status describe_vector(fg_inventory *inventory, const fg__table *table,
                                 const fg__table_vector *vector)
{
  static const fg_read_options defaults = {0};
  const fg_field_arrays words = words_of(table, vector, &defaults);
  fg_inventory_vector entry = {.components = vector->dimension,
                               .units = words.velocity_units,
                               .levels = 1,
                               .scale = words.scale};
  for (int k = 0; k < vector->dimension && k < 3; ++k)
    entry.name[k] = table->column[vector->velocity[k]].name;
  fg__scatter points = {0};
  fg__scatter_between between = {0};
  table_choice choice = {0};
  fg_field *field = NULL;
  char found_by[8 * FG__TABLE_NAME];
  fg_status status = read_rows(&points, &choice, table, vector, 0, 0);
  snprintf(found_by, sizeof found_by, "%s", vector->found_by);
  if (status == FG_STATUS_OK && !choice.time && vector->time >= 0)
    add_untold(found_by, sizeof found_by, &table->column[vector->time], points.time,
               points.count, points.dated, table->context);
  if (status == FG_STATUS_OK && !choice.level && vector->level >= 0)
    add_untold(found_by, sizeof found_by, &table->column[vector->level], points.level,
               points.count, false, table->context);
  entry.found_by = found_by;
  if (status == FG_STATUS_OK)
    status = fg__scatter_field(&field, &between, &points, &words, (fg__slab_index){0, 1});
  fg__scatter_clear(&points);
  entry.cells = between.cells;
  entry.points = between.points;
  if (status == FG_STATUS_OK)
    status = add_entry(inventory, table, vector, field, &entry, &choice);
  clear_choice(&choice);
  fg_field_destroy(field);
  return status;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  static const fg_read_options defaults = {0};
  fg__table table;
  fg__table_vector found[FG__TABLE_VECTORS];
  fg_status status = fg__table_open(&table, context, source);
  int count = 0;
  if (status == FG_STATUS_OK)
    status = fg__table_vectors(found, &count, &table);
  if (status == FG_STATUS_OK && count == 0) /* the message tells the columns */
    status = fg__table_choose(found, &table, &defaults);
  for (int i = 0; i < count && status == FG_STATUS_OK; ++i)
    status = describe_vector(inventory, &table, &found[i]);
  fg__table_clear(&table);
  return status;
}

const fg__format fg__format_table = {
    .name = "table",
    .files = "tables of points in text (.csv, .txt, .dat, .vec)",
    .is_mine = is_text,
    .inventory = describe,
    .read = read_field,
    .sphere = read_sphere};
