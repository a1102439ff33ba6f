/* From the arrays of a grid, in pieces and on points or cells, to the points of a plane
 * or volume. */
#include "base/memory.h"
#include "format/vtk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* vtkDataSetAttributes: what a sample of vtkGhostType says by its bits. */
enum { HIDDEN_POINT = 2, REFINED_CELL = 8, HIDDEN_CELL = 32 };

/* The axis that an image is flat along: one point thick, else two; -1 for a volume, or
 * -2 for a line. */
static int flat_axis(const fg__vtk *vtk)
{
  int single = 0, flat = -1, thin = -1;
  for (int k = 0; k < 3; ++k) {
    size_t points = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
    if (points == 1) {
      ++single;
      flat = k;
    } else if (points == 2) {
      thin = k;
    }
  }
  if (single > 1)
    return -2;
  return flat < 0 ? thin : flat;
}

bool fg__vtk_is_volume(const fg__vtk *vtk)
{
  return flat_axis(vtk) == -1;
}

size_t fg__vtk_grid_points(const fg__vtk_grid *grid)
{
  return grid->points[0] * grid->points[1] * grid->points[2];
}

fg_status fg__vtk_grid_find(fg__vtk_grid *out, const fg__vtk *vtk)
{
  size_t points[3];
  for (int k = 0; k < 3; ++k)
    points[k] = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
  *out = (fg__vtk_grid){.flat = flat_axis(vtk), .points = {1, 1, 1}};
  if (out->flat == -2)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: a line of %zu x %zu x %zu points; a field needs two directions",
                    vtk->path, points[0], points[1], points[2]);
  for (int k = 0; k < 3; ++k)
    if (k != out->flat) {
      out->axis[out->dimension] = k;
      out->points[out->dimension++] = points[k];
    }
  return FG_STATUS_OK;
}

/* ---- gathering the pieces
 * ---------------------------------------------------------------- */

/* What a number of the file stands for. */
typedef float meaning(double number);

static float as_velocity(double number)
{
  return (float)number;
}

static float as_flag(bool inside)
{
  return inside ? 1.0f : NAN;
}

static float as_scalar_mask(double number)
{
  return as_flag(number > 0.0);
}

static float as_vector_mask(double number)
{
  return as_flag(number > 0.0 || number < 0.0);
}

static float as_valid_point(double number)
{
  return as_flag(number != 0.0);
}

static bool has_bit(double number, unsigned bits)
{
  return number >= 0.0 && number < 256.0 && ((unsigned)number & bits) != 0;
}

static float as_ghost_point(double number)
{
  return as_flag(!has_bit(number, HIDDEN_POINT));
}

static float as_ghost_cell(double number)
{
  return as_flag(!has_bit(number, REFINED_CELL | HIDDEN_CELL));
}

/* Which array, and which of its components, goes where; a sample of `out` is a point or a
 * cell of the whole image, x fastest. */
typedef struct gathering {
  const char *name;
  fg__vtk_place place;
  int components; /* how many are wanted */
  int component[3];
  float *out[3];
  meaning *means;
} gathering;

static fg_status find_in_piece(const fg__vtk_array **out, const fg__vtk *vtk,
                               const gathering *wanted, size_t piece)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, piece, wanted->place, wanted->name);
  const fg__vtk_array *first = fg__vtk_find(vtk, 0, wanted->place, wanted->name);
  *out = array;
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

/* Every piece must be there with all its bytes, and no byte may serve two pieces: then
 * the whole is no larger than the file can fill. */
