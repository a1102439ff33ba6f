/* Numbers of an array that lies in pieces all over a file, or in several. */
#include "decode/vtk/vtk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* A component of an array, and which of its numbers are wanted. */
typedef struct wanted_numbers {
  fg__vtk *vtk;
  const char *name;
  fg__vtk_place place;
  size_t component;
  size_t origin[3], size[3]; /* along x, y, z */
  double *out;
} wanted_numbers;

static fg_status find_in_piece(const fg__vtk_array **out, const wanted_numbers *w,
                               size_t piece)
{
  const fg__vtk *vtk = w->vtk;
  const fg__vtk_array *array = fg__vtk_find(vtk, piece, w->place, w->name);
  const fg__vtk_array *first = fg__vtk_find(vtk, 0, w->place, w->name);
  *out = array;
  if (vtk->merged && !array)
    return FG_STATUS_OK;
  if (!array || !first || array->components != first->components)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: piece %zu of %zu has no array \"%.100s\" like the first's",
                    vtk->path, piece + 1, vtk->piece_count, w->name);
  if (w->component >= (size_t)array->components)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: two arrays are named \"%.100s\", one of %d component%s",
                    vtk->path, w->name, array->components,
                    array->components == 1 ? "" : "s");
  return FG_STATUS_OK;
}

/* Every piece must be there with all its bytes, and no byte may serve two pieces: then
 * the whole is no larger than the file can fill. */
static fg_status check_pieces(const wanted_numbers *w)
{
  fg__vtk *vtk = w->vtk;
  size_t stored_sum = 0;
  if (vtk->checked == w->name && vtk->checked_at == w->place)
    return FG_STATUS_OK;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_array *array;
    size_t tuples, stored = 0;
    fg_status status = find_in_piece(&array, w, p);
    if (status != FG_STATUS_OK)
      return status;
    if (!fg__vtk_tuples(&tuples, vtk, &vtk->pieces[p], w->place))
      return FG_STATUS_FILE_FORMAT;
    if (!array)
      continue;
    status = fg__vtk_values_check(fg__vtk_home(vtk, p), array, tuples, &stored);
    if (status != FG_STATUS_OK)
      return status;
    if (stored > vtk->file_size - stored_sum)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the pieces of array \"%.100s\" overlap in the file", vtk->path,
                      w->name);
    stored_sum += stored;
  }
  vtk->checked = w->name;
  vtk->checked_at = w->place;
  return FG_STATUS_OK;
}

/* Keeps tuples [first, end) of a piece's array: another component of them may be fetched
 * next. Of text all are kept, since it is read through in any case. */
static fg_status keep(fg__vtk *vtk, size_t piece, const fg__vtk_array *array,
                      size_t tuples, size_t first, size_t end)
{
  fg__vtk_values *kept = &vtk->kept;
  const size_t components = (size_t)array->components;
  const bool whole = fg__vtk_is_read_whole(array);
  if (vtk->kept_of == array && kept->first <= first * components &&
      kept->first + kept->count >= end * components)
    return FG_STATUS_OK;
  fg__vtk_values_clear(kept);
  vtk->kept_of = NULL;
  const fg_status status =
      fg__vtk_values_create_some(kept, fg__vtk_home(vtk, piece), array, tuples,
                                 whole ? 0 : first, whole ? tuples : end);
  if (status == FG_STATUS_OK)
    vtk->kept_of = array;
  return status;
}

/* Of lists, piece after piece; NaN where a grid among several has no such array. */
static fg_status fetch_listed(const wanted_numbers *w)
{
  fg__vtk *vtk = w->vtk;
  const size_t first = w->origin[0], end = first + w->size[0];
  size_t at = 0;
  for (size_t p = 0; p < vtk->piece_count && at < end; ++p) {
    const fg__vtk_array *array;
    size_t tuples;
    fg_status status = find_in_piece(&array, w, p);
    if (status == FG_STATUS_OK &&
        !fg__vtk_tuples(&tuples, vtk, &vtk->pieces[p], w->place))
      status = FG_STATUS_FILE_FORMAT;
    if (status != FG_STATUS_OK)
      return status;
    const size_t from = first > at ? first - at : 0;
    const size_t to = end - at < tuples ? end - at : tuples;
    if (from < to && array)
      status = keep(vtk, p, array, tuples, from, to);
    if (status != FG_STATUS_OK)
      return status;
    for (size_t n = from; n < to; ++n)
      w->out[at + n - first] =
          array ? fg__vtk_value(&vtk->kept, n * (size_t)array->components + w->component)
                : (double)NAN;
    at += tuples;
  }
  return FG_STATUS_OK;
}

/* What a piece has of the wanted box along each axis: [low, high) as the whole counts. */
typedef struct overlap {
  size_t first[3], length[3]; /* of the piece */
  size_t low[3], high[3];
} overlap;

