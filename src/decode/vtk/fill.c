/* A dataset of what a VTK file holds. */
#include "base/memory.h"
#include "decode/vtk/vtk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COLUMNS = 9 }; /* of an array: a tensor's */

static void close_file(void *state)
{
  fg__vtk_close(state);
}

static fg_status check_files(const void *state, fg_status status)
{
  return fg__vtk_check(state, status);
}

static const fg__decoder DECODER = {.fetch = fg__vtk_fetch,
                                    .check = check_files,
                                    .state_bytes = sizeof(fg__vtk),
                                    .close = close_file};

fg_status fg__vtk_begin(fg__vtk **out, fg__dataset *data, fg_context *context,
                        const fg__source *source)
{
  fg_status status =
      fg__dataset_begin(data, context, source->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk *vtk = *out = data->file[data->files - 1].state;
  *vtk = (fg__vtk){.context = context, .path = source->path, .file_size = source->size};
  return FG_STATUS_OK;
}

/* The dimensions of points, then those of cells; along axes z, y, x. */
static fg_status add_dimensions(fg__dataset *data, const fg__vtk *vtk)
{
  static const char *const along[2][3] = {{"z", "y", "x"},
                                          {"z of cells", "y of cells", "x of cells"}};
  static const char *const listed[2] = {"points", "cells"};
  const fg__topology *cells = &data->space.cells;
  for (int place = 0; place < 2; ++place)
    for (int k = 0; k < (data->space.on_axes ? 3 : 1); ++k) {
      const size_t length = data->space.on_axes
                                ? fg__vtk_length(vtk->extent, 2 - k, (fg__vtk_place)place)
                            : place == 0 ? cells->points
                                         : cells->cells;
      if (!fg__dataset_add_dimension(
              data, data->space.on_axes ? along[place][k] : listed[place], length))
        return FG_STATUS_MEMORY;
    }
  return FG_STATUS_OK;
}

/* Of even points where index 0 is and how far one is from the next. */
static fg_status add_steps(fg__variable *v, const fg__vtk *vtk, int k)
{
  fg_status status = fg__variable_add_numbers(v, "origin", &vtk->origin[k], 1, true);
  return status == FG_STATUS_OK
             ? fg__variable_add_numbers(v, "spacing", &vtk->spacing[k], 1, true)
             : status;
}

static fg_status add_axes(fg__dataset *data, const fg__vtk *vtk)
{
  static const char *const names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    data->space.points[k] = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
    data->space.axis[k] = (int)data->variable_count;
    fg__variable *v = fg__dataset_add_variable(data, "", names[k]);
    if (!v)
      return FG_STATUS_MEMORY;
    v->type = FG__TYPE_FLOAT64;
    v->rank = 1;
    v->dimension[0] = 2 - k;
    v->id = k;
    fg_status status = FG_STATUS_OK;
    if (!vtk->uneven)
      status = add_steps(v, vtk, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

/* Samples that hide their points or cells say so by bits (vtkDataSetAttributes), or by
 * being 0. */
static fg_status add_hiding(fg__variable *v, fg__vtk_place place)
{
  static const struct {
    const char *name;
    fg__vtk_place place;
    double bits;
  } known[] = {{"vtkGhostType", FG__VTK_POINTS, 2},
               {"vtkGhostType", FG__VTK_CELLS, 8 + 32},
               {"vtkValidPointMask", FG__VTK_POINTS, 0}};
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n)
    if (place == known[n].place && strcmp(v->name, known[n].name) == 0)
      return fg__variable_add_numbers(v, "hiding_bits", &known[n].bits, 1, false);
  return FG_STATUS_OK;
}

static fg_status add_array(fg__dataset *data, const fg__vtk *vtk,
                           const fg__vtk_array *array)
{
  const char *active = vtk->vectors[array->place];
  const int rank = data->space.on_axes ? 3 : 1;
  fg__variable *v = fg__dataset_add_variable(data, "", array->name);
  if (!v)
    return FG_STATUS_MEMORY;
  v->type = array->type;
  v->location = array->place == FG__VTK_CELLS ? FG__OF_CELLS : FG__AT_POINTS;
  v->is_marked = active && strcmp(active, array->name) == 0;
  v->no_velocity = array->no_velocity;
  v->rank = rank;
  for (int k = 0; k < rank; ++k)
    v->dimension[k] = k + (array->place == FG__VTK_CELLS ? rank : 0);
  fg_status status = add_hiding(v, array->place);
  if (status == FG_STATUS_OK && array->units)
    status = fg__variable_add_text(v, "units", array->units, strlen(array->units));
  return status == FG_STATUS_OK && array->components > 1
             ? fg__dataset_split(data, array->components)
             : status;
}

/* The first piece speaks for all. */
static fg_status add_arrays(fg__dataset *data, const fg__vtk *vtk)
{
  const fg__vtk *file = fg__vtk_home(vtk, 0);
  fg_status status = FG_STATUS_OK;
  for (int place = FG__VTK_POINTS; place <= FG__VTK_CELLS && vtk->piece_count > 0;
       ++place)
    for (size_t n = 0; n < vtk->pieces[0].array_count && status == FG_STATUS_OK; ++n) {
      const fg__vtk_array *array = &file->arrays[vtk->pieces[0].first_array + n];
      if ((int)array->place == place)
        status = add_array(data, file, array);
    }
  return status;
}

/* Whether there are points alone, each a vertex. */
static bool are_scattered(const fg__topology *cells)
{
  enum { VERTEX = 1, SEVERAL_VERTICES = 2 };
  size_t c = 0;
  while (c < cells->cells &&
         (cells->type[c] == VERTEX || cells->type[c] == SEVERAL_VERTICES))
    ++c;
  return c > 0 && c == cells->cells;
}

static fg_status add_column(fg__dataset *data, const char *name, fg__type type, int array,
                            int component)
{
  fg__variable *v = fg__dataset_add_variable(data, "", name);
  if (!v)
    return FG_STATUS_MEMORY;
  v->type = type;
  v->rank = 1;
  v->dimension[0] = (int)data->dimension_count - 1;
  v->id = array;
  v->place = component;
  return FG_STATUS_OK;
}

/* Coordinates that differ. */
static fg_status add_places(fg__dataset *data)
{
  static const char *const names[] = {"x", "y", "z"};
  const fg__topology *cells = &data->space.cells;
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    const double *position = cells->position + k;
    size_t n = 1;
    while (n < cells->points && !(position[3 * n] < *position) &&
           !(position[3 * n] > *position))
      ++n;
    if (n < cells->points)
      status = add_column(data, names[k], FG__TYPE_FLOAT64, -1, k);
  }
  return status;
}

/* Points alone are columns as ParaView saves them in tables: a component of a vector U is
 * "U:0". */
static fg_status add_columns(fg__dataset *data, const fg__vtk *vtk)
{
  const fg__vtk *file = fg__vtk_home(vtk, 0);
  fg__dimension *points =
      fg__dataset_add_dimension(data, "point", data->space.cells.points);
  if (!points)
    return FG_STATUS_MEMORY;
  points->is_nameless = true;
  fg_status status = add_places(data);
  for (size_t n = 0; n < vtk->pieces[0].array_count; ++n) {
    const fg__vtk_array *array = &file->arrays[vtk->pieces[0].first_array + n];
    for (int c = 0;
         c < array->components && c < MOST_COLUMNS && array->place == FG__VTK_POINTS &&
         !array->no_velocity && status == FG_STATUS_OK;
         ++c) {
      char name[FG__NAME_BYTES];
      snprintf(name, sizeof name, array->components > 1 ? "%.400s:%d" : "%.400s",
               array->name, c);
      status = add_column(data, name, array->type, (int)n, c);
    }
  }
  return status;
}

fg_status fg__vtk_fill(fg__dataset *data, fg__vtk *vtk)
{
  fg_status status = FG_STATUS_OK;
  data->space.is_there = true;
  if (!fg__dataset_add_group(data))
    return FG_STATUS_MEMORY;
  if (vtk->kind != FG__VTK_ALONG_AXES)
    status = fg__vtk_read_cells(data, vtk);
  else
    status = fg__vtk_read_coordinates(vtk);
  data->space.on_axes = vtk->kind == FG__VTK_ALONG_AXES;
  if (status == FG_STATUS_OK && !data->space.on_axes &&
      are_scattered(&data->space.cells)) {
    data->space.is_there = false;
    return add_columns(data, vtk);
  }
  if (status == FG_STATUS_OK)
    status = add_dimensions(data, vtk);
  if (status == FG_STATUS_OK)
    status = add_arrays(data, vtk);
  if (status == FG_STATUS_OK && data->space.on_axes)
    status = add_axes(data, vtk);
  return status == FG_STATUS_OK ? fg__vtk_add_words(data, vtk) : status;
}