static fg_status check_pieces(const fg__vtk *vtk, const gathering *wanted)
{
  size_t stored_sum = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_array *array;
    size_t tuples, stored = 0;
    fg_status status = find_in_piece(&array, vtk, wanted, p);
    if (status != FG_STATUS_OK)
      return status;
    if (!fg__vtk_count(&tuples, vtk->pieces[p].extent, wanted->place))
      return FG_STATUS_FILE_FORMAT;
    status = fg__vtk_values_check(vtk, array, tuples, &stored);
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

static void place_piece(const fg__vtk *vtk, const gathering *wanted, const int extent[6],
                        const fg__vtk_values *values, int stride, unsigned char *seen)
{
  size_t length[3], whole[3], first[3];
  for (int k = 0; k < 3; ++k) {
    length[k] = fg__vtk_length(extent, k, wanted->place);
    whole[k] = fg__vtk_length(vtk->extent, k, wanted->place);
    first[k] = (size_t)((int64_t)extent[2 * k] - (int64_t)vtk->extent[2 * k]);
    if (first[k] + length[k] > whole[k]) /* a flat piece at the end of the cells */
      first[k] = whole[k] - length[k];
  }
  size_t from = 0;
  for (size_t z = 0; z < length[2]; ++z)
    for (size_t y = 0; y < length[1]; ++y) {
      size_t row = ((first[2] + z) * whole[1] + first[1] + y) * whole[0] + first[0];
      for (size_t x = 0; x < length[0]; ++x, ++from) {
        seen[row + x] = 1;
        for (int c = 0; c < wanted->components; ++c)
          wanted->out[c][row + x] = wanted->means(fg__vtk_value(
              values, from * (size_t)stride + (size_t)wanted->component[c]));
      }
    }
}

static fg_status gather(const fg__vtk *vtk, const gathering *wanted)
{
  size_t count;
  if (!fg__vtk_count(&count, vtk->extent, wanted->place))
    return FG_STATUS_FILE_FORMAT;
  unsigned char *seen = fg__allocate(count, 1);
  if (!seen)
    return fg__fail_memory(vtk->context, "a field's samples", count);
  fg_status status = FG_STATUS_OK;
  for (size_t p = 0; p < vtk->piece_count && status == FG_STATUS_OK; ++p) {
    const int *extent = vtk->pieces[p].extent;
    const fg__vtk_array *array;
    fg__vtk_values values = {0};
    size_t tuples;
    status = find_in_piece(&array, vtk, wanted, p);
    if (status == FG_STATUS_OK && fg__vtk_count(&tuples, extent, wanted->place))
      status = fg__vtk_values_create(&values, vtk, array, tuples);
    if (status == FG_STATUS_OK)
      place_piece(vtk, wanted, extent, &values, array->components, seen);
    fg__vtk_values_clear(&values);
  }
  const unsigned char *hole = status == FG_STATUS_OK ? memchr(seen, 0, count) : NULL;
  if (hole)
    status =
        fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                 "%s: the %zu pieces do not cover the whole: sample %zu of %zu is in "
                 "none",
                 vtk->path, vtk->piece_count, (size_t)(hole - seen), count);
  free(seen);
  return status;
}

/* A mean with them would be missing, or infinite, far from where they are. */
static fg_status refuse_infinite(const fg__vtk *vtk, const gathering *wanted,
                                 size_t count)
{
  for (int c = 0; c < wanted->components; ++c)
    for (size_t i = 0; i < count; ++i)
      if (isinf(wanted->out[c][i]))
        return fg__fail(
            vtk->context, FG_STATUS_FILE_FORMAT,
            "%s: array \"%.100s\" is infinite, or too large to be a velocity, "
            "in sample %zu of %zu",
            vtk->path, wanted->name, i, count);
  return FG_STATUS_OK;
}

/* ---- bringing samples onto the grid's points
 * -------------------------------------------- */

/* Mean over the layers of the flat axis, or all as it is in a volume; a NaN in one makes
 * the mean one. */
static void flatten(float *out, const float *samples, const fg__vtk *vtk,
                    const fg__vtk_grid *grid, fg__vtk_place place)
{
  size_t length[3], step[3] = {1, 0, 0};
  for (int k = 0; k < 3; ++k)
    length[k] = fg__vtk_length(vtk->extent, k, place);
  step[1] = length[0];
  step[2] = length[0] * length[1];
  if (grid->dimension == 3) {
    memcpy(out, samples, length[2] * step[2] * sizeof *out);
    return;
  }
  size_t layers = length[grid->flat];
  for (size_t j = 0; j < length[grid->axis[1]]; ++j)
    for (size_t i = 0; i < length[grid->axis[0]]; ++i) {
      size_t at = j * step[grid->axis[1]] + i * step[grid->axis[0]];
      double sum = 0.0;
      for (size_t layer = 0; layer < layers; ++layer)
        sum += (double)samples[at + layer * step[grid->flat]];
      *out++ = (float)(sum / (double)layers);
    }
}

