/* A dataset of what an Exodus II file holds. */
#include "decode/exodus/exodus.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_VARIABLES = 500, MOST_TIMES_LARGER = 4096 };

size_t fg__exodus_length(const fg__exodus *e, const char *name)
{
  for (size_t i = 0; i < e->file.dimension_count; ++i)
    if (strcmp(e->file.dimensions[i].name, name) == 0)
      return e->file.dimensions[i].length;
  return 0;
}

fg_status fg__exodus_check(const fg__exodus *e, const fg__variable *v,
                           const size_t *first, const size_t *count, int rank)
{
  double all = 1.0;
  bool fits = v->rank == rank && fg__is_number(v);
  for (int k = 0; k < rank && fits; ++k) {
    const size_t length = e->file.dimensions[v->dimension[k]].length;
    fits = first[k] <= length && count[k] <= length - first[k];
    all *= (double)count[k];
  }
  if (!fits)
    return fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                    "%s: '%.100s' has another shape than the nodes, elements or times",
                    v->path, v->name);
  if (all / MOST_TIMES_LARGER > (double)e->file.file[0].size)
    return fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                    "%s: '%.100s' has %.0f numbers, but the file has only %zu bytes",
                    v->path, v->name, all, e->file.file[0].size);
  return FG_STATUS_OK;
}

fg_status fg__exodus_numbers(double *out, const fg__exodus *e, const fg__variable *v,
                             const size_t *first, const size_t *count, int rank)
{
  const fg_status status = fg__exodus_check(e, v, first, count, rank);
  if (status != FG_STATUS_OK)
    return status;
  return fg__variable_fetch(v, first, count, out);
}

void fg__exodus_text(char out[FG__EXODUS_NAME], const fg__exodus *e, const char *variable,
                     size_t row)
{
  const fg__variable *v = fg__dataset_find(&e->file, variable);
  out[0] = '\0';
  if (!v || v->rank != 2 || v->type != FG__TYPE_LETTERS ||
      e->file.dimensions[v->dimension[0]].length <= row)
    return;
  if (fg__variable_fetch_texts(v, row, 1, out, FG__EXODUS_NAME) != FG_STATUS_OK)
    out[0] = '\0';
  for (size_t length = strlen(out); length > 0 && out[length - 1] == ' ';)
    out[--length] = '\0';
}

/* The coordinates of all nodes: a variable for each axis, before 1998 one for all. */
static fg_status add_positions(fg__dataset *data, const fg__exodus *e)
{
  static const char *const names[] = {"coordx", "coordy", "coordz"};
  const fg__variable *all = fg__dataset_find(&e->file, "coord");
  double *line = fg__allocate(e->points, sizeof *line);
  double *position = data->space.cells.position =
      fg__allocate(e->points, 3 * sizeof *position);
  fg_status status = line && position
                         ? FG_STATUS_OK
                         : fg__fail_memory(data->context, "points", e->points * 24);
  data->space.cells.points = e->points;
  for (size_t n = 0; n < 3 * e->points && status == FG_STATUS_OK; ++n)
    position[n] = 0.0;
  for (size_t k = 0; k < e->dimension && k < 3 && status == FG_STATUS_OK; ++k) {
    const fg__variable *v = all ? all : fg__dataset_find(&e->file, names[k]);
    const size_t first[2] = {k, 0}, count[2] = {1, e->points};
    if (!v)
      status = fg__fail(data->context, FG_STATUS_FILE_FORMAT, "%s: has no variable '%s'",
                        data->file[0].path, names[k]);
    else
      status = fg__exodus_numbers(line, e, v, first + (all ? 0 : 1),
                                  count + (all ? 0 : 1), all ? 2 : 1);
    for (size_t n = 0; n < e->points && status == FG_STATUS_OK; ++n)
      position[3 * n + k] = line[n];
  }
  free(line);
  return status;
}

/* The times, and which is chosen. */
static fg_status choose_time(fg__dataset *data, fg__exodus *e,
                             const fg_read_options *options)
{
  const fg__variable *v = fg__dataset_find(&e->file, "time_whole");
  const size_t first = 0;
  const int wanted = options ? options->time : 0;
  if (e->times == 0 || e->times > INT_MAX || !v)
    return FG_STATUS_OK;
  fg_status status = fg__exodus_check(e, v, &first, &e->times, 1);
  if (status != FG_STATUS_OK)
    return status;
  double *time = fg__allocate(e->times, sizeof *time);
  if (!time)
    return fg__fail_memory(data->context, "times", e->times * sizeof *time);
  status = fg__dataset_choose_time(data, data->file[0].path, time, e->times, wanted);
  e->time = (size_t)wanted;
  return status == FG_STATUS_OK
             ? fg__exodus_numbers(data->time, e, v, &first, &e->times, 1)
             : status;
}

static fg_status find_sizes(fg__exodus *e)
{
  e->points = fg__exodus_length(e, "num_nodes");
  e->dimension = fg__exodus_length(e, "num_dim");
  e->times = fg__exodus_length(e, "time_step");
  if (e->points >= 1 && e->points <= INT_MAX && e->dimension >= 2 && e->dimension <= 3 &&
      e->points / MOST_TIMES_LARGER <= e->file.file[0].size)
    return FG_STATUS_OK;
  return fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                  "%s: %zu nodes in %zu dimensions, in a file of %zu bytes",
                  e->file.file[0].path, e->points, e->dimension, e->file.file[0].size);
}

/* Values of one variable at nodes [first, first + count): a variable for each since 1998,
 * before that one for all. */
