#include "field/slab.h"

#include "base/memory.h"
#include "base/utf8.h"
#include "field/fingerprint.h"
#include "field/refused.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

bool fg__field_is_missing(const fg_field_arrays *arrays, size_t i)
{
  if (arrays->valid && !arrays->valid[i])
    return true;
  for (int k = 0; k < arrays->dimension; ++k)
    if (isnan(arrays->velocity[k][i]))
      return true;
  return false;
}

static bool sample_is_infinite(const fg_field_arrays *arrays, size_t i)
{
  for (int k = 0; k < arrays->dimension; ++k)
    if (isinf(arrays->velocity[k][i]))
      return true;
  return false;
}

/* The number of its own samples; those after them belong to the next part. */
static size_t own_samples(const fg_field *field)
{
  const size_t rows = (size_t)field->held[fg__field_last_axis(field)];
  return fg__field_held(field) / rows * (field->slab ? (size_t)field->slab->own : rows);
}

/* Copies the samples of the field, or takes over the arrays `taken`, and counts those
 * that are missing, which become NaN. */
static fg_status copy_samples(fg_field *field, fg_context *context,
                              const fg_field_arrays *arrays, float *taken[3],
                              size_t *missing)
{
  const size_t count = fg__field_held(field); /* check_size: no overflow */
  const size_t own = own_samples(field);
  for (int k = 0; k < arrays->dimension; ++k) {
    field->velocity[k] = taken ? taken[k] : fg__allocate(count, sizeof(float));
    if (!field->velocity[k])
      return fg__fail_memory(context, "the velocity", count * sizeof(float));
    field->contents.velocity[k] = field->velocity[k];
    if (taken)
      taken[k] = NULL;
  }
  for (size_t i = 0; i < count; ++i) {
    const bool present = !fg__field_is_missing(arrays, i);
    const bool infinite = present && sample_is_infinite(arrays, i);
    const bool valid = present && !infinite;
    if (valid && fg__is_missing_code(arrays->velocity, arrays->dimension, i))
      return fg__field_fail_code(field, context, (double)arrays->velocity[0][i], i);
    *missing += !valid;
    field->missing += !valid && i < own;
    field->infinite += infinite && i < own;
    for (int k = 0; k < arrays->dimension; ++k) {
      const float value = valid ? arrays->velocity[k][i] : NAN;
      field->velocity[k][i] = value;
      if (fabs((double)value) > fg__field_largest_speed)
        return fg__field_fail_speed(field, context, k, (double)value, i);
    }
  }
  return FG_STATUS_OK;
}

static fg_status mark_missing(fg_field *field, fg_context *context)
{
  const size_t count = fg__field_held(field);
  field->contents.valid = field->valid = fg__allocate(count, 1);
  if (!field->valid)
    return fg__fail_memory(context, "the mask", count);
  for (size_t i = 0; i < count; ++i) {
    const bool valid = !isnan(field->velocity[0][i]);
    field->valid[i] = valid;
  }
  return FG_STATUS_OK;
}

static bool moves(const fg_field *field, size_t i)
{
  for (int k = 0; k < field->contents.dimension; ++k)
    if (field->velocity[k][i] != 0.0f)
      return true;
  return false;
}

/* Counts a row of cells; sets valid_cell unless that is NULL. */
static void find_row(const fg_field *field, int j, int k, unsigned char *valid_cell,
                     fg__slab_counts *counts)
{
  for (int i = 0; i < field->axis[0].cells; ++i) {
    size_t corner[FG__FIELD_CORNERS];
    fg__field_corners_of(field, i, j, k, corner);
    bool valid = true;
    bool corner_moves = false;
    for (int c = 0; c < fg__field_corners(field); ++c) {
      valid = valid && !isnan(field->velocity[0][corner[c]]);
      corner_moves = corner_moves || moves(field, corner[c]);
    }
    if (valid_cell)
      valid_cell[i] = valid;
    ++counts->cells;
    counts->valid_cells += valid;
    counts->moving_cells += valid && corner_moves;
  }
}

/* The cells whose lower corners lie in rows [first, end) along the last axis. */
static void find_cells(const fg_field *field, int first, int end,
                       unsigned char *valid_cell, fg__slab_counts *counts)
{
  const int dimension = field->contents.dimension, columns = field->axis[0].cells;
  const int cells = field->axis[dimension - 1].cells;
  end = end < cells ? end : cells;
  for (int n = first; n < end; ++n)
    for (int j = 0; j < (dimension == 3 ? field->axis[1].cells : 1); ++j) {
      find_row(field, dimension == 3 ? j : n, dimension == 3 ? n : 0, valid_cell, counts);
      if (valid_cell)
        valid_cell += columns;
    }
}

