/* The points and cells of a legacy VTK file. */
#include "decode/vtk/legacy_scan.h"

/* Adds an array of `count` numbers of a type, which begin on the next line. */
static fg_status take(size_t *out, fg__vtk *vtk, fg__legacy_cursor *c, const char *name,
                      const char *type, size_t count)
{
  fg__vtk_array *array;
  *out = vtk->array_count;
  fg_status status = fg__vtk_add_array(&array, vtk, name, FG__VTK_COORDINATES);
  return status == FG_STATUS_OK ? fg__legacy_take(c, array, type, count) : status;
}

/* COUNT TYPE, then x y z of each. */
fg_status fg__legacy_points(fg__vtk *vtk, fg__legacy_cursor *c)
{
  int count = 0;
  size_t expected, positions;
  char type[FG__LEGACY_WORD];
  fg_status status = fg__legacy_whole(c, &count, 1, "a number of points");
  if (status != FG_STATUS_OK)
    return status;
  if (!fg__legacy_word(c, type))
    return fg__legacy_fail(c, "no type of POINTS but", type);
  if (vtk->kind == FG__VTK_CURVILINEAR &&
      fg__vtk_count(&expected, vtk->extent, FG__VTK_POINTS) && (size_t)count != expected)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: POINTS of %d where DIMENSIONS say %zu", vtk->path, count,
                    expected);
  vtk->field_array_count = vtk->array_count;
  status = take(&positions, vtk, c, "points", type, 3 * (size_t)count);
  if (status == FG_STATUS_OK)
    status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  vtk->arrays[positions].components = 3;
  fg__vtk_piece *piece = &vtk->pieces[0];
  piece->positions = positions;
  piece->points = (size_t)count;
  return FG_STATUS_OK;
}

/* OFFSETS TYPE and CONNECTIVITY TYPE, of version 5.1. */
static fg_status take_with_offsets(fg__vtk *vtk, fg__vtk_list *list, fg__legacy_cursor *c,
                                   int ends, int corners)
{
  char word[FG__LEGACY_WORD], type[FG__LEGACY_WORD];
  fg_status status = FG_STATUS_OK;
  if (!fg__legacy_word(c, word) || !fg__legacy_word(c, type))
    return fg__legacy_fail(c, "no type of OFFSETS after", word);
  status = take(&list->ends, vtk, c, "offsets", type, (size_t)ends);
  if (status != FG_STATUS_OK)
    return status;
  if (!fg__legacy_word(c, word) || !fg__legacy_is(word, "CONNECTIVITY") ||
      !fg__legacy_word(c, type))
    return fg__legacy_fail(c, "no CONNECTIVITY but", word);
  list->cells = (size_t)ends - 1;
  list->end_numbers = (size_t)ends;
  list->corner_numbers = (size_t)corners;
  return take(&list->corners, vtk, c, "connectivity", type, (size_t)corners);
}

/* COUNT SIZE, then of each cell the number of its corners and these; since version 5.1
 * OFFSETS come first, one more than cells, and then what they part. */
static fg_status read_cells(fg__vtk *vtk, fg__legacy_cursor *c, int number, int type)
{
  int count = 0, size = 0;
  char word[FG__LEGACY_WORD];
  fg__vtk_list *list = &vtk->pieces[0].list[number];
  fg_status status = fg__legacy_whole(c, &count, type ? 0 : 1, "a number of cells");
  if (status == FG_STATUS_OK)
    status = fg__legacy_whole(c, &size, type ? 0 : 1, "a number of corners");
  if (status != FG_STATUS_OK)
    return status;
  list->type = type;
  fg__legacy_cursor ahead = *c;
  fg__legacy_skip_line(&ahead);
  if (count > 0 && fg__legacy_word_of_line(&ahead, word) &&
      fg__legacy_is(word, "OFFSETS")) {
    status = take_with_offsets(vtk, list, c, count, size);
  } else {
    list->cells = (size_t)count;
    list->corner_numbers = (size_t)size;
    status = take(&list->corners, vtk, c, "cells", "int", (size_t)size);
  }
  vtk->pieces[0].cells += list->cells;
  return status;
}

/* COUNT, then the type of each cell. */
static fg_status read_types(fg__vtk *vtk, fg__legacy_cursor *c)
{
  fg__vtk_list *list = &vtk->pieces[0].list[0];
  int count = 0;
  fg_status status = fg__legacy_whole(c, &count, 0, "a number of cells");
  if (status != FG_STATUS_OK)
    return status;
  if (list->corners == FG__VTK_NONE || (size_t)count != list->cells)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: CELL_TYPES of %d cells, CELLS of %zu", vtk->path, count,
                    list->corners == FG__VTK_NONE ? (size_t)0 : list->cells);
  return take(&list->types, vtk, c, "types", "int", (size_t)count);
}

fg_status fg__legacy_cells_line(fg__vtk *vtk, fg__legacy_cursor *cursor, bool polygons,
                                const char *keyword, bool *known)
{
  static const struct {
    const char *keyword;
    int type;
  } lists[FG__VTK_LISTS] = {
      {"VERTICES", 2}, {"LINES", 4}, {"POLYGONS", 7}, {"TRIANGLE_STRIPS", 6}};
  const fg__vtk_list *list = vtk->pieces[0].list;
  for (int k = 0; polygons && k < FG__VTK_LISTS; ++k)
    if (list[k].corners == FG__VTK_NONE && fg__legacy_is(keyword, lists[k].keyword))
      return read_cells(vtk, cursor, k, lists[k].type);
  if (!polygons && list->corners == FG__VTK_NONE && fg__legacy_is(keyword, "CELLS"))
    return read_cells(vtk, cursor, 0, 0);
  if (!polygons && list->types == FG__VTK_NONE && fg__legacy_is(keyword, "CELL_TYPES"))
    return read_types(vtk, cursor);
  *known = false;
  return FG_STATUS_OK;
}
