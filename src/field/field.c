#include "field/field.h"
#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Larger speeds are refused: light makes 3e8 m/s (3e14 um/s), so they are fill values
 * that the file did not declare; and up to here (v / cos latitude)^2 is finite in float.
 */
static const double LARGEST_SPEED = 1e15;

/* Larger coordinates are refused: 1e20 and more are customary fill values, and the
 * squares of those up to here are far from overflow in double. */
static const double LARGEST_COORDINATE = 1e18;

/* Rows a rounding error beyond the pole are taken (90.00001 in float), none farther. */
static const double LARGEST_LATITUDE = 90.001;

static fg_status check_axis(fg_context *context, const fg_field_arrays *arrays, int k)
{
  static const char letter[] = "xyz";
  const double *axis = arrays->axis[k];
  const int n = arrays->size[k];
  if (!axis)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: the %c axis is missing",
                    letter[k]);
  for (int i = 0; i < n; ++i) {
    if (!isfinite(axis[i]) || fabs(axis[i]) > LARGEST_COORDINATE)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: coordinate %d of the %c axis is %g, not a usable number", i,
                      letter[k], axis[i]);
    if (i > 0 && !(axis[i] > axis[i - 1] && isfinite(1.0 / (axis[i] - axis[i - 1]))))
      return fg__fail(
          context, FG_STATUS_ARGUMENT,
          "field: the %c axis does not ascend: %.17g is followed by %.17g at %d",
          letter[k], axis[i - 1], axis[i], i);
  }
  const double period = arrays->period[k];
  if (period != 0.0 && !(period <= LARGEST_COORDINATE && axis[0] + period > axis[n - 1] &&
                         isfinite(1.0 / (axis[0] + period - axis[n - 1]))))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: the %c axis from %g to %g does not fit its period %g",
                    letter[k], axis[0], axis[n - 1], period);
  return FG_STATUS_OK;
}

static fg_status check_size(fg_context *context, const fg_field_arrays *arrays)
{
  const int *size = arrays->size;
  const int dimension = arrays->dimension;
  if (dimension != 2 && dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: %d dimensions; fields have 2 or 3", dimension);
  bool possible = true;
  size_t samples = 1;
  for (int k = 0; k < dimension && possible; ++k) {
    possible = size[k] >= 2 && size[k] < INT_MAX &&
               (size_t)size[k] <= PTRDIFF_MAX / sizeof(float) / samples;
    samples *= (size_t)size[k];
  }
  if (possible)
    return FG_STATUS_OK;
  if (dimension == 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: a grid of %d x %d x %d samples; at least 2 x 2 x 2 are "
                    "needed, and fewer than memory can address",
                    size[0], size[1], size[2]);
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "field: a grid of %d x %d samples; at least 2 x 2 are needed", size[0],
                  size[1]);
}

static fg_status check_latitudes(fg_context *context, const fg_field_arrays *arrays)
{
  const double south = arrays->axis[1][0];
  const double north = arrays->axis[1][arrays->size[1] - 1];
  if (south < -LARGEST_LATITUDE || north > LARGEST_LATITUDE)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: latitudes from %g to %g go beyond the poles", south, north);
  if (arrays->dimension == 2)
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_UNSUPPORTED,
           "field: longitude, latitude and height together cannot be handled yet");
  fg__hint(context, "--scale plain takes the velocity as if it were along the axes, in "
                    "their units");
  return FG_STATUS_UNSUPPORTED;
}

static fg_status check_arrays(fg_context *context, const fg_field_arrays *arrays)
{
  fg_status status = check_size(context, arrays);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < arrays->dimension; ++k) {
    if (!arrays->velocity[k])
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: velocity component %d is missing", k);
    status = check_axis(context, arrays, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  if ((int)arrays->scale < FG_SCALE_AUTO || (int)arrays->scale > FG_SCALE_PLAIN)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: unknown scale %d",
                    (int)arrays->scale);
  return arrays->scale == FG_SCALE_GEO ? check_latitudes(context, arrays) : FG_STATUS_OK;
}

