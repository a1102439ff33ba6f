/* The rows of a table as columns of a dataset. */
#include "decode/table/table.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "file/number_text.h"
#include "terms/units.h"

enum { LOOKED_AT = 4096, STOP_EVERY = 1 << 16, SHOWN = 40 };

/* A text that is no number in a column of numbers: the first one. */
typedef struct misfit {
  fg__table_line line;
  size_t count;
} misfit;

typedef struct table_state {
  fg__table table;
  size_t rows, cells_capacity, lines_capacity;
  double *cell;         /* [rows * columns]; NaN: missing, or a text */
  fg__table_line *line; /* [rows], in the source's bytes */
  misfit *misfit;       /* [columns] */
} table_state;

/* Text, but no markup: the last format that is tried. A word in brackets is a heading, as
 * CFD-Post's [Name]; an array of JSON has none behind its bracket. */
bool fg__is_table(const unsigned char *bytes, size_t size)
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

/* A heading in brackets: after it come other things than points, as CFD-Post's faces. */
static bool is_heading(const fg__table_line *line)
{
  return line->size > 2 && line->text[0] == '[' &&
         isalpha((unsigned char)line->text[1]) &&
         memchr(line->text, ']', line->size) != NULL;
}

/* What could be no row whatever it holds. */
static fg_status check_line(const fg__table *table, const fg__table_line *line)
{
  if (line->size > FG__TABLE_LINE)
    return fg__fail(table->context, FG_STATUS_FILE_FORMAT,
                    "%s: line %d has %zu bytes; no table's has more than %d", table->path,
                    line->number, line->size, FG__TABLE_LINE);
  return FG_STATUS_OK;
}

static fg_status fail_columns(const fg__table *table, const fg__table_line *line,
                              int count)
{
  const int columns = table->columns;
  return fg__fail(table->context, FG_STATUS_FILE_FORMAT,
                  "%s: line %d has %s%d columns, not %d as others", table->path,
                  line->number, count > columns ? "more than " : "",
                  count > columns ? columns : count, columns);
}

static bool grow(table_state *s)
{
  const size_t columns = (size_t)s->table.columns;
  void *cell = s->cell, *line = s->line;
  const bool grown =
      fg__grow(&cell, &s->cells_capacity, (s->rows + 1) * columns, sizeof *s->cell) &&
      fg__grow(&line, &s->lines_capacity, s->rows + 1, sizeof *s->line);
  s->cell = cell;
  s->line = line;
  return grown;
}

static fg_status read_row(table_state *s, const fg__table_line *line)
{
  const fg__table *table = &s->table;
  fg__table_field field;
  int count = 0;
  fg_status status = check_line(table, line);
  if (status == FG_STATUS_OK && !grow(s))
    status = fg__fail_memory(table->context, "rows", s->rows * 64);
  if (status != FG_STATUS_OK)
    return status;
  double *cell = s->cell + s->rows * (size_t)table->columns;
  for (size_t at = 0;
       count <= table->columns && fg__table_split(&field, line, &at, table->style);
       ++count)
    if (count < table->columns &&
        fg__table_number(&cell[count], &field, table->style.decimal) ==
            FG__TABLE_NO_NUMBER &&
        s->misfit[count].count++ == 0)
      s->misfit[count].line = *line;
  if (count != table->columns)
    return fail_columns(table, line, count);
  if (table->kind == FG__TABLE_DAVIS && cell[2] == 0.0 && cell[3] == 0.0)
    cell[2] = cell[3] = (double)NAN;
  s->line[s->rows++] = *line;
  return FG_STATUS_OK;
}

static fg_status read_rows(table_state *s)
{
  fg__table_cursor cursor = s->table.data;
  fg__table_line line;
  fg__number_locale locale;
  fg_status status = FG_STATUS_OK;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(s->table.context, "a locale", 1);
  while (status == FG_STATUS_OK && fg__table_next_row(&line, &cursor)) {
    if (is_heading(&line))
      break;
    if (line.number % STOP_EVERY == 0)
      status = fg__check_stop(s->table.context);
    if (status == FG_STATUS_OK)
      status = read_row(s, &line);
  }
  fg__number_locale_end(&locale);
  return status;
}

static const table_state *state_of(const fg__variable *v)
{
  return v->owner->file[v->file].state;
}

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  const table_state *s = state_of(v);
  const size_t columns = (size_t)s->table.columns;
  const misfit *bad = &s->misfit[v->id];
  if (bad->count > 0) {
    const fg__table_field field = fg__table_field_at(&bad->line, s->table.style, v->id);
    return fg__fail(s->table.context, FG_STATUS_FILE_FORMAT,
                    "%s: line %d, column %d (%s): \"%.*s\" is no number", s->table.path,
                    bad->line.number, v->id + 1, v->name,
                    (int)(field.size < SHOWN ? field.size : SHOWN), field.text);
  }
  for (size_t n = 0; n < count[0]; ++n)
    out[n] = s->cell[(start[0] + n) * columns + (size_t)v->id];
  return FG_STATUS_OK;
}

