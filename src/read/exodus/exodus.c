/* Exodus II as a format. */
#include "read/exodus/exodus.h"

#include "base/memory.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum {
  MARK_WITHIN = 1 << 18, /* bytes in which the dimensions' names stand */
  MOST_TIMES_LARGER = 4096
};

static bool has_text(const unsigned char *bytes, size_t size, const char *text)
{
  const size_t length = strlen(text);
  for (const unsigned char *at = bytes, *end = bytes + size;
       (at = memchr(at, text[0], (size_t)(end - at))) != NULL; ++at) {
    if ((size_t)(end - at) < length)
      return false;
    if (memcmp(at, text, length) == 0)
      return true;
  }
  return false;
}

static bool is_exodus(const unsigned char *bytes, size_t size)
{
  const size_t within = size < MARK_WITHIN ? size : MARK_WITHIN;
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE &&
         has_text(bytes, within, "num_el_blk") && has_text(bytes, within, "num_nodes");
}

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

fg_status fg__exodus_add(void **bytes, fg__vtk *vtk, const char *name,
                         fg__vtk_place place, fg__vtk_type type, int components,
                         size_t tuples)
{
  fg__vtk_array *array;
  fg_status status = fg__vtk_add_array(&array, vtk, name, place);
  if (status != FG_STATUS_OK)
    return status;
  array->type = type;
  array->components = components;
  array->storage = FG__VTK_RAW;
  array->text_size = tuples * (size_t)components * fg__vtk_size_of(type);
  array->text = array->joined_text =
      fg__allocate(tuples, (size_t)components * fg__vtk_size_of(type));
  *bytes = array->joined_text;
  return *bytes ? FG_STATUS_OK
                : fg__fail_memory(vtk->context, "an array of the file", array->text_size);
}

/* The coordinates of all nodes: a variable for each axis, before 1998 one for all. */
static fg_status add_positions(fg__vtk *vtk, const fg__exodus *e)
{
  static const char *const names[] = {"coordx", "coordy", "coordz"};
  const fg__variable *all = fg__dataset_find(&e->file, "coord");
  double *line = fg__allocate(e->points, sizeof *line);
  void *bytes = NULL;
  fg_status status =
      line ? FG_STATUS_OK : fg__fail_memory(vtk->context, "points", e->points * 8);
  if (status == FG_STATUS_OK)
    status = fg__exodus_add(&bytes, vtk, "points", FG__VTK_COORDINATES, FG__VTK_FLOAT64,
                            3, e->points);
  for (size_t k = 0; k < e->dimension && k < 3 && status == FG_STATUS_OK; ++k) {
    const fg__variable *v = all ? all : fg__dataset_find(&e->file, names[k]);
    const size_t first[2] = {k, 0}, count[2] = {1, e->points};
    if (!v)
      status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no variable '%s'",
                        vtk->path, names[k]);
    else
      status = fg__exodus_numbers(line, e, v, first + (all ? 0 : 1),
                                  count + (all ? 0 : 1), all ? 2 : 1);
    for (size_t n = 0; n < e->points && status == FG_STATUS_OK; ++n)
      ((double *)bytes)[3 * n + k] = line[n];
  }
  free(line);
  return status;
}

/* The times, and which is chosen. */
static fg_status choose_time(size_t *out, fg__vtk *vtk, const fg__exodus *e,
                             const fg_read_options *options)
{
  const fg__variable *v = fg__dataset_find(&e->file, "time_whole");
  const size_t first = 0;
  *out = options && options->time > 0 ? (size_t)options->time : 0;
  if (e->times == 0 || e->times > INT_MAX || !v)
    return FG_STATUS_OK;
  if (*out >= e->times || (options && options->time < 0))
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: time %d is asked for; there are %zu, from 0 on", vtk->path,
                    options ? options->time : 0, e->times);
  fg_status status = fg__exodus_check(e, v, &first, &e->times, 1);
  if (status != FG_STATUS_OK)
    return status;
  vtk->time_list = fg__allocate(e->times, sizeof *vtk->time_list);
  if (!vtk->time_list)
    return fg__fail_memory(vtk->context, "times", e->times * sizeof *vtk->time_list);
  vtk->times = (int)e->times;
  status = fg__exodus_numbers(vtk->time_list, e, v, &first, &e->times, 1);
  return status == FG_STATUS_OK
             ? fg__time_write(vtk->time, vtk->context, vtk->time_list[*out])
             : status;
}

static fg_status find_sizes(fg__exodus *e, const fg__vtk *vtk)
{
  e->points = fg__exodus_length(e, "num_nodes");
  e->dimension = fg__exodus_length(e, "num_dim");
  e->times = fg__exodus_length(e, "time_step");
  if (e->points >= 1 && e->points <= INT_MAX && e->dimension >= 2 && e->dimension <= 3 &&
      e->points / MOST_TIMES_LARGER <= e->file.file[0].size)
    return FG_STATUS_OK;
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                  "%s: %zu nodes in %zu dimensions, in a file of %zu bytes", vtk->path,
                  e->points, e->dimension, e->file.file[0].size);
}

static fg_status take_apart(fg__vtk *vtk, fg__exodus *e, const fg_read_options *options)
{
  size_t time = 0;
  fg_status status = find_sizes(e, vtk);
  if (status == FG_STATUS_OK)
    status = fg__exodus_blocks(e, options ? options->block : NULL);
  if (status == FG_STATUS_OK)
    status = choose_time(&time, vtk, e, options);
  if (status == FG_STATUS_OK)
    status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  vtk->pieces[0].positions = vtk->array_count;
  vtk->pieces[0].points = e->points;
  status = add_positions(vtk, e);
  if (status == FG_STATUS_OK)
    status = fg__exodus_add_cells(vtk, e);
  vtk->pieces[0].first_array = vtk->array_count;
  if (status == FG_STATUS_OK && e->times > 0)
    status = fg__exodus_add_variables(vtk, e, time);
  return status == FG_STATUS_OK ? fg__vtk_end_piece(vtk) : status;
}

static fg_status open_exodus(fg__vtk *out, fg_context *context, const fg__source *source,
                             const fg_read_options *options)
{
  fg__exodus e = {.block = NULL};
  *out = (fg__vtk){.context = context,
                   .path = source->path,
                   .file_size = SIZE_MAX, /* its arrays are in memory, each by itself */
                   .kind = FG__VTK_UNSTRUCTURED,
                   .has_blocks = true};
  fg_status status = fg__nc_open(&e.file, context, source);
  if (status == FG_STATUS_OK)
    status = take_apart(out, &e, options);
  free(e.block);
  fg__dataset_close(&e.file);
  return status;
}

FG__VTK_HOOKS(open_exodus)

const fg__format fg__format_exodus = {.name = "Exodus",
                                      .files = "Exodus II (.exo, .e)",
                                      .is_mine = is_exodus,
                                      .inventory = inventory_hook,
                                      .read = read_hook};