static fg_status copy_axis(fg_field *field, fg_context *context,
                           const fg_field_arrays *arrays, int k)
{
  fg__axis *axis = &field->axis[k];
  const int n = arrays->size[k];
  axis->samples = n;
  axis->period = arrays->period[k];
  axis->cells = axis->period > 0.0 ? n : n - 1;
  axis->coordinate = fg__allocate((size_t)n + 1, sizeof(double));
  axis->inverse_width = fg__allocate((size_t)n, sizeof(double));
  if (!axis->coordinate || !axis->inverse_width)
    return fg__fail_memory(context, "an axis", (size_t)n * 2 * sizeof(double));
  memcpy(axis->coordinate, arrays->axis[k], (size_t)n * sizeof(double));
  axis->coordinate[n] = axis->coordinate[0] + axis->period;

  const double first = axis->coordinate[0];
  const double spacing = (axis->coordinate[axis->cells] - first) / axis->cells;
  axis->inverse_spacing = 1.0 / spacing;
  axis->even = true;
  for (int i = 0; i < axis->cells; ++i) {
    axis->inverse_width[i] = 1.0 / (axis->coordinate[i + 1] - axis->coordinate[i]);
    if (fabs(axis->coordinate[i] - (first + i * spacing)) > 0.25 * spacing)
      axis->even = false;
  }
  field->contents.axis[k] = axis->coordinate;
  return FG_STATUS_OK;
}

static bool sample_is_valid(const fg_field_arrays *arrays, size_t i)
{
  if (arrays->valid && !arrays->valid[i])
    return false;
  for (int k = 0; k < arrays->dimension; ++k)
    if (isnan(arrays->velocity[k][i]))
      return false;
  return true;
}

static fg_status fail_speed(const fg_field *field, fg_context *context, int k,
                            double value, size_t i)
{
  const size_t row = (size_t)field->contents.size[0];
  const size_t rows = (size_t)field->contents.size[1];
  const char *name = field->contents.velocity_name[k];
  fg_status status;
  if (field->contents.dimension == 3)
    status =
        fg__fail(context, FG_STATUS_ARGUMENT,
                 "field: %s is %g at sample (%zu, %zu, %zu); speeds up to %g are taken",
                 name, value, i % row, i / row % rows, i / row / rows, LARGEST_SPEED);
  else
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: %s is %g at sample (%zu, %zu); speeds up to %g are taken",
                      name, value, i % row, i / row, LARGEST_SPEED);
  fg__hint(context, "is it a fill value that is not declared as missing?");
  return status;
}

static fg_status copy_samples(fg_field *field, fg_context *context,
                              const fg_field_arrays *arrays)
{
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    count *= (size_t)arrays->size[k]; /* check_size: no overflow */
  for (int k = 0; k < arrays->dimension; ++k) {
    field->velocity[k] = fg__allocate(count, sizeof(float));
    if (!field->velocity[k])
      return fg__fail_memory(context, "the velocity", count * sizeof(float));
    field->contents.velocity[k] = field->velocity[k];
  }
  field->valid = fg__allocate(count, 1);
  if (!field->valid)
    return fg__fail_memory(context, "the mask", count);
  size_t missing = 0;
  for (size_t i = 0; i < count; ++i) {
    field->valid[i] = sample_is_valid(arrays, i);
    missing += !field->valid[i];
    for (int k = 0; k < arrays->dimension; ++k) {
      const float value = field->valid[i] ? arrays->velocity[k][i] : NAN;
      field->velocity[k][i] = value;
      if (isinf(value) || fabs((double)value) > LARGEST_SPEED)
        return fail_speed(field, context, k, (double)value, i);
    }
  }
  if (missing == count)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: all %zu samples are missing",
                    count);
  if (missing == 0) {
    free(field->valid);
    field->valid = NULL;
  }
  field->contents.valid = field->valid;
  return FG_STATUS_OK;
}

static bool moves(const fg_field *field, size_t i)
{
  for (int k = 0; k < field->contents.dimension; ++k)
    if (field->velocity[k][i] != 0.0f)
      return true;
  return false;
}

/* Marks a row of cells; returns how many are valid, and sets *moving when one moves. */
static size_t find_row(fg_field *field, int j, int k, unsigned char *valid_cell,
                       bool *moving)
{
  size_t valid_cells = 0;
  for (int i = 0; i < field->axis[0].cells; ++i) {
    size_t corner[FG__FIELD_CORNERS];
    fg__field_corners_of(field, i, j, k, corner);
    bool valid = true;
    bool corner_moves = false;
    for (int c = 0; c < fg__field_corners(field); ++c) {
      valid = valid && (!field->valid || field->valid[corner[c]]);
      corner_moves = corner_moves || moves(field, corner[c]);
    }
    valid_cell[i] = valid;
    valid_cells += valid;
    *moving = *moving || (valid && corner_moves);
  }
  return valid_cells;
}