static fg_status fetch_nodal(double *out, const fg__exodus *e, size_t number,
                             size_t first, size_t count)
{
  char name[32];
  snprintf(name, sizeof name, "vals_nod_var%zu", number + 1);
  const fg__variable *v = fg__dataset_find(&e->file, name);
  if (v)
    return fg__exodus_numbers(out, e, v, (size_t[2]){e->time, first},
                              (size_t[2]){1, count}, 2);
  v = fg__dataset_find(&e->file, "vals_nod_var");
  return v ? fg__exodus_numbers(out, e, v, (size_t[3]){e->time, number, first},
                                (size_t[3]){1, 1, count}, 3)
           : fg__fail(e->file.context, FG_STATUS_FILE_FORMAT, "%s: has no variable '%s'",
                      e->file.file[0].path, name);
}

/* Values of one variable of elements [first, end) of all chosen blocks; NaN in blocks
 * without it. */
static fg_status fetch_of_elements(double *out, const fg__exodus *e, size_t number,
                                   size_t first, size_t end)
{
  fg_status status = FG_STATUS_OK;
  size_t at = 0;
  for (size_t b = 0; b < e->blocks && at < end && status == FG_STATUS_OK; ++b) {
    const fg__exodus_block *block = &e->block[b];
    const size_t from = first > at ? first - at : 0;
    const size_t to = end - at < block->cells ? end - at : block->cells;
    char name[64];
    snprintf(name, sizeof name, "vals_elem_var%zueb%d", number + 1, block->number);
    const fg__variable *v = fg__dataset_find(&e->file, name);
    if (v && from < to)
      status =
          fg__exodus_numbers(out + (at + from - first), e, v, (size_t[2]){e->time, from},
                             (size_t[2]){1, to - from}, 2);
    for (size_t c = from; c < to && !v; ++c)
      out[at + c - first] = (double)NAN;
    at += block->cells;
  }
  return status;
}

static fg_status fetch(const fg__variable *variable, const size_t *start,
                       const size_t *count, double *out)
{
  const fg__exodus *e = variable->owner->file[variable->file].state;
  const size_t number = (size_t)variable->id;
  return variable->location == FG__OF_CELLS
             ? fetch_of_elements(out, e, number, start[0], start[0] + count[0])
             : fetch_nodal(out, e, number, start[0], count[0]);
}

static void close_file(void *state)
{
  fg__exodus *e = state;
  free(e->block);
  fg__dataset_close(&e->file);
}

static const fg__decoder DECODER = {
    .fetch = fetch, .state_bytes = sizeof(fg__exodus), .close = close_file};

static bool is_velocity(const char *name)
{
  return strncasecmp(name, "vel", 3) == 0;
}

/* Beside a velocity, what else has components along the axes, displacements and
 * accelerations, is none. */
static void mark_others(fg__dataset *data)
{
  bool found = false;
  for (size_t i = 0; i < data->variable_count; ++i)
    found = found || is_velocity(data->variables[i].name);
  for (size_t i = 0; i < data->variable_count && found; ++i)
    data->variables[i].no_velocity = !is_velocity(data->variables[i].name);
}

static fg_status add_variables(fg__dataset *data, const fg__exodus *e,
                               fg__location location)
{
  const bool nodal = location == FG__AT_POINTS;
  const size_t count = fg__exodus_length(e, nodal ? "num_nod_var" : "num_elem_var");
  if (count > MOST_VARIABLES)
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu variables; at most %d can be read", data->file[0].path,
                    count, MOST_VARIABLES);
  if (!fg__dataset_add_dimension(data, nodal ? "nodes" : "elements",
                                 nodal ? e->points : e->cells))
    return FG_STATUS_MEMORY;
  for (size_t n = 0; n < count && e->times > 0; ++n) {
    char name[FG__EXODUS_NAME];
    fg__exodus_text(name, e, nodal ? "name_nod_var" : "name_elem_var", n);
    fg__variable *v = fg__dataset_add_variable(data, "", name);
    if (!v)
      return FG_STATUS_MEMORY;
    v->type = FG__TYPE_FLOAT64;
    v->rank = 1;
    v->dimension[0] = (int)data->dimension_count - 1;
    v->location = location;
    v->id = (int)n;
  }
  return FG_STATUS_OK;
}

fg_status fg__exodus_open(fg__dataset *data, fg_context *context,
                          const fg__source *source, const fg_read_options *options)
{
  fg_status status =
      fg__dataset_begin(data, context, source->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  fg__exodus *e = data->file[data->files - 1].state;
  data->space.is_there = data->has_blocks = true;
  status = fg__nc_open(&e->file, context, source, NULL);
  if (status == FG_STATUS_OK && !fg__dataset_add_group(data))
    status = FG_STATUS_MEMORY;
  if (status == FG_STATUS_OK)
    status = find_sizes(e);
  if (status == FG_STATUS_OK)
    status = fg__exodus_blocks(e, options ? options->block : NULL);
  if (status == FG_STATUS_OK)
    status = choose_time(data, e, options);
  if (status == FG_STATUS_OK)
    status = add_positions(data, e);
  if (status == FG_STATUS_OK)
    status = fg__exodus_add_cells(data, e);
  if (status == FG_STATUS_OK)
    status = add_variables(data, e, FG__AT_POINTS);
  if (status == FG_STATUS_OK)
    status = add_variables(data, e, FG__OF_CELLS);
  if (status == FG_STATUS_OK)
    mark_others(data);
  return status;
}