static fg_status fetch_texts(const fg__variable *v, size_t first, size_t count, char *out,
                             size_t size)
{
  const table_state *s = state_of(v);
  for (size_t n = 0; n < count; ++n) {
    const fg__table_field field =
        fg__table_field_at(&s->line[first + n], s->table.style, v->id);
    snprintf(out + n * size, size, "%.*s", (int)(field.size < size ? field.size : size),
             field.text);
  }
  return FG_STATUS_OK;
}

static size_t record(const fg__variable *v, size_t n)
{
  return (size_t)state_of(v)->line[n].number;
}

static void close_state(void *state)
{
  table_state *s = state;
  free(s->table.column);
  free(s->cell);
  free(s->line);
  free(s->misfit);
}

static const fg__decoder DECODER = {.fetch = fetch,
                                    .fetch_texts = fetch_texts,
                                    .state_bytes = sizeof(table_state),
                                    .close = close_state,
                                    .has_no_titles = true,
                                    .records = "line",
                                    .record = record};

/* The units of a column, also by its name. FILE_FORMAT: degrees west or south by name
 * alone, and numbers below 0, which count to the east or north in most tables. */
static fg_status find_units(const char **out, fg_context *context, const char *path,
                            const table_state *s, int c)
{
  const fg__table_column *column = &s->table.column[c];
  fg__unit unit;
  *out = column->units[0] ? column->units : fg__units_of_name(column->name);
  fg__unit_read(&unit, *out);
  for (size_t n = 0; n < s->rows && !column->units[0] && unit.factor < 0.0; ++n) {
    const double value = s->cell[n * (size_t)s->table.columns + (size_t)c];
    if (!(value < 0.0))
      continue;
    fg__fail(context, FG_STATUS_FILE_FORMAT,
             "%s: '%.60s' is in %s by its name, and has %g: a sign and a name that both "
             "turn it",
             path, column->name, *out, value);
    fg__hint(context, "Without W or S in its name, numbers below 0 are west or south.");
    return FG_STATUS_FILE_FORMAT;
  }
  return FG_STATUS_OK;
}

/* A column of which most fields are texts is one of texts. */
static fg_status add_column(fg__dataset *dataset, const table_state *s, int c)
{
  const fg__table_column *column = &s->table.column[c];
  const char *units;
  const fg_status status =
      find_units(&units, dataset->context, dataset->file[dataset->files - 1].path, s, c);
  if (status != FG_STATUS_OK)
    return status;
  char number[16];
  size_t known = 0;
  for (size_t n = 0; n < s->rows; ++n)
    known += !isnan(s->cell[n * (size_t)s->table.columns + (size_t)c]) ? 1U : 0U;
  snprintf(number, sizeof number, "%d", c + 1);
  fg__variable *v =
      fg__dataset_add_variable(dataset, "", column->name[0] ? column->name : number);
  if (!v)
    return FG_STATUS_MEMORY;
  v->plain_name = v->name;
  v->type = s->misfit[(size_t)c].count > known ? FG__TYPE_TEXTS : FG__TYPE_FLOAT64;
  v->rank = 1;
  v->dimension[0] = (int)dataset->dimension_count - 1;
  v->in_one_run = true;
  v->id = c;
  return units[0] ? fg__variable_add_text(v, "units", units, strlen(units))
                  : FG_STATUS_OK;
}

static fg_status add_columns(fg__dataset *dataset, const table_state *s)
{
  fg_status status = FG_STATUS_OK;
  fg__dimension *rows = fg__dataset_add_dimension(dataset, "row", s->rows);
  if (!rows || !fg__dataset_add_group(dataset))
    return FG_STATUS_MEMORY;
  rows->is_nameless = true;
  for (int c = 0; c < s->table.columns && status == FG_STATUS_OK; ++c)
    status = add_column(dataset, s, c);
  return status;
}

fg_status fg__table_open(fg__dataset *dataset, fg_context *context,
                         const fg__source *source, const fg_read_options *options)
{
  (void)options;
  if (dataset->files > 0)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a second file cannot be used with a table", source->path);
  if (fg__has_zones(source))
    return fg__tecplot_open(dataset, context, source);
  fg_status status =
      fg__dataset_begin(dataset, context, source->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  table_state *s = dataset->file[0].state;
  s->table = (fg__table){.context = context, .path = dataset->file[0].path};
  status = fg__table_find_layout(&s->table, source);
  const size_t columns = (size_t)s->table.columns;
  if (status == FG_STATUS_OK) {
    s->table.column = fg__allocate(columns, sizeof *s->table.column);
    s->misfit = fg__allocate(columns, sizeof *s->misfit);
    if (!s->table.column || !s->misfit)
      status = fg__fail_memory(context, "columns", columns * 200);
  }
  if (status == FG_STATUS_OK)
    status = fg__table_find_names(&s->table, source);
  if (status == FG_STATUS_OK)
    status = read_rows(s);
  dataset->lost_names = s->table.has_places && !s->table.named;
  return status == FG_STATUS_OK ? add_columns(dataset, s) : status;
}
