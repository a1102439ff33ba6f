#include "read/vtk/gather.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

fg__vtk_view fg__vtk_view_of(const fg__vtk *vtk, const fg__vtk_grid *grid,
                             fg__vtk_place place)
{
  fg__vtk_view out = {.vtk = vtk, .place = place, .grid = *grid};
  const int last = grid->dimension - 1, axis = grid->axis[last];
  const size_t points = grid->points[last], margin = place == FG__VTK_CELLS ? 1 : 0;
  const size_t end = grid->first_row + grid->rows + margin;
  const size_t first = grid->first_row > margin ? grid->first_row - margin : 0;
  memcpy(out.extent, vtk->extent, sizeof out.extent);
  out.skipped = grid->first_row - first;
  out.extent[2 * axis + 1] =
      vtk->extent[2 * axis] + (int)((end < points ? end : points) - 1);
  out.extent[2 * axis] += (int)first;
  out.grid.points[last] = (end < points ? end : points) - first;
  out.grid.first_row = first;
  out.grid.rows = out.grid.points[last];
  return out;
}

size_t fg__vtk_place_in_whole(const fg__vtk_view *v, size_t n)
{
  size_t length[3], whole[3], at[3];
  for (int k = 0; k < 3; ++k) {
    length[k] = fg__vtk_length(v->extent, k, v->place);
    whole[k] = fg__vtk_length(v->vtk->extent, k, v->place);
    at[k] = n % length[k] + (size_t)((int64_t)v->extent[2 * k] - v->vtk->extent[2 * k]);
    n /= length[k];
  }
  return (at[2] * whole[1] + at[1]) * whole[0] + at[0];
}

static fg_status find_in_piece(const fg__vtk_array **out, const fg__vtk *vtk,
                               const fg__vtk_gathering *wanted, size_t piece)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, piece, wanted->place, wanted->name);
  const fg__vtk_array *first = fg__vtk_find(vtk, 0, wanted->place, wanted->name);
  *out = array;
  if (vtk->merged && !array)
    return FG_STATUS_OK;
  if (!array || !first || array->components != first->components)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: piece %zu of %zu has no array \"%.100s\" like the first's",
                    vtk->path, piece + 1, vtk->piece_count, wanted->name);
  for (int c = 0; c < wanted->components; ++c)
    if (wanted->component[c] >= array->components)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: two arrays are named \"%.100s\", one of %d component%s",
                      vtk->path, wanted->name, array->components,
                      array->components == 1 ? "" : "s");
  return FG_STATUS_OK;
}

fg_status fg__vtk_gather_check(const fg__vtk *vtk, const fg__vtk_gathering *wanted)
{
  size_t stored_sum = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_array *array;
    size_t tuples, stored = 0;
    fg_status status = find_in_piece(&array, vtk, wanted, p);
    if (status != FG_STATUS_OK)
      return status;
    if (!fg__vtk_tuples(&tuples, vtk, &vtk->pieces[p], wanted->place))
      return FG_STATUS_FILE_FORMAT;
    if (!array)
      continue;
    status = fg__vtk_values_check(fg__vtk_home(vtk, p), array, tuples, &stored);
    if (status != FG_STATUS_OK)
      return status;
    if (stored > vtk->file_size - stored_sum)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the pieces of array \"%.100s\" overlap in the file", vtk->path,
                      wanted->name);
    stored_sum += stored;
  }
  return FG_STATUS_OK;
}

fg_status fg__vtk_gather_pieces(const fg__vtk *vtk, const fg__vtk_gathering *wanted)
{
  size_t to = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_array *array;
    fg__vtk_values values = {0};
    size_t tuples;
    fg_status status = find_in_piece(&array, vtk, wanted, p);
    if (status == FG_STATUS_OK &&
        !fg__vtk_tuples(&tuples, vtk, &vtk->pieces[p], wanted->place))
      status = FG_STATUS_FILE_FORMAT;
    if (status == FG_STATUS_OK && array)
      status = fg__vtk_values_create(&values, fg__vtk_home(vtk, p), array, tuples);
    if (status != FG_STATUS_OK)
      return status;
    for (size_t n = 0; n < tuples; ++n, ++to)
      for (int c = 0; c < wanted->components; ++c)
        wanted->out[c][to] =
            array
                ? wanted->means(fg__vtk_value(&values, n * (size_t)array->components +
                                                           (size_t)wanted->component[c]))
                : wanted->absent;
    fg__vtk_values_clear(&values);
  }
  return FG_STATUS_OK;
}

/* What a piece has of a view along each axis: [low, high) as the whole counts. */
typedef struct overlap {
  size_t first[3], length[3]; /* of the piece */
  size_t low[3], high[3];
  size_t origin[3], size[3]; /* of the view */
} overlap;

