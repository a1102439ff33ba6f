#include "base/context.h"
#include "base/memory.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMPONENTS = 2, CORNERS = 4, WORDS = 13 };

/* Larger speeds are refused: light makes 3e8 m/s (3e14 um/s), so they are fill values
 * that the file did not declare; and up to here (v / cos latitude)^2 is finite in float.
 */
static const double LARGEST_SPEED = 1e15;

/* Larger coordinates are refused: 1e20 and more are customary fill values, and the
 * squares of those up to here are far from overflow in double. */
static const double LARGEST_COORDINATE = 1e18;

/* cos(latitude) is kept above that of a hundredth of a degree off the pole, nearer than
 * the rows of any grid in use: the direction there is east or west, its limit, and
 * finite. */
static const double SMALLEST_COSINE = 1.745e-4;

/* Rows a rounding error beyond the pole are taken (90.00001 in float), none farther. */
static const double LARGEST_LATITUDE = 90.001;

static const double RADIANS_PER_DEGREE = 0.017453292519943295;

/* One axis as the lookup sees it: `cells` intervals between cells + 1 coordinates; on a
 * periodic axis the last interval ends at the first sample's repetition. */
typedef struct axis_lookup {
  double *coordinate;
  double *inverse_width;
  int cells;
  int samples;
  double period;
  bool even; /* every sample within a quarter of a cell of the even spacing */
  double inverse_spacing;
} axis_lookup;

struct fg_field {
  fg_field_arrays contents;
  axis_lookup axis[COMPONENTS];
  float *velocity[COMPONENTS];
  unsigned char *valid;      /* NULL: all */
  unsigned char *valid_cell; /* NULL: all */
  char *word[WORDS];         /* owned copies of the texts */
  int words;
};

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

static fg_status check_arrays(fg_context *context, const fg_field_arrays *arrays)
{
  if (arrays->dimension != COMPONENTS)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: %d dimensions; only fields in 2 dimensions are handled yet",
                    arrays->dimension);
  for (int k = 0; k < COMPONENTS; ++k)
    if (arrays->size[k] < 2 || arrays->size[k] == INT_MAX)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: a grid of %d x %d samples; at least 2 x 2 are needed",
                      arrays->size[0], arrays->size[1]);
  for (int k = 0; k < COMPONENTS; ++k) {
    if (!arrays->velocity[k])
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: velocity component %d is missing", k);
    fg_status status = check_axis(context, arrays, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  if ((int)arrays->scale < FG_SCALE_AUTO || (int)arrays->scale > FG_SCALE_PLAIN)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: unknown scale %d",
                    (int)arrays->scale);
  if (arrays->scale == FG_SCALE_GEO) {
    const double south = arrays->axis[1][0];
    const double north = arrays->axis[1][arrays->size[1] - 1];
    if (south < -LARGEST_LATITUDE || north > LARGEST_LATITUDE)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: latitudes from %g to %g go beyond the poles", south, north);
  }
  return FG_STATUS_OK;
}

static fg_status copy_axis(fg_field *field, fg_context *context,
                           const fg_field_arrays *arrays, int k)
{
  axis_lookup *axis = &field->axis[k];
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
  return !isnan(arrays->velocity[0][i]) && !isnan(arrays->velocity[1][i]);
}

static fg_status fail_speed(const fg_field *field, fg_context *context, int k,
                            double value, size_t i)
{
  const size_t row = (size_t)field->contents.size[0];
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT,
               "field: %s is %g at sample (%zu, %zu); speeds up to %g are taken",
               field->contents.velocity_name[k], value, i % row, i / row, LARGEST_SPEED);
  fg__hint(context, "is it a fill value that is not declared as missing?");
  return status;
}

