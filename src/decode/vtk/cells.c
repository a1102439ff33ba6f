/* The points and cells of curvilinear and unstructured VTK grids. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "decode/vtk/vtk.h"

/* An array's numbers. */
typedef struct numbers {
  double *of;
  size_t count;
} numbers;

/* Which numbers are the corners of the cells, one after the other. */
typedef struct cell_list {
  numbers corners, types, ends;
  numbers faces, face_ends; /* of polyhedra, none else */
  size_t at, end;           /* of the cell's among the corners */
  size_t face_at;           /* where those of the next one begin */
  size_t per_cell;          /* corners, where each cell has as many */
  size_t first_end; /* in `ends`: 1 where these begin with the first cell's beginning */
} cell_list;

static bool is_polyhedron(double type)
{
  return type >= FG__POLYHEDRON && type <= FG__POLYHEDRON;
}

/* Finds the corners of a cell: each begins with their number, or `ends` says. */
static fg_status next_cell(cell_list *t, const fg__vtk *vtk, size_t cell)
{
  double end = -1.0;
  t->at = t->end;
  if (t->per_cell > 0) {
    end = (double)(t->at + t->per_cell);
  } else if (t->ends.of) {
    end = t->ends.of[cell + t->first_end];
  } else if (t->at < t->corners.count) {
    end = t->corners.of[t->at++];
    end = end >= 0.0 ? end + (double)t->at : -1.0;
  }
  if (!(end >= (double)t->at && end <= (double)t->corners.count))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: the corners of cell %zu are not within those %zu that there are",
                    vtk->path, cell, t->corners.count);
  t->end = (size_t)end;
  return FG_STATUS_OK;
}

static fg_status add_cell(fg__dataset *data, const fg__vtk *vtk, cell_list *t,
                          size_t cell, double type, const fg__piece_points *points)
{
  const size_t face = t->face_at;
  if (t->faces.count > 0 && is_polyhedron(type)) {
    const double last = t->face_ends.of[cell];
    if (!(last >= (double)face && last <= (double)t->faces.count))
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the faces of cell %zu are not within those %zu numbers that "
                      "there are",
                      vtk->path, cell, t->faces.count);
    t->face_at = (size_t)last;
  }
  return fg__topology_add(
      data, type >= 0.0 && type <= 255.0 && floor(type) >= type ? (int)type : 255,
      t->corners.of + t->at, t->end - t->at, t->faces.of ? t->faces.of + face : NULL,
      t->face_at - face, points);
}

/* Reads an array of a piece that no other may share bytes with: *room is what the file
 * still has for such. */
static fg_status read_own(numbers *out, const fg__vtk *vtk, size_t array, size_t tuples,
                          size_t *room)
{
  if (array >= vtk->array_count)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: a piece lacks an array",
                    vtk->path);
  size_t stored = 0;
  fg_status status = fg__vtk_values_check(vtk, &vtk->arrays[array], tuples, &stored);
  if (status == FG_STATUS_OK && stored > *room)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the pieces' arrays \"%.100s\" overlap in the file", vtk->path,
                      vtk->arrays[array].name);
  if (status != FG_STATUS_OK)
    return status;
  *room -= stored;
  out->count = tuples * (size_t)vtk->arrays[array].components;
  out->of = fg__allocate(out->count, sizeof *out->of);
  return out->of ? fg__vtk_read_numbers(out->of, vtk, &vtk->arrays[array], tuples)
                 : fg__fail_memory(vtk->context, "an array of the file", out->count * 8);
}

/* How many corners an XML piece has is what the last end says. */
static fg_status find_corner_count(size_t *out, const fg__vtk *file,
                                   const fg__vtk_list *list, const numbers *ends)
{
  *out = list->corner_numbers;
  if (*out > 0)
    return FG_STATUS_OK;
  const double last = ends->of && ends->count > 0 ? ends->of[ends->count - 1] : 0.0;
  if (!(last >= 0.0 && last <= INT_MAX))
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: a piece's cells have %g corners", file->path, last);
  *out = (size_t)last;
  return FG_STATUS_OK;
}

/* Reads as many numbers of an array as the largest of `ends` says. */
static fg_status read_up_to(numbers *out, const fg__vtk *file, size_t array,
                            const numbers *ends, double more, size_t *room)
{
  double most = 0.0;
  for (size_t i = 0; i < ends->count; ++i)
    most = fmax(most, ends->of[i] + more);
  if (!(most >= 1.0 && most <= INT_MAX))
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: a piece's polyhedra have %g numbers of faces", file->path, most);
  return read_own(out, file, array, (size_t)most, room);
}