/* A cell counts when all its corners do; at least one must, and the velocity must not be
 * zero in all of them. */
static fg_status find_cells(fg_field *field, fg_context *context)
{
  const int columns = field->axis[0].cells;
  const int rows = field->axis[1].cells;
  const int layers = field->contents.dimension == 3 ? field->axis[2].cells : 1;
  const size_t count = (size_t)columns * (size_t)rows * (size_t)layers;
  field->valid_cell = fg__allocate(count, 1);
  if (!field->valid_cell)
    return fg__fail_memory(context, "the cells", count);
  size_t valid_cells = 0;
  bool moving = false;
  unsigned char *row = field->valid_cell;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < rows; ++j, row += columns)
      valid_cells += find_row(field, j, k, row, &moving);
  if (valid_cells == 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: none of its %zu cells has a value at every corner", count);
  if (!moving)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: the velocity is zero everywhere (%zu cells)", valid_cells);
  if (valid_cells == count) {
    free(field->valid_cell);
    field->valid_cell = NULL;
  }
  return FG_STATUS_OK;
}

static bool copy_word(fg_field *field, const char **slot, const char *text,
                      const char *otherwise)
{
  if (!text)
    text = otherwise;
  *slot = NULL;
  if (!text)
    return true;
  char *copy = fg__copy_text(text);
  if (!copy)
    return false;
  field->word[field->words++] = copy;
  *slot = copy;
  return true;
}

static fg_status copy_words(fg_field *field, fg_context *context,
                            const fg_field_arrays *arrays)
{
  static const char *const component[] = {"u", "v", "w"};
  static const char *const direction[] = {"x", "y", "z"};
  fg_field_arrays *own = &field->contents;
  bool copied = true;
  for (int k = 0; k < 3; ++k) {
    copied = copied && copy_word(field, &own->velocity_name[k], arrays->velocity_name[k],
                                 component[k]);
    copied = copied &&
             copy_word(field, &own->axis_name[k], arrays->axis_name[k], direction[k]);
    copied = copied && copy_word(field, &own->axis_units[k], arrays->axis_units[k], "");
  }
  copied = copied && copy_word(field, &own->velocity_units, arrays->velocity_units, "");
  copied = copied && copy_word(field, &own->title, arrays->title, "");
  copied = copied && copy_word(field, &own->time, arrays->time, NULL);
  copied = copied && copy_word(field, &own->level, arrays->level, NULL);
  return copied ? FG_STATUS_OK : fg__fail_memory(context, "the field's words", 0);
}

fg_status fg_field_create(fg_field **out, fg_context *context,
                          const fg_field_arrays *arrays)
{
  if (!out || !arrays)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: no arrays to make it from");
  *out = NULL;
  fg_status status = check_arrays(context, arrays);
  if (status != FG_STATUS_OK)
    return status;
  fg_field *field = fg__allocate(1, sizeof *field);
  if (!field)
    return fg__fail_memory(context, "a field", sizeof *field);
  field->contents.dimension = arrays->dimension;
  field->contents.scale = arrays->scale == FG_SCALE_AUTO ? FG_SCALE_PLAIN : arrays->scale;
  status = copy_words(field, context, arrays);
  for (int k = 0; k < arrays->dimension && status == FG_STATUS_OK; ++k) {
    field->contents.size[k] = arrays->size[k];
    field->contents.period[k] = arrays->period[k];
    status = copy_axis(field, context, arrays, k);
  }
  if (arrays->dimension == 2)
    field->contents.size[2] = 1;
  if (status == FG_STATUS_OK)
    status = copy_samples(field, context, arrays);
  if (status == FG_STATUS_OK)
    status = find_cells(field, context);
  if (status != FG_STATUS_OK) {
    fg_field_destroy(field);
    return status;
  }
  *out = field;
  return FG_STATUS_OK;
}

void fg_field_destroy(fg_field *field)
{
  if (!field)
    return;
  for (int k = 0; k < 3; ++k) {
    free(field->axis[k].coordinate);
    free(field->axis[k].inverse_width);
    free(field->velocity[k]);
  }
  for (int i = 0; i < field->words; ++i)
    free(field->word[i]);
  free(field->valid);
  free(field->valid_cell);
  free(field);
}

const fg_field_arrays *fg_field_contents(const fg_field *field)
{
  return field ? &field->contents : NULL;
}
