/* From the arrays of an image, in pieces and on points or cells, to the points of a
 * plane. */
#include "base/memory.h"
#include "format/vti.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* vtkDataSetAttributes: what a sample of vtkGhostType says by its bits. */
enum { HIDDEN_POINT = 2, REFINED_CELL = 8, HIDDEN_CELL = 32 };

fg_status fg__vti_plane_find(fg__vti_plane *out, const fg__vti *vti)
{
  size_t points[3];
  int single = 0, flat = -1, thin = -1;
  for (int k = 0; k < 3; ++k) {
    points[k] = fg__vti_length(vti->extent, k, FG__VTI_POINTS);
    if (points[k] == 1) {
      ++single;
      flat = k;
    } else if (points[k] == 2) {
      thin = k;
    }
  }
  if (single > 1)
    return fg__fail(vti->context, FG_STATUS_UNSUPPORTED,
                    "%s: a line of %zu x %zu x %zu points; a field needs two directions",
                    vti->path, points[0], points[1], points[2]);
  if (flat < 0)
    flat = thin;
  if (flat < 0)
    return fg__fail(
        vti->context, FG_STATUS_UNSUPPORTED,
        "%s: a volume of %zu x %zu x %zu points; only fields in 2D can be read "
        "yet",
        vti->path, points[0], points[1], points[2]);
  out->flat = flat;
  out->axis[0] = flat == 0 ? 1 : 0;
  out->axis[1] = flat == 2 ? 1 : 2;
  for (int k = 0; k < 2; ++k)
    out->points[k] = points[out->axis[k]];
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
  fg__vti_place place;
  int components; /* how many are wanted */
  int component[3];
  float *out[3];
  meaning *means;
} gathering;

static fg_status find_in_piece(const fg__vti_array **out, const fg__vti *vti,
                               const gathering *wanted, size_t piece)
{
  const fg__vti_array *array = fg__vti_find(vti, piece, wanted->place, wanted->name);
  const fg__vti_array *first = fg__vti_find(vti, 0, wanted->place, wanted->name);
  *out = array;
  if (!array || !first || array->components != first->components)
    return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                    "%s: piece %zu of %zu has no array \"%.100s\" like the first's",
                    vti->path, piece + 1, vti->piece_count, wanted->name);
  for (int c = 0; c < wanted->components; ++c)
    if (wanted->component[c] >= array->components)
      return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                      "%s: two arrays are named \"%.100s\", one of %d component%s",
                      vti->path, wanted->name, array->components,
                      array->components == 1 ? "" : "s");
  return FG_STATUS_OK;
}

/* Every piece must be there with all its bytes, and no byte may serve two pieces: then
 * the whole is no larger than the file can fill. */
static fg_status check_pieces(const fg__vti *vti, const gathering *wanted)
{
  size_t stored_sum = 0;
  for (size_t p = 0; p < vti->piece_count; ++p) {
    const fg__vti_array *array;
    size_t tuples, stored = 0;
    fg_status status = find_in_piece(&array, vti, wanted, p);
    if (status != FG_STATUS_OK)
      return status;
    if (!fg__vti_count(&tuples, vti->pieces[p].extent, wanted->place))
      return FG_STATUS_FILE_FORMAT;
    status = fg__vti_values_check(vti, array, tuples, &stored);
    if (status != FG_STATUS_OK)
      return status;
    if (stored > vti->file_size - stored_sum)
      return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                      "%s: the pieces of array \"%.100s\" overlap in the file", vti->path,
                      wanted->name);
    stored_sum += stored;
  }
  return FG_STATUS_OK;
}

static void place_piece(const fg__vti *vti, const gathering *wanted, const int extent[6],
                        const fg__vti_values *values, int stride, unsigned char *seen)
{
  size_t length[3], whole[3], first[3];
  for (int k = 0; k < 3; ++k) {
    length[k] = fg__vti_length(extent, k, wanted->place);
    whole[k] = fg__vti_length(vti->extent, k, wanted->place);
    first[k] = (size_t)((int64_t)extent[2 * k] - (int64_t)vti->extent[2 * k]);
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
          wanted->out[c][row + x] = wanted->means(fg__vti_value(
              values, from * (size_t)stride + (size_t)wanted->component[c]));
      }
    }
}