/* Numbers [from, to) of which `all` there are; false where they are not. */
static bool is_part(size_t part[2], double from, double to, size_t all)
{
  if (!(from >= 0.0 && to >= from && to <= (double)all))
    return false;
  part[0] = (size_t)from;
  part[1] = (size_t)to;
  return true;
}

/* Adds a face that is apart to `faces`; false where it is not there, or where faces have
 * had more points than twice all: a face is that of two cells at most. */
static bool add_face(numbers *faces, size_t *used, const numbers of[4], double number)
{
  size_t corners[2];
  if (!(number >= 0.0 && number < (double)of[1].count))
    return false;
  const size_t f = (size_t)number;
  if (!is_part(corners, f > 0 ? of[1].of[f - 1] : 0.0, of[1].of[f], of[0].count))
    return false;
  const size_t count = corners[1] - corners[0];
  *used += count;
  if (*used > 2 * of[0].count)
    return false;
  faces->of[faces->count++] = (double)count;
  memcpy(faces->of + faces->count, of[0].of + corners[0], count * sizeof *faces->of);
  faces->count += count;
  return true;
}

/* Brings faces that are apart, `of` in the order of list->apart, into those of each
 * polyhedron. */
static fg_status join_faces(cell_list *t, const fg__vtk *file, const numbers of[4])
{
  const size_t cells = of[3].count, room = 2 * of[0].count + of[2].count + cells;
  t->faces.of = fg__allocate(room, sizeof *t->faces.of);
  t->face_ends.of = fg__allocate(cells, sizeof *t->face_ends.of);
  if (!t->faces.of || !t->face_ends.of)
    return fg__fail_memory(file->context, "faces", (room + cells) * sizeof(double));
  size_t used = 0, part[2] = {0, 0};
  for (size_t c = 0; c < cells; ++c) {
    bool good = is_part(part, (double)part[1], of[3].of[c], of[2].count);
    if (good && part[1] > part[0])
      t->faces.of[t->faces.count++] = (double)(part[1] - part[0]);
    for (size_t i = part[0]; good && i < part[1]; ++i)
      good = add_face(&t->faces, &used, of, of[2].of[i]);
    if (!good)
      return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                      "%s: the faces of cell %zu, a polyhedron, are not within those %zu "
                      "that there are, or are those of more than one other",
                      file->path, c, of[1].count);
    t->face_ends.of[c] = (double)t->faces.count;
  }
  return FG_STATUS_OK;
}

static fg_status read_apart(cell_list *t, const fg__vtk *file, const fg__vtk_list *list,
                            size_t *room)
{
  numbers of[4] = {{0}};
  fg_status status = read_own(&of[3], file, list->apart[3], list->cells, room);
  for (int k = 2; k >= 0 && status == FG_STATUS_OK; --k)
    status =
        read_up_to(&of[k], file, list->apart[k], &of[k + 1], k == 1 ? 1.0 : 0.0, room);
  if (status == FG_STATUS_OK)
    status = join_faces(t, file, of);
  for (int k = 0; k < 4; ++k)
    free(of[k].of);
  return status;
}

/* Reads what a list says of its polyhedra, if it has any. */
static fg_status read_faces(cell_list *t, const fg__vtk *file, const fg__vtk_list *list,
                            size_t *room)
{
  bool some = false, apart = true;
  for (size_t c = 0; c < t->types.count; ++c)
    some = some || is_polyhedron(t->types.of[c]);
  for (int k = 0; k < 4; ++k)
    apart = apart && list->apart[k] != FG__VTK_NONE;
  if (some && apart)
    return read_apart(t, file, list, room);
  if (!some || list->faces == FG__VTK_NONE || list->face_ends == FG__VTK_NONE)
    return FG_STATUS_OK;
  fg_status status = read_own(&t->face_ends, file, list->face_ends, list->cells, room);
  return status == FG_STATUS_OK
             ? read_up_to(&t->faces, file, list->faces, &t->face_ends, 0.0, room)
             : status;
}

