/* The parts of a VTK file, from XML or legacy text. */
#include "decode/vtk/vtk.h"

#include "base/memory.h"
#include "base/utf8.h"

#include <limits.h>
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
  array->name = fg__utf8_copy(name);
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
  *piece = (fg__vtk_piece){.first_array = vtk->array_count, .positions = FG__VTK_NONE};
  for (int k = 0; k < FG__VTK_LISTS; ++k)
    piece->list[k] =
        (fg__vtk_list){.corners = FG__VTK_NONE,
                       .types = FG__VTK_NONE,
                       .ends = FG__VTK_NONE,
                       .faces = FG__VTK_NONE,
                       .face_ends = FG__VTK_NONE,
                       .apart = {FG__VTK_NONE, FG__VTK_NONE, FG__VTK_NONE, FG__VTK_NONE}};
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

fg_status fg__vtk_check(const fg__vtk *vtk, fg_status status)
{
  for (size_t i = 0; i < vtk->file_count; ++i) {
    const fg__source *source = &vtk->files[i].source;
    status = fg__source_check(vtk->context, status, source->path, source->size);
  }
  return status;
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
  for (size_t i = 0; i < vtk->file_count; ++i) {
    fg__vtk_file *file = &vtk->files[i];
    if (file->vtk)
      fg__vtk_close(file->vtk);
    free(file->vtk);
    (void)fg__source_close(&file->source, NULL, FG_STATUS_OK);
    free(file->path);
  }
  free(vtk->files);
  fg__vtk_values_clear(&vtk->kept);
  if (vtk->held)
    vtk->close_held(vtk->held);
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
  const fg__vtk_array *arrays =
      (place == FG__VTK_FIELD ? vtk : fg__vtk_home(vtk, piece))->arrays;
  for (size_t i = first; i < first + count; ++i)
    if (arrays[i].place == place && strcmp(arrays[i].name, name) == 0)
      return &arrays[i];
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

bool fg__vtk_tuples(size_t *count, const fg__vtk *vtk, const fg__vtk_piece *piece,
                    fg__vtk_place place)
{
  if ((piece->file ? piece->file : vtk)->kind != FG__VTK_UNSTRUCTURED)
    return fg__vtk_count(count, piece->extent, place);
  *count = place == FG__VTK_CELLS ? piece->cells : piece->points;
  return true;
}

double fg__vtk_coordinate(const fg__vtk *vtk, int axis, size_t i)
{
  if (vtk->coordinate[axis])
    return vtk->coordinate[axis][i];
  return vtk->origin[axis] +
         vtk->spacing[axis] * ((double)vtk->extent[2 * axis] + (double)i);
}

fg_status fg__vtk_check_pieces(const fg__vtk *vtk)
{
  size_t whole, sum = 0;
  if (vtk->kind == FG__VTK_UNSTRUCTURED)
    return FG_STATUS_OK;
  if (!fg__vtk_count(&whole, vtk->extent, FG__VTK_CELLS))
    return FG_STATUS_FILE_FORMAT;
  for (size_t p = 0; p < vtk->piece_count && sum < whole; ++p) {
    size_t cells;
    if (!fg__vtk_count(&cells, vtk->pieces[p].extent, FG__VTK_CELLS))
      return FG_STATUS_FILE_FORMAT;
    sum += cells;
  }
  if (sum < whole)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: its %zu pieces have %zu cells, the whole %zu", vtk->path,
                    vtk->piece_count, sum, whole);
  return FG_STATUS_OK;
}
