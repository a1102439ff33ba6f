/* The rows of a table as points. */
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "file/number_text.h"
#include "read/table/table.h"
#include "terms/dates.h"

enum {
  ROLES = 11,
  VELOCITY = 3,
  VALID = 6,
  MASK = 8,
  TIME = 9,
  LEVEL = 10,
  STOP_EVERY = 1 << 16
};

/* What is read of each row: place, velocity, validity, mask, time, level. */
typedef struct row_reader {
  const fg__table *table;
  const fg__table_vector *vector;
  int *role; /* [columns], of each column; -1: none */
  double value[ROLES];
  fg__angles angles;
  bool dated; /* the time of this row is a date, in seconds from 1970 on */
} row_reader;

static void set_role(row_reader *r, int column, int role)
{
  if (column >= 0)
    r->role[column] = role;
}

static fg_status set_roles(row_reader *r)
{
  const size_t columns = (size_t)r->table->columns;
  r->role = fg__allocate(columns, sizeof *r->role);
  if (!r->role)
    return fg__fail_memory(r->table->context, "columns", columns * sizeof *r->role);
  for (size_t c = 0; c < columns; ++c)
    r->role[c] = -1;
  for (int k = 0; k < 2; ++k)
    set_role(r, r->vector->valid[k], VALID + k);
  set_role(r, r->vector->mask, MASK);
  set_role(r, r->vector->time, TIME);
  set_role(r, r->vector->level, LEVEL);
  for (int k = 0; k < r->vector->dimension && k < 3; ++k) {
    set_role(r, r->vector->velocity[k], VELOCITY + k);
    set_role(r, r->vector->position[k], k);
  }
  return FG_STATUS_OK;
}

static fg_status fail_number(const row_reader *r, const fg__table_line *line, int column,
                             const fg__table_field *field)
{
  const char *name = r->table->column[column].name;
  return fg__fail(r->table->context, FG_STATUS_FILE_FORMAT,
                  "%s: line %d, column %d (%s): \"%.*s\" is no number", r->table->path,
                  line->number, column + 1, name,
                  (int)(field->size < 40 ? field->size : 40), field->text);
}

static fg_status fail_columns(const row_reader *r, const fg__table_line *line, int count)
{
  const int columns = r->table->columns;
  return fg__fail(r->table->context, FG_STATUS_FILE_FORMAT,
                  "%s: line %d has %s%d columns, not %d as others", r->table->path,
                  line->number, count > columns ? "more than " : "",
                  count > columns ? columns : count, columns);
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
  if (table->kind == FG__TABLE_TECPLOT && line->size > 4 &&
      strncasecmp(line->text, "ZONE", 4) == 0)
    return fg__fail(table->context, FG_STATUS_UNSUPPORTED,
                    "%s: line %d begins a second zone; only files of one can be read",
                    table->path, line->number);
  return FG_STATUS_OK;
}

/* A time as ISO 8601 writes dates. */
static bool read_date(double *out, const fg__table_field *field)
{
  char text[FG__TABLE_NUMBER];
  fg__period period;
  if (field->size >= sizeof text)
    return false;
  memcpy(text, field->text, field->size);
  text[field->size] = '\0';
  if (!fg__period_read(&period, text))
    return false;
  *out = period.seconds;
  return true;
}

static fg_status read_row(row_reader *r, const fg__table_line *line)
{
  const fg__table *table = r->table;
  fg__table_field field;
  int count = 0;
  for (int k = 0; k < ROLES; ++k)
    r->value[k] = (double)NAN;
  r->dated = false;
  fg_status status = check_line(table, line);
  if (status != FG_STATUS_OK)
    return status;
  for (size_t at = 0;
       count <= table->columns && fg__table_split(&field, line, &at, table->style);
       ++count) {
    if (count == table->columns || r->role[count] < 0)
      continue;
    const int role = r->role[count];
    double *value = &r->value[role];
    if (fg__table_number(value, &field, table->style.decimal) != FG__TABLE_NO_NUMBER)
      continue;
    if (role < TIME)
      return fail_number(r, line, count, &field);
    if (role == TIME)
      r->dated = read_date(value, &field);
  }
  return count == table->columns ? FG_STATUS_OK : fail_columns(r, line, count);
}

/* Insight's CHC is negative where a vector is none, PIVlab's type 0 where it is masked,
 * OpenPIV's flags and mask are not 0. */
