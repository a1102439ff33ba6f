/* Rows of a table: which of them are of one time or level, and which count. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/coordinates.h"
#include "terms/dates.h"
#include "terms/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The largest share of places that come again at one time and level. */
static const double FEW = 0.1;

/* A time or level has at least this number of rows, and their mean square distance to
 * their centroid is at least this share of that of all rows. */
enum { MANY = 8 };
static const double WIDELY = 0.5;

enum { TEXT_BYTES = 64, TEXTS_AT_ONCE = 4096 };

static bool is_position(const fg__unstructured *mesh, const fg__variable *v)
{
  return v == mesh->node[0] || v == mesh->node[1] || v == mesh->node[2];
}

static const fg__variable *find_column(const fg__dataset *data,
                                       const fg__unstructured *mesh, fg__column_use use,
                                       const fg__pair *pair)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    const bool is_temperature = strcmp(v->plain_name, "T") == 0;
    const bool is_component = v == pair->component[0] || v == pair->component[1];
    if (fg__lies_at_places(mesh, v) && fg__column_fits(v->plain_name, use) == 2 &&
        !is_temperature && !is_component && !is_position(mesh, v))
      return v;
  }
  return NULL;
}

/* Dates in texts become seconds from 1970 on; others NaN. */
static fg_status read_dates(double *out, const fg__variable *v, size_t count)
{
  char *texts = fg__allocate(TEXTS_AT_ONCE, TEXT_BYTES);
  fg_status status = FG_STATUS_OK;
  if (!texts)
    return fg__fail_memory(v->owner->context, "dates",
                           (size_t)TEXTS_AT_ONCE * TEXT_BYTES);
  for (size_t first = 0; first < count && status == FG_STATUS_OK;
       first += TEXTS_AT_ONCE) {
    const size_t n = count - first < TEXTS_AT_ONCE ? count - first : TEXTS_AT_ONCE;
    status = fg__variable_fetch_texts(v, first, n, texts, TEXT_BYTES);
    for (size_t i = 0; i < n && status == FG_STATUS_OK; ++i) {
      fg__period period;
      out[first + i] =
          fg__period_read(&period, texts + i * TEXT_BYTES) ? period.seconds : (double)NAN;
    }
  }
  free(texts);
  return status;
}

fg_status fg__row_values(double *out, const fg__dataset *data, const fg__variable *v,
                         size_t count)
{
  return fg__is_number(v) ? fg__read_all(out, data, v) : read_dates(out, v, count);
}

/* Places of rows in memory. */
typedef struct places {
  size_t count;
  int dimension;
  double *at[3];
} places;

typedef struct spot {
  double at[3];
} spot;

static int by_place(const void *a, const void *b)
{
  const spot *p = a, *q = b;
  for (int k = 0; k < 3; ++k)
    if (p->at[k] != q->at[k])
      return p->at[k] > q->at[k] ? 1 : -1;
  return 0;
}

/* How many rows lie where another does. */
static fg_status count_doubled(size_t *out, fg_context *context, const places *rows)
{
  spot *spots = fg__allocate(rows->count, sizeof *spots);
  *out = 0;
  if (!spots)
    return fg__fail_memory(context, "points", rows->count * sizeof *spots);
  for (size_t i = 0; i < rows->count; ++i)
    for (int k = 0; k < rows->dimension; ++k)
      spots[i].at[k] = rows->at[k][i];
  qsort(spots, rows->count, sizeof *spots, by_place);
  for (size_t i = 1; i < rows->count; ++i)
    *out += by_place(&spots[i - 1], &spots[i]) == 0;
  free(spots);
  return FG_STATUS_OK;
}

typedef struct valued_row {
  double value;
  size_t row;
} valued_row;

static int by_value(const void *a, const void *b)
{
  const valued_row *x = a, *y = b;
  return x->value < y->value   ? -1
         : x->value > y->value ? 1
                               : (x->row > y->row) - (x->row < y->row);
}

/* Adds the squared distances of `count` rows to their mean, along the axes. */
static void add_squares(double sum[3], const places *rows, const valued_row *first,
                        size_t count)
{
  for (int k = 0; k < rows->dimension; ++k) {
    const double *at = rows->at[k];
    double mean = 0.0;
    for (size_t i = 0; i < count; ++i)
      mean += at[first[i].row] / (double)count;
    for (size_t i = 0; i < count; ++i)
      sum[k] += (at[first[i].row] - mean) * (at[first[i].row] - mean);
  }
}

/* Whether each value is that of MANY rows or more, which are scattered like all of them:
 * particles that move, balloons that are read at some heights. A ship's places of one
 * hour are not. `sorted` ascends by value. */