/* The cells that touch point i of an axis: [*first, *end) of `points` - 1. */
static void cells_round(size_t i, size_t points, size_t *first, size_t *end)
{
  *first = i > 0 ? i - 1 : 0;
  *end = i + 1 < points ? i + 1 : i;
  if (points == 1)
    *end = 1; /* a plane's only layer */
}

/* A point's value is the mean of the cells round it, up to eight (VTK's
 * CellDataToPointData); a NaN in one of them makes it one, so that no point beside a hole
 * pretends to know the flow there. */
static void cells_to_points(float *out, const float *cells, const size_t points[3])
{
  size_t columns = points[0] - 1, rows = points[1] - 1;
  for (size_t k = 0; k < points[2]; ++k)
    for (size_t j = 0; j < points[1]; ++j)
      for (size_t i = 0; i < points[0]; ++i) {
        size_t first[3], end[3];
        const size_t at[3] = {i, j, k};
        for (int d = 0; d < 3; ++d)
          cells_round(at[d], points[d], &first[d], &end[d]);
        double sum = 0.0;
        int count = 0;
        for (size_t z = first[2]; z < end[2]; ++z)
          for (size_t y = first[1]; y < end[1]; ++y)
            for (size_t x = first[0]; x < end[0]; ++x) {
              sum += (double)cells[(z * rows + y) * columns + x];
              ++count;
            }
        *out++ = (float)(sum / count);
      }
}

/* Takes `samples` over. */
static fg_status to_grid(float **out, float *samples, const fg__vtk *vtk,
                         const fg__vtk_grid *grid, fg__vtk_place place)
{
  if (grid->dimension == 3 && place == FG__VTK_POINTS) {
    *out = samples;
    return FG_STATUS_OK;
  }
  size_t count = fg__vtk_grid_points(grid);
  float *flat = fg__allocate(count, sizeof *flat);
  float *points = place == FG__VTK_CELLS ? fg__allocate(count, sizeof *points) : NULL;
  if (!flat || (place == FG__VTK_CELLS && !points)) {
    free(flat);
    free(points);
    free(samples);
    return fg__fail_memory(vtk->context, "a field's samples", 2 * count * sizeof *flat);
  }
  flatten(flat, samples, vtk, grid, place);
  free(samples);
  *out = flat;
  if (points) {
    cells_to_points(points, flat, grid->points);
    free(flat);
    *out = points;
  }
  return FG_STATUS_OK;
}

/* Reads the wanted components onto the grid's points. With `any`, the first result
 * stands for all: a number where one of them is. */
static fg_status read_onto_points(float *out[], const fg__vtk *vtk,
                                  const fg__vtk_grid *grid, gathering *wanted, bool any)
{
  size_t count;
  fg_status status = check_pieces(vtk, wanted);
  if (status == FG_STATUS_OK && !fg__vtk_count(&count, vtk->extent, wanted->place))
    status = FG_STATUS_FILE_FORMAT;
  for (int c = 0; c < wanted->components && status == FG_STATUS_OK; ++c) {
    wanted->out[c] = fg__allocate(count, sizeof(float));
    if (!wanted->out[c])
      status = fg__fail_memory(vtk->context, "a field's samples", count * sizeof(float));
  }
  if (status == FG_STATUS_OK)
    status = gather(vtk, wanted);
  if (status == FG_STATUS_OK)
    status = refuse_infinite(vtk, wanted, count);
  if (status == FG_STATUS_OK && any)
    for (int c = 1; c < wanted->components; ++c)
      for (size_t i = 0; i < count; ++i)
        if (isnan(wanted->out[0][i]))
          wanted->out[0][i] = wanted->out[c][i];
  for (int c = 0; c < (any ? 1 : wanted->components) && status == FG_STATUS_OK; ++c) {
    status = to_grid(&out[c], wanted->out[c], vtk, grid, wanted->place);
    wanted->out[c] = NULL;
  }
  for (int c = 0; c < wanted->components; ++c)
    free(wanted->out[c]);
  return status;
}

/* ---- what is missing
 * ---------------------------------------------------------------------- */