static bool is_valid(const row_reader *r)
{
  for (int k = 0; k < 2; ++k) {
    const int column = r->vector->valid[k];
    const double value = r->value[VALID + k];
    if (column < 0 || isnan(value))
      continue;
    const char *name = r->table->column[column].plain;
    if (strcmp(name, "chc") == 0                                  ? value < 0.0
        : strcmp(name, "flags") == 0 || strcmp(name, "mask") == 0 ? value != 0.0
                                                                  : value == 0.0)
      return false;
  }
  if (r->table->kind == FG__TABLE_DAVIS && r->value[VELOCITY] == 0.0 &&
      r->value[VELOCITY + 1] == 0.0)
    return false;
  return r->vector->mask < 0 || r->value[MASK] > 0.0;
}

typedef struct growth {
  size_t position[3], velocity[3], time, level, record;
} growth;

static bool grow(void **array, size_t *capacity, size_t count, size_t size)
{
  return fg__grow(array, capacity, count + 1, size);
}

static fg_status add_row(fg__scatter *out, growth *g, row_reader *r, int line)
{
  for (int k = 0; k < out->dimension && k < 3; ++k)
    if (isnan(r->value[k]))
      return FG_STATUS_OK;
  double *pair = &r->value[VELOCITY];
  if (r->vector->polar.sense != 0) {
    fg__angles_add(&r->angles, pair[1]);
    if (pair[0] == 0.0) /* a calm has no direction */
      pair[1] = 0.0;
    fg__polar_turn(pair, &r->vector->polar);
  }
  const bool valid = is_valid(r);
  const size_t n = out->count;
  bool grown = true;
  for (int k = 0; k < out->dimension && k < 3 && grown; ++k) {
    void *position = out->position[k], *velocity = out->velocity[k];
    grown = grow(&position, &g->position[k], n, sizeof(double)) &&
            grow(&velocity, &g->velocity[k], n, sizeof(float));
    out->position[k] = position;
    out->velocity[k] = velocity;
    if (grown) {
      out->position[k][n] = r->value[k];
      out->velocity[k][n] = valid ? fg__as_velocity(r->value[VELOCITY + k]) : NAN;
    }
  }
  void *time = out->time, *level = out->level, *record = out->record;
  if (r->vector->time >= 0)
    grown = grown && grow(&time, &g->time, n, sizeof(double));
  out->time = time;
  if (r->vector->level >= 0)
    grown = grown && grow(&level, &g->level, n, sizeof(double));
  out->level = level;
  grown = grown && grow(&record, &g->record, n, sizeof(int));
  out->record = record;
  if (!grown)
    return fg__fail_memory(r->table->context, "points", n * 32);
  if (n == 0)
    out->dated = r->dated;
  if (r->vector->time >= 0)
    out->time[n] = r->dated == out->dated ? r->value[TIME] : (double)NAN;
  if (r->vector->level >= 0)
    out->level[n] = r->value[LEVEL];
  out->record[n] = line;
  ++out->count;
  return FG_STATUS_OK;
}

fg_status fg__table_rows(fg__scatter *out, const fg__table *table,
                         const fg__table_vector *vector)
{
  row_reader r = {.table = table, .vector = vector};
  growth g = {0};
  fg__table_cursor cursor = table->data;
  fg__table_line line;
  fg__number_locale locale;
  *out = (fg__scatter){.context = table->context,
                       .path = table->path,
                       .dimension = vector->dimension,
                       .records = "line",
                       .geographic = vector->geographic && vector->dimension == 2};
  if (vector->polar.sense != 0 && vector->polar.unit == 0.0)
    return fg__fail(table->context, FG_STATUS_UNSUPPORTED,
                    "%s: the direction %s is in '%s', not in degrees or radians",
                    table->path, table->column[vector->velocity[1]].name,
                    table->column[vector->velocity[1]].units);
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(table->context, "a locale", 1);
  fg_status status = set_roles(&r);
  while (status == FG_STATUS_OK && fg__table_next(&line, &cursor)) {
    if (fg__table_is_blank(&line) || fg__table_is_comment(&line))
      continue;
    if (is_heading(&line))
      break;
    if (line.number % STOP_EVERY == 0)
      status = fg__check_stop(table->context);
    if (status == FG_STATUS_OK)
      status = read_row(&r, &line);
    if (status == FG_STATUS_OK)
      status = add_row(out, &g, &r, line.number);
  }
  if (status == FG_STATUS_OK && vector->polar.sense != 0)
    status = fg__angles_check(&r.angles, table->context, &vector->polar, table->path,
                              table->column[vector->velocity[1]].name);
  free(r.role);
  fg__number_locale_end(&locale);
  if (status != FG_STATUS_OK)
    fg__scatter_clear(out);
  return status;
}