static overlap overlap_of(const wanted_numbers *w, const int extent[6])
{
  overlap o;
  for (int k = 0; k < 3; ++k) {
    const size_t whole = fg__vtk_length(w->vtk->extent, k, w->place);
    o.length[k] = fg__vtk_length(extent, k, w->place);
    o.first[k] = (size_t)((int64_t)extent[2 * k] - w->vtk->extent[2 * k]);
    if (o.first[k] + o.length[k] > whole) /* a flat piece at the end of the cells */
      o.first[k] = whole - o.length[k];
    const size_t end = o.first[k] + o.length[k], wanted = w->origin[k] + w->size[k];
    o.low[k] = o.first[k] > w->origin[k] ? o.first[k] : w->origin[k];
    o.high[k] = end < wanted ? end : wanted;
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

static void place_piece(const wanted_numbers *w, const overlap *o, size_t components,
                        unsigned char *seen)
{
  for (size_t z = o->low[2]; z < o->high[2]; ++z)
    for (size_t y = o->low[1]; y < o->high[1]; ++y) {
      size_t from = tuple_at(o, o->low[0], y, z) * components + w->component;
      size_t to = ((z - w->origin[2]) * w->size[1] + y - w->origin[1]) * w->size[0] +
                  o->low[0] - w->origin[0];
      for (size_t x = o->low[0]; x < o->high[0]; ++x, from += components, ++to) {
        seen[to] = 1;
        w->out[to] = fg__vtk_value(&w->vtk->kept, from);
      }
    }
}

/* Reads what a piece has of the box: in one go, or plane by plane where each plane has
 * some rows of it only. */
static fg_status fetch_from_piece(const wanted_numbers *w, size_t piece,
                                  unsigned char *seen)
{
  const fg__vtk_array *array;
  fg_status status = find_in_piece(&array, w, piece);
  const int *extent = w->vtk->pieces[piece].extent;
  const overlap all = overlap_of(w, extent);
  size_t tuples;
  if (status != FG_STATUS_OK || is_empty(&all) ||
      !fg__vtk_count(&tuples, extent, w->place))
    return status;
  const bool by_plane = all.high[1] - all.low[1] < all.length[1];
  for (size_t z = all.low[2]; z < all.high[2] && status == FG_STATUS_OK;) {
    overlap some = all;
    some.low[2] = z;
    some.high[2] = by_plane ? z + 1 : all.high[2];
    status =
        keep(w->vtk, piece, array, tuples,
             tuple_at(&some, some.low[0], some.low[1], some.low[2]),
             tuple_at(&some, some.high[0] - 1, some.high[1] - 1, some.high[2] - 1) + 1);
    if (status == FG_STATUS_OK)
      place_piece(w, &some, (size_t)array->components, seen);
    z = some.high[2];
  }
  return status;
}

static fg_status fail_hole(const wanted_numbers *w, size_t n)
{
  const fg__vtk *vtk = w->vtk;
  size_t whole[3], at[3], all;
  for (int k = 0; k < 3; ++k) {
    whole[k] = fg__vtk_length(vtk->extent, k, w->place);
    const size_t size = w->size[k] > 0 ? w->size[k] : 1;
    at[k] = w->origin[k] + n % size;
    n /= size;
  }
  fg__vtk_count(&all, vtk->extent, w->place);
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                  "%s: the %zu pieces do not cover the whole: sample %zu of %zu is in "
                  "none",
                  vtk->path, vtk->piece_count,
                  (at[2] * whole[1] + at[1]) * whole[0] + at[0], all);
}

/* Of a grid along axes: each number must be in a piece. */
static fg_status fetch_box(const wanted_numbers *w)
{
  const size_t count = w->size[0] * w->size[1] * w->size[2];
  unsigned char *seen = fg__allocate(count, 1);
  if (!seen)
    return fg__fail_memory(w->vtk->context, "a field's samples", count);
  fg_status status = FG_STATUS_OK;
  for (size_t p = 0; p < w->vtk->piece_count && status == FG_STATUS_OK; ++p)
    status = fetch_from_piece(w, p, seen);
  const unsigned char *hole = status == FG_STATUS_OK ? memchr(seen, 0, count) : NULL;
  if (hole)
    status = fail_hole(w, (size_t)(hole - seen));
  free(seen);
  return status;
}

/* Of points alone: their coordinates, or an array's component. */
static fg_status fetch_column(const fg__variable *v, fg__vtk *vtk, size_t start,
                              size_t count, double *out)
{
  const fg__vtk_piece *first = &vtk->pieces[0];
  if (v->id < 0) {
    for (size_t n = 0; n < count; ++n)
      out[n] = v->owner->space.cells.position[3 * (start + n) + (size_t)v->place];
    return FG_STATUS_OK;
  }
  const wanted_numbers w = {
      .vtk = vtk,
      .name = fg__vtk_home(vtk, 0)->arrays[first->first_array + (size_t)v->id].name,
      .place = FG__VTK_POINTS,
      .component = (size_t)v->place,
      .origin = {start},
      .size = {count},
      .out = out};
  const fg_status status = check_pieces(&w);
  return status == FG_STATUS_OK ? fetch_listed(&w) : status;
}

fg_status fg__vtk_fetch(const fg__variable *variable, const size_t *start,
                        const size_t *count, double *out)
{
  const fg__dataset *data = variable->owner;
  fg__vtk *vtk = data->file[variable->file].state;
  if (!data->space.is_there)
    return fetch_column(variable, vtk, start[0], count[0], out);
  if (variable->location == FG__ON_GRID) {
    for (size_t i = 0; i < count[0]; ++i)
      out[i] = fg__vtk_coordinate(vtk, variable->id, start[0] + i);
    return FG_STATUS_OK;
  }
  wanted_numbers w = {
      .vtk = vtk,
      .name = variable->name,
      .place = variable->location == FG__OF_CELLS ? FG__VTK_CELLS : FG__VTK_POINTS,
      .component = variable->element > 0 ? (size_t)variable->element - 1 : 0,
      .out = out};
  for (int k = 0; k < variable->rank && k < 3; ++k) {
    w.origin[k] = start[variable->rank - 1 - k];
    w.size[k] = count[variable->rank - 1 - k];
  }
  const fg_status status = check_pieces(&w);
  if (status != FG_STATUS_OK)
    return status;
  return data->space.on_axes ? fetch_box(&w) : fetch_listed(&w);
}
