/* The parts of a VTK file, whichever way they were found. */
#include "format/vtk.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/tree.h>

/* More arrays in a piece than any program writes; names are compared each with each. */
enum { ARRAYS_MAX = 1000 };

fg_status fg__vtk_add_array(fg__vtk_array **out, fg__vtk *vtk, const char *name,
                            fg__vtk_place place)
{
  void *arrays = vtk->arrays;
  if (!fg__grow(&arrays, &vtk->array_capacity, vtk->array_count + 1, sizeof *vtk->arrays))
    return fg__fail_memory(vtk->context, "a list of arrays", vtk->array_count);
  vtk->arrays = arrays;
  fg__vtk_array *array = &vtk->arrays[vtk->array_count++];
  *array = (fg__vtk_array){.place = place, .components = 1};
  array->name = fg__copy_text(name);
  if (!array->name)
    return fg__fail_memory(vtk->context, "an array's name", strlen(name) + 1);
  *out = array;
  return FG_STATUS_OK;
}

fg_status fg__vtk_add_piece(fg__vtk *vtk, const int extent[6])
{
  void *pieces = vtk->pieces;
  if (!fg__grow(&pieces, &vtk->piece_capacity, vtk->piece_count + 1, sizeof *vtk->pieces))
    return fg__fail_memory(vtk->context, "a list of pieces", vtk->piece_count);
  vtk->pieces = pieces;
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count++];
  *piece = (fg__vtk_piece){.first_array = vtk->array_count};
  memcpy(piece->extent, extent, sizeof piece->extent);
  return FG_STATUS_OK;
}

fg_status fg__vtk_end_piece(fg__vtk *vtk)
{
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  piece->array_count = vtk->array_count - piece->first_array;
  if (piece->array_count > ARRAYS_MAX)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu arrays; at most %d can be read", vtk->path,
                    piece->array_count, ARRAYS_MAX);
  return FG_STATUS_OK;
}

void fg__vtk_close(fg__vtk *vtk)
{
  for (size_t i = 0; i < vtk->array_count; ++i) {
    free(vtk->arrays[i].name);
    free(vtk->arrays[i].units);
    free(vtk->arrays[i].joined_text);
  }
  for (int k = 0; k < 3; ++k)
    free(vtk->coordinate[k]);
  free(vtk->arrays);
  free(vtk->pieces);
  free(vtk->vectors[0]);
  free(vtk->vectors[1]);
  free(vtk->compressor);
  fg__cell_set_clear(&vtk->cells);
  if (vtk->document)
    xmlFreeDoc(vtk->document);
  *vtk = (fg__vtk){0};
}

const fg__vtk_array *fg__vtk_find(const fg__vtk *vtk, size_t piece, fg__vtk_place place,
                                  const char *name)
{
  size_t first = 0, count = vtk->field_array_count;
  if (place != FG__VTK_FIELD) {
    if (piece >= vtk->piece_count)
      return NULL;
    first = vtk->pieces[piece].first_array;
    count = vtk->pieces[piece].array_count;
  }
  for (size_t i = first; i < first + count; ++i)
    if (vtk->arrays[i].place == place && strcmp(vtk->arrays[i].name, name) == 0)
      return &vtk->arrays[i];
  return NULL;
}

size_t fg__vtk_length(const int extent[6], int axis, fg__vtk_place place)
{
  size_t intervals = (size_t)((int64_t)extent[2 * axis + 1] - (int64_t)extent[2 * axis]);
  if (place == FG__VTK_CELLS)
    return intervals > 0 ? intervals : 1;
  return intervals + 1;
}

bool fg__vtk_count(size_t *count, const int extent[6], fg__vtk_place place)
{
  *count = 1;
  for (int k = 0; k < 3; ++k) {
    size_t length = fg__vtk_length(extent, k, place);
    if (length > (size_t)INT_MAX / *count)
      return false;
    *count *= length;
  }
  return true;
}

/* Every piece's coordinates must be there, and no byte may serve two: then the whole axis
 * is no longer than the file can fill. */
static fg_status check_coordinates(const fg__vtk *vtk, int axis)
{
  size_t whole = fg__vtk_length(vtk->extent, axis, FG__VTK_POINTS), sum = 0, bytes = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_piece *piece = &vtk->pieces[p];
    const fg__vtk_array *array = &vtk->arrays[piece->coordinates + (size_t)axis];
    size_t length = fg__vtk_length(piece->extent, axis, FG__VTK_POINTS), stored = 0;
    fg_status status = fg__vtk_values_check(vtk, array, length, &stored);
    if (status != FG_STATUS_OK)
      return status;
    if (array->components != 1 || stored > vtk->file_size - bytes)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the coordinates along %c of piece %zu are %s", vtk->path,
                      "xyz"[axis], p + 1,
                      array->components != 1 ? "vectors" : "those of another piece");
    bytes += stored;
    sum += length;
  }
  if (sum < whole)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: %zu coordinates along %c for %zu points", vtk->path, sum,
                    "xyz"[axis], whole);
  return FG_STATUS_OK;
}

static fg_status read_axis(fg__vtk *vtk, int axis)
{
  size_t whole = fg__vtk_length(vtk->extent, axis, FG__VTK_POINTS);
  double *out = vtk->coordinate[axis] = fg__allocate(whole, sizeof *out);
  if (!out)
    return fg__fail_memory(vtk->context, "an axis", whole * sizeof *out);
  for (size_t i = 0; i < whole; ++i)
    out[i] = (double)NAN;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_piece *piece = &vtk->pieces[p];
    size_t length = fg__vtk_length(piece->extent, axis, FG__VTK_POINTS);
    fg__vtk_values values;
    fg_status status = fg__vtk_values_create(
        &values, vtk, &vtk->arrays[piece->coordinates + (size_t)axis], length);
    if (status != FG_STATUS_OK)
      return status;
    double *first = out + ((int64_t)piece->extent[2 * axis] - vtk->extent[2 * axis]);
    for (size_t i = 0; i < length; ++i)
      first[i] = fg__vtk_value(&values, i);
    fg__vtk_values_clear(&values);
  }
  for (size_t i = 0; i < whole; ++i)
    if (!isfinite(out[i]))
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: coordinate %zu of %zu along %c is missing or no number",
                      vtk->path, i, whole, "xyz"[axis]);
  return FG_STATUS_OK;
}

bool fg__vtk_tuples(size_t *count, const fg__vtk *vtk, const fg__vtk_piece *piece,
                    fg__vtk_place place)
{
  if (vtk->kind != FG__VTK_UNSTRUCTURED)
    return fg__vtk_count(count, piece->extent, place);
  *count = place == FG__VTK_CELLS ? piece->cells : piece->points;
  return true;
}

fg_status fg__vtk_read_coordinates(fg__vtk *vtk)
{
  if (vtk->kind != FG__VTK_ALONG_AXES)
    return fg__vtk_read_cells(vtk);
  for (int k = 0; k < 3 && vtk->uneven; ++k) {
    fg_status status = check_coordinates(vtk, k);
    if (status == FG_STATUS_OK)
      status = read_axis(vtk, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

double fg__vtk_coordinate(const fg__vtk *vtk, int axis, size_t i)
{
  if (vtk->coordinate[axis])
    return vtk->coordinate[axis][i];
  return vtk->origin[axis] +
         vtk->spacing[axis] * ((double)vtk->extent[2 * axis] + (double)i);
}
