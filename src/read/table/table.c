/* Tables as a format. */
#include "read/table/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { LOOKED_AT = 4096 };

/* Text with a digit, but no markup: the last format that is tried. */
static bool is_text(const unsigned char *bytes, size_t size)
{
  size_t first = 0, shown = 0;
  bool digit = false;
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
    first = 3;
  for (size_t i = first; i < size && i < LOOKED_AT; ++i) {
    if ((bytes[i] < ' ' && !strchr("\t\n\r\f", bytes[i])) || bytes[i] == 0 ||
        bytes[i] == 0x7f)
      return false;
    if (shown == 0 && strchr("<{[", bytes[i]))
      return false;
    shown += bytes[i] > ' ';
    digit = digit || (bytes[i] >= '0' && bytes[i] <= '9');
  }
  return digit;
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

static fg_status check_options(fg_context *context, const fg__source *source,
                               const fg_read_options *options)
{
  if (options->vars_from)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a second file with the other component cannot be used with a "
                    "table",
                    source->path);
  if (options->time != 0 || options->level != 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %s %d is asked for, but the file holds one only, number 0",
                    source->path, options->time != 0 ? "time" : "level",
                    options->time != 0 ? options->time : options->level);
  return FG_STATUS_OK;
}

/* Names and units of what is read; borrowed from the table. */
static fg_field_arrays words_of(const fg__table *table, const fg__table_vector *vector,
                                const fg_read_options *options)
{
  fg_field_arrays words = {.scale = vector->geographic ? FG_SCALE_GEO : options->scale,
                           .velocity_units = table->column[vector->velocity[0]].units};
  if (words.scale == FG_SCALE_AUTO)
    words.scale = FG_SCALE_PLAIN;
  for (int k = 0; k < vector->dimension && k < 3; ++k) {
    const fg__table_column *place = &table->column[vector->position[k]];
    if (!vector->polar)
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
  fg_status status = check_options(context, source, options);
  *table = (fg__table){0};
  if (status == FG_STATUS_OK)
    status = fg__table_open(table, context, source);
  return status == FG_STATUS_OK ? fg__table_choose(vector, table, options) : status;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg__table table;
  fg__table_vector vector;
  fg__scatter points = {0};
  size_t cells;
  *out = NULL;
  fg_status status = open_chosen(&table, &vector, context, source, options);
  if (status == FG_STATUS_OK)
    status = fg__table_rows(&points, &table, &vector);
  if (status == FG_STATUS_OK) {
    const fg_field_arrays words = words_of(&table, &vector, options);
    status = fg__scatter_field(out, &cells, &points, &words, slab);
  }
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
  *out = NULL;
  fg_status status = open_chosen(&table, &vector, context, source, options);
  if (status == FG_STATUS_OK && vector.geographic) {
    status = fg__table_rows(&points, &table, &vector);
    const fg_field_arrays words = words_of(&table, &vector, options);
    if (status == FG_STATUS_OK)
      status = fg__scatter_sphere(out, &points, &words);
  }
  fg__scatter_clear(&points);
  fg__table_clear(&table);
  return status;
}

/* What a vector cannot be read for is said of it, not held against the file. */
static fg_status describe_vector(fg_inventory *inventory, const fg__table *table,
                                 const fg__table_vector *vector)
{
  static const fg_read_options defaults = {0};
  const fg_field_arrays words = words_of(table, vector, &defaults);
  fg_inventory_vector entry = {.components = vector->dimension,
                               .units = words.velocity_units,
                               .found_by = vector->found_by,
                               .times = 1,
                               .levels = 1,
                               .scale = words.scale};
  for (int k = 0; k < vector->dimension && k < 3; ++k)
    entry.name[k] = table->column[vector->velocity[k]].name;
  fg__scatter points = {0};
  fg_field *field = NULL;
  fg_status status = fg__table_rows(&points, table, vector);
  if (status == FG_STATUS_OK)
    status =
        fg__scatter_field(&field, &entry.cells, &points, &words, (fg__slab_index){0, 1});
  fg__scatter_clear(&points);
  if (status == FG_STATUS_OK)
    status = fg__scatter_describe(inventory, table->context, field, entry);
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
  if (status == FG_STATUS_OK) {
    count = fg__table_vectors(found, &table);
    if (count == 0) /* the message tells the columns */
      status = fg__table_choose(found, &table, &defaults);
  }
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