/* A cell counts when all its corners do; at least one must, and the velocity must not be
 * zero in all of them. */
fg_status fg__field_check_counts(fg_context *context, const fg__slab_counts *counts)
{
  if (counts->missing == counts->samples)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: all %" PRIu64 " samples are missing", counts->samples);
  if (counts->valid_cells == 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: none of its %" PRIu64 " cells has a value at every corner",
                    counts->cells);
  if (counts->moving_cells == 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: the velocity is zero everywhere (%" PRIu64 " cells)",
                    counts->valid_cells);
  return FG_STATUS_OK;
}

/* Where no sample is missing every cell is valid, and one that moves is enough. */
static void count_all_cells(const fg_field *field, size_t cells, fg__slab_counts *counts)
{
  counts->cells = counts->valid_cells = cells;
  for (size_t i = 0; i < counts->samples && !counts->moving_cells; ++i)
    counts->moving_cells = moves(field, i);
}

static fg_status fill_whole(fg_field *field, fg_context *context,
                            const fg_field_arrays *arrays, float *taken[3])
{
  fg__slab_counts counts = {.samples = fg__field_held(field)};
  size_t missing = 0, cells = 1;
  fg_status status = copy_samples(field, context, arrays, taken, &missing);
  if (status != FG_STATUS_OK)
    return status;
  counts.missing = missing;
  for (int k = 0; k < arrays->dimension; ++k)
    cells *= (size_t)field->axis[k].cells;
  if (missing == 0)
    count_all_cells(field, cells, &counts);
  if (missing == 0 || missing == counts.samples)
    return fg__field_check_counts(context, &counts);
  status = mark_missing(field, context);
  field->valid_cell = status == FG_STATUS_OK ? fg__allocate(cells, 1) : NULL;
  if (!field->valid_cell)
    return status == FG_STATUS_OK ? fg__fail_memory(context, "the cells", cells) : status;
  find_cells(field, 0, field->held[fg__field_last_axis(field)], field->valid_cell,
             &counts);
  return fg__field_check_counts(context, &counts);
}

static fg_status fill_part(fg_field *field, fg_context *context,
                           const fg_field_arrays *arrays, float *taken[3])
{
  fg__field_slab *slab = field->slab;
  fg__slab_counts *counts = &slab->counts;
  const int last = fg__field_last_axis(field);
  const int first = field->first[last];
  size_t missing = 0;
  fg_status status = copy_samples(field, context, arrays, taken, &missing);
  if (status != FG_STATUS_OK)
    return status;
  counts->samples = own_samples(field);
  counts->infinite = field->infinite;
  counts->missing = field->missing;
  find_cells(field, first, first + slab->own, NULL, counts);
  counts->fingerprint = fg__field_fingerprint_samples(field);
  slab->key = fg__field_fingerprint_grid(field);
  return FG_STATUS_OK;
}

const char **fg__arrays_word(fg_field_arrays *arrays, int n)
{
  const char **const place[FG__FIELD_WORDS] = {&arrays->velocity_name[0],
                                               &arrays->velocity_name[1],
                                               &arrays->velocity_name[2],
                                               &arrays->axis_name[0],
                                               &arrays->axis_name[1],
                                               &arrays->axis_name[2],
                                               &arrays->axis_units[0],
                                               &arrays->axis_units[1],
                                               &arrays->axis_units[2],
                                               &arrays->velocity_units,
                                               &arrays->title,
                                               &arrays->time,
                                               &arrays->level,
                                               &arrays->projection,
                                               &arrays->doubts};
  return place[n];
}

static fg_status copy_words(fg_field *field, fg_context *context,
                            const fg_field_arrays *arrays)
{
  static const char *const otherwise[FG__FIELD_WORDS] = {"u", "v", "w", "x", "y", "z",
                                                         "",  "",  "",  "",  ""};
  fg_field_arrays given = *arrays;
  for (int n = 0; n < FG__FIELD_WORDS; ++n) {
    const char *text = *fg__arrays_word(&given, n);
    if (!text)
      text = otherwise[n];
    char *copy = fg__utf8_copy(text);
    if (text && !copy)
      return fg__fail_memory(context, "the field's words", strlen(text) + 1);
    *fg__arrays_word(&field->contents, n) = copy;
    if (copy)
      field->word[field->words++] = copy;
  }
  return FG_STATUS_OK;
}