static bool is_overlaid(const places *rows, const valued_row *sorted)
{
  double within[3] = {0.0}, all[3] = {0.0};
  for (size_t i = 0, end; i < rows->count; i = end) {
    for (end = i + 1; end < rows->count && sorted[end].value <= sorted[i].value;)
      ++end;
    if (end - i < MANY)
      return false;
    add_squares(within, rows, sorted + i, end - i);
  }
  add_squares(all, rows, sorted, rows->count);
  for (int k = 0; k < rows->dimension; ++k)
    if (!(within[k] >= WIDELY * all[k]))
      return false;
  return true;
}

/* The distinct values, ascending, where they tell rows apart. */
static fg_status find_values(fg__row_axis *out, fg_context *context, const places *rows,
                             const double *value)
{
  const size_t count = rows->count;
  valued_row *sorted = fg__allocate(count, sizeof *sorted);
  size_t doubled = 0;
  if (!sorted)
    return fg__fail_memory(context, "times", count * sizeof *sorted);
  for (size_t i = 0; i < count; ++i)
    sorted[i] = (valued_row){value[i], i};
  qsort(sorted, count, sizeof *sorted, by_value);
  fg_status status = count_doubled(&doubled, context, rows);
  out->ends[0] = sorted[0].value;
  out->ends[1] = sorted[count - 1].value;
  if (status == FG_STATUS_OK &&
      ((double)doubled > FEW * (double)count || is_overlaid(rows, sorted))) {
    out->value = fg__allocate(count, sizeof *out->value);
    if (!out->value)
      status = fg__fail_memory(context, "times", count * sizeof *out->value);
    for (size_t i = out->count = 0; out->value && i < count; ++i)
      if (i == 0 || sorted[i].value > sorted[i - 1].value)
        out->value[out->count++] = sorted[i].value;
  }
  free(sorted);
  return status;
}

/* Keeps the rows for which `keeps` is not 0. */
static void keep(places *rows, double *const column[2], const unsigned char *keeps)
{
  size_t kept = 0;
  for (size_t i = 0; i < rows->count; ++i) {
    if (!keeps[i])
      continue;
    for (int k = 0; k < rows->dimension; ++k)
      rows->at[k][kept] = rows->at[k][i];
    for (int k = 0; k < 2; ++k)
      if (column[k])
        column[k][kept] = column[k][i];
    ++kept;
  }
  rows->count = kept;
}

static void clear(places *rows, double *column[2])
{
  for (int k = 0; k < 3; ++k)
    free(rows->at[k]);
  for (int k = 0; k < 2; ++k)
    free(column[k]);
}

/* Finds the values of an axis, and leaves the rows of one of them. */
static fg_status split(fg__row_axis *axis, const fg__dataset *data, places *rows,
                       double *const column[2], int which, int wanted,
                       unsigned char *keeps)
{
  const double *value = column[which];
  bool all_known = axis->variable && rows->count > 0;
  for (size_t i = 0; i < rows->count && all_known; ++i)
    all_known = isfinite(value[i]);
  axis->count = 1;
  if (!all_known)
    return FG_STATUS_OK;
  const fg_status status = find_values(axis, data->context, rows, value);
  if (status != FG_STATUS_OK || !axis->value || wanted < 0 ||
      (size_t)wanted >= axis->count)
    return status;
  for (size_t i = 0; i < rows->count; ++i)
    keeps[i] = value[i] >= axis->value[wanted] && value[i] <= axis->value[wanted];
  keep(rows, column, keeps);
  return FG_STATUS_OK;
}

/* Says that rows of all times or levels are one field, where they differ. */
static void add_doubt(fg__grid *grid, const fg__row_axis *axis)
{
  char ends[2][FG__TEXT_BYTES], units[FG__TEXT_BYTES] = "";
  if (!axis->variable || axis->value || !(axis->ends[0] < axis->ends[1]))
    return;
  if (fg__is_number(axis->variable))
    fg__attribute_text(axis->variable, "units", units, sizeof units);
  for (int k = 0; k < 2; ++k)
    if (fg__is_number(axis->variable) ||
        !fg__date_of_seconds(axis->ends[k], ends[k], sizeof ends[k]))
      snprintf(ends[k], sizeof ends[k], "%g", axis->ends[k]);
  fg__doubt(grid->doubts, "rows of every %.60s, %.30s to %.30s%s%.30s, are one field",
            axis->variable->plain_name, ends[0], ends[1], units[0] ? " " : "", units);
}