static fg_status read_list(fg__dataset *data, const fg__vtk *file,
                           const fg__vtk_list *list, const fg__piece_points *points,
                           size_t *room)
{
  cell_list t = {.per_cell = list->per_cell,
                 .first_end = list->end_numbers > list->cells ? 1 : 0};
  size_t corners = 0;
  fg_status status = FG_STATUS_OK;
  if (list->types != FG__VTK_NONE)
    status = read_own(&t.types, file, list->types, list->cells, room);
  if (status == FG_STATUS_OK && list->ends != FG__VTK_NONE)
    status = read_own(&t.ends, file, list->ends,
                      list->end_numbers > 0 ? list->end_numbers : list->cells, room);
  if (status == FG_STATUS_OK)
    status = find_corner_count(&corners, file, list, &t.ends);
  if (status == FG_STATUS_OK)
    status = read_own(&t.corners, file, list->corners, corners, room);
  if (status == FG_STATUS_OK)
    status = read_faces(&t, file, list, room);
  for (size_t c = 0; c < list->cells && status == FG_STATUS_OK; ++c) {
    status = next_cell(&t, file, c);
    if (status == FG_STATUS_OK)
      status =
          add_cell(data, file, &t, c, t.types.of ? t.types.of[c] : list->type, points);
  }
  free(t.types.of);
  free(t.ends.of);
  free(t.corners.of);
  free(t.faces.of);
  free(t.face_ends.of);
  return status;
}

static fg_status read_listed(fg__dataset *data, const fg__vtk *file,
                             const fg__vtk_piece *piece, const fg__piece_points *points,
                             size_t *room)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < FG__VTK_LISTS && status == FG_STATUS_OK; ++k)
    if (piece->list[k].cells > 0)
      status = read_list(data, file, &piece->list[k], points, room);
  return status;
}

/* The cells between the points of a grid. */
static fg_status add_implied(fg__dataset *data, const fg__vtk_piece *piece,
                             const fg__piece_points *points)
{
  enum { QUAD = 9, HEXAHEDRON = 12 };
  size_t length[3], cells[3], step[3] = {1, 0, 0}, wide[3];
  int dimension = 0;
  for (int k = 0; k < 3; ++k) {
    length[k] = fg__vtk_length(piece->extent, k, FG__VTK_POINTS);
    cells[k] = fg__vtk_length(piece->extent, k, FG__VTK_CELLS);
    if (k > 0)
      step[k] = step[k - 1] * length[k - 1];
    if (length[k] > 1)
      wide[dimension++] = step[k];
  }
  if (dimension < 2)
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    "%s: a line of %zu x %zu x %zu points; a field needs two directions",
                    data->file[0].path, length[0], length[1], length[2]);
  for (size_t n = 0; n < cells[0] * cells[1] * cells[2]; ++n) {
    const size_t first = n % cells[0] * step[0] + n / cells[0] % cells[1] * step[1] +
                         n / cells[0] / cells[1] * step[2];
    double corner[8];
    for (int c = 0; c < 8; ++c)
      corner[c] =
          (double)(first + (c % 4 == 1 || c % 4 == 2 ? wide[0] : 0) +
                   (c % 4 >= 2 ? wide[1] : 0) + (c >= 4 && dimension == 3 ? wide[2] : 0));
    fg_status status = fg__topology_add(data, dimension == 3 ? HEXAHEDRON : QUAD, corner,
                                        dimension == 3 ? 8 : 4, NULL, 0, points);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

/* Whether the points of a grid are where its lines along the axes cross, but for the
 * rounding of single precision. */
static bool are_at_crossings(const double *position, const fg__vtk *vtk,
                             const size_t length[3], const double rounding[3])
{
  double *const *axis = vtk->coordinate;
  for (size_t k = 0; k < length[2]; ++k)
    for (size_t j = 0; j < length[1]; ++j)
      for (size_t i = 0; i < length[0]; ++i, position += 3)
        if (!(fabs(position[0] - axis[0][i]) <= rounding[0] &&
              fabs(position[1] - axis[1][j]) <= rounding[1] &&
              fabs(position[2] - axis[2][k]) <= rounding[2]))
          return false;
  return true;
}

/* A curvilinear grid whose lines are along the axes after all is an uneven one, and its
 * samples are kept as they are. */
static fg_status find_axes(bool *found, fg__vtk *vtk, const fg__topology *cells)
{
  size_t length[3] = {1, 1, 1}, step = 1;
  double rounding[3] = {0.0, 0.0, 0.0};
  *found = vtk->piece_count == 1 && cells->points > 0 &&
           memcmp(vtk->pieces[0].extent, vtk->extent, sizeof vtk->extent) == 0;
  for (int k = 0; k < 3 && *found; ++k) {
    length[k] = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
    double *axis = vtk->coordinate[k] = fg__allocate(length[k], sizeof *axis);
    if (!axis)
      return fg__fail_memory(vtk->context, "an axis", length[k] * sizeof *axis);
    for (size_t i = 0; i < length[k]; ++i) {
      axis[i] = cells->position[3 * i * step + (size_t)k];
      rounding[k] = fmax(rounding[k], 4.0 * (double)FLT_EPSILON * fabs(axis[i]));
    }
    const double sense = axis[length[k] - 1] < axis[0] ? -1.0 : 1.0;
    for (size_t i = 1; i < length[k]; ++i)
      *found = *found && sense * (axis[i] - axis[i - 1]) > rounding[k];
    step *= length[k];
  }
  *found = *found && are_at_crossings(cells->position, vtk, length, rounding);
  for (int k = 0; k < 3 && !*found; ++k) {
    free(vtk->coordinate[k]);
    vtk->coordinate[k] = NULL;
  }
  return FG_STATUS_OK;
}

static fg_status count_points(const fg__vtk *vtk)
{
  size_t points = 0, cells = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    size_t some = 0, more = 0;
    if (!fg__vtk_tuples(&some, vtk, &vtk->pieces[p], FG__VTK_POINTS) ||
        !fg__vtk_tuples(&more, vtk, &vtk->pieces[p], FG__VTK_CELLS) ||
        some > INT_MAX - points || more > INT_MAX - cells)
      return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                      "%s: more than %d points or cells", vtk->path, INT_MAX);
    points += some;
    cells += more;
  }
  return FG_STATUS_OK;
}