fg_status fg__field_set_title(fg_field *field, fg_context *context, const char *title)
{
  char *copy = fg__utf8_copy(title);
  if (!copy)
    return fg__fail_memory(context, "the field's words", 0);
  for (int i = 0; i < field->words; ++i)
    if (field->word[i] == field->contents.title) {
      free(field->word[i]);
      field->word[i] = copy;
    }
  field->contents.title = copy;
  return FG_STATUS_OK;
}

static fg_status begin_part(fg_field *field, fg_context *context, int number, int count)
{
  const int last = fg__field_last_axis(field), rows = field->axis[last].samples;
  fg__field_slab *slab = field->slab = fg__allocate(1, sizeof *slab);
  if (!slab)
    return fg__fail_memory(context, "a part of a field", sizeof *slab);
  slab->number = number;
  slab->count = count;
  fg__slab_rows(&field->first[last], &slab->own, rows, number, count);
  field->held[last] = fg__slab_rows_held(rows, field->first[last], slab->own,
                                         field->axis[last].period > 0.0);
  return FG_STATUS_OK;
}

/* number < 0: all of it. */
static fg_status create(fg_field **out, fg_context *context,
                        const fg_field_arrays *arrays, float *taken[3], int number,
                        int count)
{
  *out = NULL;
  fg_status status = check_arrays(context, arrays);
  if (status == FG_STATUS_OK && number >= 0 &&
      (number >= count || count < 2 || count > arrays->size[arrays->dimension - 1]))
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: part %d of %d of a grid with %d rows", number, count,
                      arrays->size[arrays->dimension - 1]);
  if (status != FG_STATUS_OK)
    return status;
  double samples = number < 0 ? 1.0 : 1.0 / count;
  for (int k = 0; k < 3 && k < arrays->dimension; ++k)
    samples *= arrays->size[k];
  status = fg__check_memory(context, "field", samples,
                            arrays->dimension * (double)sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  fg_field *field = fg__allocate(1, sizeof *field);
  if (!field)
    return fg__fail_memory(context, "a field", sizeof *field);
  field->contents.dimension = arrays->dimension;
  field->contents.scale = arrays->scale == FG_SCALE_AUTO ? FG_SCALE_PLAIN : arrays->scale;
  status = copy_words(field, context, arrays);
  for (int k = 0; k < arrays->dimension && status == FG_STATUS_OK; ++k) {
    field->held[k] = field->contents.size[k] = arrays->size[k];
    field->contents.period[k] = arrays->period[k];
    status = copy_axis(field, context, arrays, k);
  }
  if (arrays->dimension == 2)
    field->held[2] = field->contents.size[2] = 1;
  if (status == FG_STATUS_OK && number >= 0)
    status = begin_part(field, context, number, count);
  if (status == FG_STATUS_OK)
    status = (number < 0 ? fill_whole : fill_part)(field, context, arrays, taken);
  if (status != FG_STATUS_OK) {
    fg_field_destroy(field);
    return status;
  }
  *out = field;
  return FG_STATUS_OK;
}

fg_status fg_field_create(fg_field **out, fg_context *context,
                          const fg_field_arrays *arrays)
{
  if (out)
    *out = NULL;
  if (!out || !arrays)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: no arrays to make it from");
  return create(out, context, arrays, NULL, -1, 1);
}

fg_status fg__field_take(fg_field **out, fg_context *context,
                         const fg_field_arrays *arrays, float *taken[3])
{
  return create(out, context, arrays, taken, -1, 1);
}

fg_status fg__field_create_slab(fg_field **out, fg_context *context,
                                const fg_field_arrays *arrays, float *taken[3],
                                int number, int count)
{
  return create(out, context, arrays, taken, number, count);
}

void fg_field_destroy(fg_field *field)
{
  if (!field)
    return;
  for (int k = 0; k < 3; ++k) {
    free(field->velocity[k]);
    if (field->of)
      continue; /* borrowed */
    free(field->axis[k].coordinate);
    free(field->axis[k].inverse_width);
  }
  for (int i = 0; i < field->words; ++i)
    free(field->word[i]);
  if (field->slab) {
    free(field->slab->input);
    free(field->slab->valid);
    free(field->slab);
  }
  free(field->valid);
  free(field->valid_cell);
  free(field);
}

size_t fg_field_infinite(const fg_field *field)
{
  return field ? (size_t)field->infinite : 0;
}

const fg_field_arrays *fg_field_contents(const fg_field *field)
{
  return field ? &field->contents : NULL;
}