static fg_status read_columns(places *rows, double *column[2], const fg__dataset *data,
                              const fg__unstructured *mesh)
{
  const fg__variable *const of[] = {mesh->rows_time.variable, mesh->rows_level.variable};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < rows->dimension && status == FG_STATUS_OK; ++k) {
    rows->at[k] = fg__allocate(rows->count, sizeof **rows->at);
    status = rows->at[k] ? fg__read_all(rows->at[k], data, mesh->node[k])
                         : fg__fail_memory(data->context, "places", rows->count * 8);
  }
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    if (!of[k])
      continue;
    column[k] = fg__allocate(rows->count, sizeof **column);
    status = column[k] ? fg__row_values(column[k], data, of[k], rows->count)
                       : fg__fail_memory(data->context, "times", rows->count * 8);
  }
  return status;
}

static void take(size_t *count, char name[FG__DIMENSION_BYTES], const fg__row_axis *axis)
{
  if (!axis->value)
    return;
  *count = axis->count;
  snprintf(name, FG__DIMENSION_BYTES, "%.200s", axis->variable->plain_name);
}

fg_status fg__rows_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                        const fg_read_options *options)
{
  fg__unstructured *mesh = grid->unstructured;
  double *column[2] = {NULL, NULL};
  places rows = {.count = grid->samples, .dimension = fg__places_dimension(mesh, pair)};
  mesh->rows_time = (fg__row_axis){.count = 1};
  mesh->rows_level = (fg__row_axis){.count = 1};
  if (mesh->location != FG__MESH_ON_POINTS || mesh->rank > 1 ||
      !data->dimensions[mesh->dimension].is_nameless)
    return FG_STATUS_OK;
  mesh->rows_time.variable = find_column(data, mesh, FG__COLUMN_TIME, pair);
  if (rows.dimension == 2)
    mesh->rows_level.variable = find_column(data, mesh, FG__COLUMN_LEVEL, pair);
  if (!mesh->rows_time.variable && !mesh->rows_level.variable)
    return FG_STATUS_OK;
  unsigned char *keeps = fg__allocate(rows.count, 1);
  fg_status status = keeps ? read_columns(&rows, column, data, mesh)
                           : fg__fail_memory(data->context, "rows", rows.count);
  if (status == FG_STATUS_OK) {
    for (size_t i = 0; i < rows.count; ++i) {
      keeps[i] = 1;
      for (int k = 0; k < rows.dimension; ++k)
        keeps[i] = keeps[i] && !isnan(rows.at[k][i]);
    }
    keep(&rows, column, keeps);
    status = split(&mesh->rows_time, data, &rows, column, 0, options->time, keeps);
  }
  if (status == FG_STATUS_OK)
    status = split(&mesh->rows_level, data, &rows, column, 1, options->level, keeps);
  if (status == FG_STATUS_OK) {
    add_doubt(grid, &mesh->rows_time);
    add_doubt(grid, &mesh->rows_level);
    take(&grid->times, grid->time_name, &mesh->rows_time);
    take(&grid->levels, grid->level_name, &mesh->rows_level);
  }
  free(keeps);
  clear(&rows, column);
  return status;
}

/* Columns that say whether a row counts: which of their values say that it does not. */
static bool hides(const char *name, double value)
{
  if (isnan(value))
    return false;
  if (fg__is_same(name, "chc")) /* Insight */
    return value < 0.0;
  /* OpenPIV's and numpy.ma's; else PIVlab's type and the like */
  return fg__is_same(name, "flags") || fg__is_same(name, "mask") ? value != 0.0
                                                                 : value == 0.0;
}

/* Whether a variable is such a column, or an array like it. A mask is one of numbers that
 * are true or false, or of OpenPIV's five columns or six with flags. */
static bool is_validity(const fg__dataset *data, const fg__variable *v)
{
  char type[FG__TEXT_BYTES];
  if (!fg__is_same(v->plain_name, "mask"))
    return fg__column_fits(v->plain_name, FG__COLUMN_VALIDITY) == 2;
  return data->variable_count == 5 || fg__dataset_find(data, "flags") ||
         (fg__attribute_text(v, "dtype", type, sizeof type) && strcmp(type, "bool") == 0);
}

fg_status fg__rows_hide(unsigned char *valid, const fg__dataset *data,
                        const fg__unstructured *mesh, size_t count)
{
  double *value = fg__allocate(count, sizeof *value);
  fg_status status =
      value ? FG_STATUS_OK : fg__fail_memory(data->context, "rows", count * 8);
  for (size_t i = 0; i < data->variable_count && status == FG_STATUS_OK; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!fg__lies_at_places(mesh, v) || !fg__is_number(v) || !is_validity(data, v) ||
        !data->dimensions[mesh->dimension].is_nameless)
      continue;
    status = fg__read_all(value, data, v);
    for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n)
      valid[n] = valid[n] && !hides(v->plain_name, value[n]);
  }
  free(value);
  return status;
}