static fg_status gather(const fg__vti *vti, const gathering *wanted)
{
  size_t count;
  if (!fg__vti_count(&count, vti->extent, wanted->place))
    return FG_STATUS_FILE_FORMAT;
  unsigned char *seen = fg__allocate(count, 1);
  if (!seen)
    return fg__fail_memory(vti->context, "a field's samples", count);
  fg_status status = FG_STATUS_OK;
  for (size_t p = 0; p < vti->piece_count && status == FG_STATUS_OK; ++p) {
    const int *extent = vti->pieces[p].extent;
    const fg__vti_array *array;
    fg__vti_values values = {0};
    size_t tuples;
    status = find_in_piece(&array, vti, wanted, p);
    if (status == FG_STATUS_OK && fg__vti_count(&tuples, extent, wanted->place))
      status = fg__vti_values_create(&values, vti, array, tuples);
    if (status == FG_STATUS_OK)
      place_piece(vti, wanted, extent, &values, array->components, seen);
    fg__vti_values_clear(&values);
  }
  const unsigned char *hole = status == FG_STATUS_OK ? memchr(seen, 0, count) : NULL;
  if (hole)
    status =
        fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                 "%s: the %zu pieces do not cover the whole: sample %zu of %zu is in "
                 "none",
                 vti->path, vti->piece_count, (size_t)(hole - seen), count);
  free(seen);
  return status;
}

/* A mean with them would be missing, or infinite, far from where they are. */
static fg_status refuse_infinite(const fg__vti *vti, const gathering *wanted,
                                 size_t count)
{
  for (int c = 0; c < wanted->components; ++c)
    for (size_t i = 0; i < count; ++i)
      if (isinf(wanted->out[c][i]))
        return fg__fail(
            vti->context, FG_STATUS_FILE_FORMAT,
            "%s: array \"%.100s\" is infinite, or too large to be a velocity, "
            "in sample %zu of %zu",
            vti->path, wanted->name, i, count);
  return FG_STATUS_OK;
}

/* ---- bringing samples onto the plane's points
 * ------------------------------------------- */

/* Mean over the layers of the flat axis, in place of the first `points` samples of a new
 * array; a NaN in one makes the mean one. */
static void flatten(float *out, const float *samples, const fg__vti *vti,
                    const fg__vti_plane *plane, fg__vti_place place)
{
  size_t length[3], step[3] = {1, 0, 0};
  for (int k = 0; k < 3; ++k)
    length[k] = fg__vti_length(vti->extent, k, place);
  step[1] = length[0];
  step[2] = length[0] * length[1];
  size_t layers = length[plane->flat];
  for (size_t j = 0; j < length[plane->axis[1]]; ++j)
    for (size_t i = 0; i < length[plane->axis[0]]; ++i) {
      size_t at = j * step[plane->axis[1]] + i * step[plane->axis[0]];
      double sum = 0.0;
      for (size_t layer = 0; layer < layers; ++layer)
        sum += (double)samples[at + layer * step[plane->flat]];
      *out++ = (float)(sum / (double)layers);
    }
}

/* A point's value is the mean of the one, two or four cells round it (VTK's
 * CellDataToPointData); a NaN in one of them makes it one, so that no point beside a hole
 * pretends to know the flow there. */
static void cells_to_points(float *out, const float *cells, const size_t points[2])
{
  size_t columns = points[0] - 1, rows = points[1] - 1;
  for (size_t j = 0; j < points[1]; ++j)
    for (size_t i = 0; i < points[0]; ++i) {
      double sum = 0.0;
      int count = 0;
      for (size_t y = j > 0 ? j - 1 : 0; y <= j && y < rows; ++y)
        for (size_t x = i > 0 ? i - 1 : 0; x <= i && x < columns; ++x) {
          sum += (double)cells[y * columns + x];
          ++count;
        }
      *out++ = (float)(sum / count);
    }
}

static fg_status to_plane(float **out, const float *samples, const fg__vti *vti,
                          const fg__vti_plane *plane, fg__vti_place place)
{
  size_t count = plane->points[0] * plane->points[1];
  float *flat = fg__allocate(count, sizeof *flat);
  float *points = place == FG__VTI_CELLS ? fg__allocate(count, sizeof *points) : NULL;
  if (!flat || (place == FG__VTI_CELLS && !points)) {
    free(flat);
    free(points);
    return fg__fail_memory(vti->context, "a field's samples", 2 * count * sizeof *flat);
  }
  flatten(flat, samples, vti, plane, place);
  *out = flat;
  if (points) {
    cells_to_points(points, flat, plane->points);
    free(flat);
    *out = points;
  }
  return FG_STATUS_OK;
}

/* Reads the wanted components onto the plane's points. With `any`, the first result
 * stands for all: a number where one of them is. */