static fg_status copy_samples(fg_field *field, fg_context *context,
                              const fg_field_arrays *arrays)
{
  const size_t row = (size_t)arrays->size[0];
  const size_t count = row * (size_t)arrays->size[1]; /* below 2^62: no overflow */
  for (int k = 0; k < COMPONENTS; ++k) {
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
    for (int k = 0; k < COMPONENTS; ++k) {
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

/* Sample indices of a cell's corners: (0,0), (1,0), (0,1), (1,1). */
static void corners_of(const fg_field *field, int i, int j, size_t corner[CORNERS])
{
  const int right = i + 1 == field->axis[0].samples ? 0 : i + 1;
  const int upper = j + 1 == field->axis[1].samples ? 0 : j + 1;
  const size_t row = (size_t)field->axis[0].samples;
  corner[0] = (size_t)j * row + (size_t)i;
  corner[1] = (size_t)j * row + (size_t)right;
  corner[2] = (size_t)upper * row + (size_t)i;
  corner[3] = (size_t)upper * row + (size_t)right;
}

static bool moves(const fg_field *field, size_t i)
{
  return field->velocity[0][i] != 0.0f || field->velocity[1][i] != 0.0f;
}

/* A cell counts when all its corners do; at least one must, and the velocity must not be
 * zero in all of them. */
static fg_status find_cells(fg_field *field, fg_context *context)
{
  const int columns = field->axis[0].cells;
  const int rows = field->axis[1].cells;
  const size_t count = (size_t)columns * (size_t)rows;
  field->valid_cell = fg__allocate(count, 1);
  if (!field->valid_cell)
    return fg__fail_memory(context, "the cells", count);
  size_t valid_cells = 0;
  bool moving = false;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      size_t corner[CORNERS];
      corners_of(field, i, j, corner);
      bool valid = true;
      bool corner_moves = false;
      for (int c = 0; c < CORNERS; ++c) {
        valid = valid && (!field->valid || field->valid[corner[c]]);
        corner_moves = corner_moves || moves(field, corner[c]);
      }
      field->valid_cell[(size_t)j * (size_t)columns + (size_t)i] = valid;
      valid_cells += valid;
      moving = moving || (valid && corner_moves);
    }
  }
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
  for (int k = 0; k < COMPONENTS && status == FG_STATUS_OK; ++k) {
    field->contents.size[k] = arrays->size[k];
    field->contents.period[k] = arrays->period[k];
    status = copy_axis(field, context, arrays, k);
  }
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
  for (int k = 0; k < COMPONENTS; ++k) {
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

/* Brings x into [first, first + period); fmod is exact, so that any x is wrapped without
 * drift. */
static double wrap(const axis_lookup *axis, double x)
{
  const double first = axis->coordinate[0];
  if (x >= first && x < axis->coordinate[axis->cells])
    return x;
  double offset = fmod(x - first, axis->period);
  if (offset < 0.0)
    offset += axis->period;
  x = first + offset;
  return x < axis->coordinate[axis->cells] ? x : first;
}

/* The cell that holds x, or -1 outside the axis, and where in it x lies, in [0, 1]. */
static int find_cell(const axis_lookup *axis, double x, double *fraction)
{
  const double *coordinate = axis->coordinate;
  if (axis->period > 0.0 && isfinite(x))
    x = wrap(axis, x);
  if (!(x >= coordinate[0] && x <= coordinate[axis->cells]))
    return -1;
  int cell;
  if (axis->even) {
    cell = (int)((x - coordinate[0]) * axis->inverse_spacing);
    cell = cell < axis->cells ? cell : axis->cells - 1;
    while (cell > 0 && x < coordinate[cell])
      --cell;
    while (cell < axis->cells - 1 && x >= coordinate[cell + 1])
      ++cell;
  } else {
    cell = 0;
    int beyond = axis->cells;
    while (beyond - cell > 1) {
      const int middle = cell + (beyond - cell) / 2;
      if (x >= coordinate[middle])
        cell = middle;
      else
        beyond = middle;
    }
  }
  const double inside = (x - coordinate[cell]) * axis->inverse_width[cell];
  *fraction = inside < 1.0 ? inside : 1.0;
  return cell;
}

bool fg_field_velocity(const fg_field *field, const double position[], double velocity[])
{
  double s;
  double t;
  const int i = find_cell(&field->axis[0], position[0], &s);
  if (i < 0)
    return false;
  const int j = find_cell(&field->axis[1], position[1], &t);
  if (j < 0)
    return false;
  const size_t cell = (size_t)j * (size_t)field->axis[0].cells + (size_t)i;
  if (field->valid_cell && !field->valid_cell[cell])
    return false;
  size_t corner[CORNERS];
  corners_of(field, i, j, corner);
  for (int k = 0; k < COMPONENTS; ++k) {
    const float *sample = field->velocity[k];
    const double lower =
        (1.0 - s) * (double)sample[corner[0]] + s * (double)sample[corner[1]];
    const double upper =
        (1.0 - s) * (double)sample[corner[2]] + s * (double)sample[corner[3]];
    velocity[k] = (1.0 - t) * lower + t * upper;
  }
  return true;
}

bool fg_field_tangent(const fg_field *field, const double position[], double tangent[])
{
  if (!fg_field_velocity(field, position, tangent))
    return false;
  if (field->contents.scale == FG_SCALE_GEO) {
    /* dlon/dt = u / (R cos latitude), dlat/dt = v / R */
    const double cosine = cos(position[1] * RADIANS_PER_DEGREE);
    tangent[0] /= cosine > SMALLEST_COSINE ? cosine : SMALLEST_COSINE;
  }
  return true;
}