static overlap overlap_of(const fg__vtk_view *v, const int extent[6])
{
  overlap o;
  for (int k = 0; k < 3; ++k) {
    const int64_t zero = v->vtk->extent[2 * k];
    const size_t whole = fg__vtk_length(v->vtk->extent, k, v->place);
    o.length[k] = fg__vtk_length(extent, k, v->place);
    o.size[k] = fg__vtk_length(v->extent, k, v->place);
    o.first[k] = (size_t)(extent[2 * k] - zero);
    o.origin[k] = (size_t)(v->extent[2 * k] - zero);
    if (o.first[k] + o.length[k] > whole) /* a flat piece at the end of the cells */
      o.first[k] = whole - o.length[k];
    const size_t end = o.first[k] + o.length[k], view_end = o.origin[k] + o.size[k];
    o.low[k] = o.first[k] > o.origin[k] ? o.first[k] : o.origin[k];
    o.high[k] = end < view_end ? end : view_end;
  }
  return o;
}

static bool is_empty(const overlap *o)
{
  return o->low[0] >= o->high[0] || o->low[1] >= o->high[1] || o->low[2] >= o->high[2];
}

/* Number of a tuple in its piece. */
static size_t tuple_at(const overlap *o, size_t x, size_t y, size_t z)
{
  return ((z - o->first[2]) * o->length[1] + y - o->first[1]) * o->length[0] + x -
         o->first[0];
}

static void place_piece(const fg__vtk_gathering *wanted, const overlap *o,
                        const fg__vtk_values *values, int stride, unsigned char *seen)
{
  for (size_t z = o->low[2]; z < o->high[2]; ++z)
    for (size_t y = o->low[1]; y < o->high[1]; ++y) {
      size_t from = tuple_at(o, o->low[0], y, z);
      size_t to = ((z - o->origin[2]) * o->size[1] + y - o->origin[1]) * o->size[0] +
                  o->low[0] - o->origin[0];
      for (size_t x = o->low[0]; x < o->high[0]; ++x, ++from, ++to) {
        seen[to] = 1;
        for (int c = 0; c < wanted->components; ++c)
          wanted->out[c][to] = wanted->means(fg__vtk_value(
              values, from * (size_t)stride + (size_t)wanted->component[c]));
      }
    }
}

/* Reads what a piece has of the view: in one go, or plane by plane where each plane has
 * some rows of it only. */
static fg_status gather_piece(const fg__vtk_view *v, const fg__vtk_gathering *wanted,
                              size_t piece, unsigned char *seen)
{
  const fg__vtk_array *array;
  fg_status status = find_in_piece(&array, v->vtk, wanted, piece);
  const int *extent = v->vtk->pieces[piece].extent;
  const overlap all = overlap_of(v, extent);
  size_t tuples;
  if (status != FG_STATUS_OK || is_empty(&all) ||
      !fg__vtk_count(&tuples, extent, wanted->place))
    return status;
  const bool by_plane = all.high[1] - all.low[1] < all.length[1];
  for (size_t z = all.low[2]; z < all.high[2] && status == FG_STATUS_OK;) {
    overlap some = all;
    some.low[2] = z;
    some.high[2] = by_plane ? z + 1 : all.high[2];
    fg__vtk_values values = {0};
    status = fg__vtk_values_create_some(
        &values, fg__vtk_home(v->vtk, piece), array, tuples,
        tuple_at(&some, some.low[0], some.low[1], some.low[2]),
        tuple_at(&some, some.high[0] - 1, some.high[1] - 1, some.high[2] - 1) + 1);
    if (status == FG_STATUS_OK)
      place_piece(wanted, &some, &values, array->components, seen);
    fg__vtk_values_clear(&values);
    z = some.high[2];
  }
  return status;
}

fg_status fg__vtk_gather(const fg__vtk_view *v, const fg__vtk_gathering *wanted)
{
  const fg__vtk *vtk = v->vtk;
  size_t count, all;
  if (!fg__vtk_count(&count, v->extent, wanted->place) ||
      !fg__vtk_count(&all, vtk->extent, wanted->place))
    return FG_STATUS_FILE_FORMAT;
  unsigned char *seen = fg__allocate(count, 1);
  if (!seen)
    return fg__fail_memory(vtk->context, "a field's samples", count);
  fg_status status = FG_STATUS_OK;
  for (size_t p = 0; p < vtk->piece_count && status == FG_STATUS_OK; ++p)
    status = gather_piece(v, wanted, p, seen);
  const unsigned char *hole = status == FG_STATUS_OK ? memchr(seen, 0, count) : NULL;
  if (hole)
    status =
        fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                 "%s: the %zu pieces do not cover the whole: sample %zu of %zu is in "
                 "none",
                 vtk->path, vtk->piece_count,
                 fg__vtk_place_in_whole(v, (size_t)(hole - seen)), all);
  free(seen);
  return status;
}