static fg_status apply_marks(float *velocity[3], const fg__vtk *vtk,
                             const fg__vtk_grid *grid, gathering *wanted)
{
  float *marks = NULL;
  fg_status status = read_onto_points(&marks, vtk, grid, wanted, true);
  if (status == FG_STATUS_OK)
    for (int k = 0; k < grid->dimension; ++k)
      for (size_t i = 0; i < fg__vtk_grid_points(grid); ++i)
        if (velocity[k] && isnan(marks[i]))
          velocity[k][i] = NAN;
  free(marks);
  return status;
}

static fg_status apply_known_marks(float *velocity[3], const fg__vtk *vtk,
                                   const fg__vtk_grid *grid)
{
  static const struct {
    const char *name;
    fg__vtk_place place;
    meaning *means;
  } known[] = {{"vtkGhostType", FG__VTK_POINTS, as_ghost_point},
               {"vtkGhostType", FG__VTK_CELLS, as_ghost_cell},
               {"vtkValidPointMask", FG__VTK_POINTS, as_valid_point}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k) {
    if (!fg__vtk_find(vtk, 0, known[k].place, known[k].name))
      continue;
    gathering wanted = {.name = known[k].name,
                        .place = known[k].place,
                        .components = 1,
                        .means = known[k].means};
    fg_status status = apply_marks(velocity, vtk, grid, &wanted);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status apply_mask(float *velocity[3], const fg__vtk *vtk,
                            const fg__vtk_grid *grid, const char *mask)
{
  fg__vtk_place place = FG__VTK_POINTS;
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, place, mask);
  if (!array) {
    place = FG__VTK_CELLS;
    array = fg__vtk_find(vtk, 0, place, mask);
  }
  if (!array)
    return fg__vtk_fail_unknown(vtk, mask);
  if (array->components > 3)
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: mask \"%.100s\" has %d components; at most 3 can be a mask",
                    vtk->path, mask, array->components);
  gathering wanted = {.name = mask,
                      .place = place,
                      .components = array->components,
                      .component = {0, 1, 2},
                      .means = array->components > 1 ? as_vector_mask : as_scalar_mask};
  return apply_marks(velocity, vtk, grid, &wanted);
}

/* ---- the vector
 * ----------------------------------------------------------------------------- */

/* Which component lies along the grid's axis k: of three, the axis' own; two are meant
 * along a plane. */
static int component_along(const fg__vtk_vector *vector, const fg__vtk_grid *grid, int k)
{
  return vector->components == 3 ? grid->axis[k] : k;
}

static fg_status read_vector(float *out[3], const fg__vtk *vtk, const fg__vtk_grid *grid,
                             const fg__vtk_vector *vector)
{
  if (grid->dimension > vector->components) {
    fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
             "%s: a volume of %zu x %zu x %zu points needs three components, \"%.100s\" "
             "has two",
             vtk->path, grid->points[0], grid->points[1], grid->points[2],
             vector->name[0]);
    fg__hint(vtk->context, "name three variables: --vars U,V,W");
    return FG_STATUS_UNSUPPORTED;
  }
  if (vector->names == 1) {
    gathering wanted = {.name = vector->name[0],
                        .place = vector->place,
                        .components = grid->dimension,
                        .means = as_velocity};
    for (int k = 0; k < grid->dimension; ++k)
      wanted.component[k] = component_along(vector, grid, k);
    return read_onto_points(out, vtk, grid, &wanted, false);
  }
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < grid->dimension && status == FG_STATUS_OK; ++k) {
    gathering wanted = {.name = vector->name[component_along(vector, grid, k)],
                        .place = vector->place,
                        .components = 1,
                        .means = as_velocity};
    status = read_onto_points(&out[k], vtk, grid, &wanted, false);
  }
  return status;
}

fg_status fg__vtk_samples_read(float *out[3], const fg__vtk *vtk,
                               const fg__vtk_grid *grid, const fg__vtk_vector *vector,
                               const char *mask)
{
  out[0] = out[1] = out[2] = NULL;
  fg_status status = read_vector(out, vtk, grid, vector);
  if (status == FG_STATUS_OK)
    status = apply_known_marks(out, vtk, grid);
  if (status == FG_STATUS_OK && mask)
    status = apply_mask(out, vtk, grid, mask);
  for (int k = 0; k < 3 && status != FG_STATUS_OK; ++k) {
    free(out[k]);
    out[k] = NULL;
  }
  return status;
}