static fg_status read_onto_points(float *out[], const fg__vti *vti,
                                  const fg__vti_plane *plane, gathering *wanted, bool any)
{
  size_t count;
  fg_status status = check_pieces(vti, wanted);
  if (status == FG_STATUS_OK && !fg__vti_count(&count, vti->extent, wanted->place))
    status = FG_STATUS_FILE_FORMAT;
  for (int c = 0; c < wanted->components && status == FG_STATUS_OK; ++c) {
    wanted->out[c] = fg__allocate(count, sizeof(float));
    if (!wanted->out[c])
      status = fg__fail_memory(vti->context, "a field's samples", count * sizeof(float));
  }
  if (status == FG_STATUS_OK)
    status = gather(vti, wanted);
  if (status == FG_STATUS_OK)
    status = refuse_infinite(vti, wanted, count);
  if (status == FG_STATUS_OK && any)
    for (int c = 1; c < wanted->components; ++c)
      for (size_t i = 0; i < count; ++i)
        if (isnan(wanted->out[0][i]))
          wanted->out[0][i] = wanted->out[c][i];
  for (int c = 0; c < (any ? 1 : wanted->components) && status == FG_STATUS_OK; ++c)
    status = to_plane(&out[c], wanted->out[c], vti, plane, wanted->place);
  for (int c = 0; c < wanted->components; ++c)
    free(wanted->out[c]);
  return status;
}

/* ---- what is missing
 * ---------------------------------------------------------------------- */

static fg_status apply_marks(float *velocity[2], const fg__vti *vti,
                             const fg__vti_plane *plane, gathering *wanted)
{
  float *marks = NULL;
  fg_status status = read_onto_points(&marks, vti, plane, wanted, true);
  if (status == FG_STATUS_OK)
    for (size_t i = 0; i < plane->points[0] * plane->points[1]; ++i)
      if (isnan(marks[i]))
        velocity[0][i] = velocity[1][i] = NAN; /* both are there: NOLINT */
  free(marks);
  return status;
}

static fg_status apply_known_marks(float *velocity[2], const fg__vti *vti,
                                   const fg__vti_plane *plane)
{
  static const struct {
    const char *name;
    fg__vti_place place;
    meaning *means;
  } known[] = {{"vtkGhostType", FG__VTI_POINTS, as_ghost_point},
               {"vtkGhostType", FG__VTI_CELLS, as_ghost_cell},
               {"vtkValidPointMask", FG__VTI_POINTS, as_valid_point}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k) {
    if (!fg__vti_find(vti, 0, known[k].place, known[k].name))
      continue;
    gathering wanted = {.name = known[k].name,
                        .place = known[k].place,
                        .components = 1,
                        .means = known[k].means};
    fg_status status = apply_marks(velocity, vti, plane, &wanted);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status apply_mask(float *velocity[2], const fg__vti *vti,
                            const fg__vti_plane *plane, const char *mask)
{
  fg__vti_place place = FG__VTI_POINTS;
  const fg__vti_array *array = fg__vti_find(vti, 0, place, mask);
  if (!array) {
    place = FG__VTI_CELLS;
    array = fg__vti_find(vti, 0, place, mask);
  }
  if (!array)
    return fg__vti_fail_unknown(vti, mask);
  if (array->components > 3)
    return fg__fail(vti->context, FG_STATUS_ARGUMENT,
                    "%s: mask \"%.100s\" has %d components; at most 3 can be a mask",
                    vti->path, mask, array->components);
  gathering wanted = {.name = mask,
                      .place = place,
                      .components = array->components,
                      .component = {0, 1, 2},
                      .means = array->components > 1 ? as_vector_mask : as_scalar_mask};
  return apply_marks(velocity, vti, plane, &wanted);
}

/* ---- the vector
 * ----------------------------------------------------------------------------- */

/* Which component lies along the plane's axis k: of three, the axis' own; two are meant
 * along the plane. */
static int component_along(const fg__vti_vector *vector, const fg__vti_plane *plane,
                           int k)
{
  return vector->components == 3 ? plane->axis[k] : k;
}

static fg_status read_vector(float *out[2], const fg__vti *vti,
                             const fg__vti_plane *plane, const fg__vti_vector *vector)
{
  int component[2];
  for (int k = 0; k < 2; ++k)
    component[k] = component_along(vector, plane, k);
  if (vector->names == 1) {
    gathering wanted = {.name = vector->name[0],
                        .place = vector->place,
                        .components = 2,
                        .component = {component[0], component[1]},
                        .means = as_velocity};
    return read_onto_points(out, vti, plane, &wanted, false);
  }
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    gathering wanted = {.name = vector->name[component[k]],
                        .place = vector->place,
                        .components = 1,
                        .means = as_velocity};
    status = read_onto_points(&out[k], vti, plane, &wanted, false);
  }
  return status;
}

fg_status fg__vti_plane_read(float *out[2], const fg__vti *vti,
                             const fg__vti_plane *plane, const fg__vti_vector *vector,
                             const char *mask)
{
  out[0] = out[1] = NULL;
  fg_status status = read_vector(out, vti, plane, vector);
  if (status == FG_STATUS_OK)
    status = apply_known_marks(out, vti, plane);
  if (status == FG_STATUS_OK && mask)
    status = apply_mask(out, vti, plane, mask);
  if (status != FG_STATUS_OK) {
    free(out[0]);
    free(out[1]);
    out[0] = out[1] = NULL;
  }
  return status;
}