/* Where the points of a grid are that has no list of them. */
static void imply_positions(double *out, const fg__vtk *file, const fg__vtk_piece *piece)
{
  const int *e = piece->extent;
  for (int64_t k = e[4]; k <= e[5]; ++k)
    for (int64_t j = e[2]; j <= e[3]; ++j)
      for (int64_t i = e[0]; i <= e[1]; ++i, out += 3) {
        const int64_t at[3] = {i, j, k};
        double along[3];
        for (int a = 0; a < 3; ++a)
          along[a] =
              file->turned
                  ? file->spacing[a] * (double)at[a]
                  : fg__vtk_coordinate(file, a, (size_t)(at[a] - file->extent[2 * a]));
        for (int a = 0; a < 3; ++a)
          out[a] = file->turned ? file->origin[a] + file->direction[3 * a] * along[0] +
                                      file->direction[3 * a + 1] * along[1] +
                                      file->direction[3 * a + 2] * along[2]
                                : along[a];
      }
}

static fg_status read_positions(fg__topology *cells, const fg__vtk *file,
                                const fg__vtk_piece *piece, size_t points, size_t *room)
{
  numbers own = {0};
  const bool implied = file->turned || file->kind == FG__VTK_ALONG_AXES;
  fg_status status = FG_STATUS_OK;
  if (!implied)
    status = read_own(&own, file, piece->positions, points, room);
  double *position =
      status == FG_STATUS_OK
          ? realloc(cells->position, (cells->points + points) * 3 * sizeof *position)
          : NULL;
  if (position)
    cells->position = position;
  else if (status == FG_STATUS_OK)
    status = fg__fail_memory(file->context, "points", points * 3 * sizeof *position);
  if (position && implied)
    imply_positions(position + 3 * cells->points, file, piece);
  else if (position)
    memcpy(position + 3 * cells->points, own.of, 3 * points * sizeof *position);
  free(own.of);
  return status;
}

static fg_status read_piece(fg__dataset *data, fg__vtk *vtk, size_t number, size_t *room)
{
  fg__topology *cells = &data->space.cells;
  const fg__vtk_piece *piece = &vtk->pieces[number];
  const fg__vtk *file = fg__vtk_home(vtk, number);
  fg__piece_points own = {.first = cells->points};
  bool along_axes = false;
  fg__vtk_tuples(&own.count, vtk, piece, FG__VTK_POINTS);
  fg_status status = read_positions(cells, file, piece, own.count, room);
  if (status != FG_STATUS_OK)
    return status;
  cells->points += own.count;
  if (file->kind == FG__VTK_UNSTRUCTURED)
    return read_listed(data, file, piece, &own, room);
  if (vtk->kind == FG__VTK_CURVILINEAR)
    status = find_axes(&along_axes, vtk, cells);
  if (along_axes) {
    vtk->kind = FG__VTK_ALONG_AXES;
    vtk->uneven = true;
  }
  return status == FG_STATUS_OK && !along_axes ? add_implied(data, piece, &own) : status;
}

fg_status fg__vtk_read_cells(fg__dataset *data, fg__vtk *vtk)
{
  size_t room = vtk->file_size;
  fg_status status = count_points(vtk);
  for (size_t p = 0; p < vtk->piece_count && status == FG_STATUS_OK; ++p)
    status = read_piece(data, vtk, p, &room);
  return status;
}
