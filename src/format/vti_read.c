/* VTK XML image data as a field. */
#include "base/memory.h"
#include "format/number_text.h"
#include "format/vti.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  MARK_WITHIN =
      4096, /* a file's first tag begins this early, comments before it included */
  DESCRIBED_SAMPLES = 64, /* vectors whose missing share an inventory counts */
  NAME_BYTES = 256
};

static const char LETTERS[] = "xyz";

/* ---- the seam
 * ---------------------------------------------------------------------------- */

static bool is_mine(const unsigned char *bytes, size_t size)
{
  static const char mark[] = "<VTKFile";
  size_t at = 0;
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) /* a byte order mark */
    at = 3;
  while (at < size && strchr(" \t\r\n", bytes[at]) && bytes[at])
    ++at;
  if (at == size || bytes[at] != '<')
    return false;
  for (; at + sizeof mark - 1 <= size && at < MARK_WITHIN; ++at)
    if (memcmp(bytes + at, mark, sizeof mark - 1) == 0)
      return true;
  return false;
}

/* ---- words
 * -------------------------------------------------------------------------------- */

/* The moment that FieldData tells in TimeValue, as "t = 2.5"; *out stays NULL without. */
static fg_status read_time(char **out, const fg__vti *vti)
{
  const fg__vti_array *array = fg__vti_find(vti, 0, FG__VTI_FIELD, "TimeValue");
  if (!array)
    return FG_STATUS_OK;
  fg__vti_values values;
  fg_status status = fg__vti_values_create(&values, vti, array, 1);
  if (status != FG_STATUS_OK)
    return status;
  char number[FG__NUMBER_BYTES], words[FG__NUMBER_BYTES + 8];
  fg__number_locale locale;
  if (fg__number_locale_begin(&locale)) {
    fg__number_write(number, fg__vti_value(&values, 0));
    fg__number_locale_end(&locale);
    snprintf(words, sizeof words, "t = %s", number);
    *out = fg__copy_text(words);
  }
  fg__vti_values_clear(&values);
  return *out ? FG_STATUS_OK : fg__fail_memory(vti->context, "words", sizeof words);
}

/* "U_x" for a vector variable U; a scalar's own name. */
static void name_component(char name[NAME_BYTES], const fg__vti_vector *vector, int axis,
                           int component)
{
  if (vector->names > 1)
    snprintf(name, NAME_BYTES, "%.200s", vector->name[component]);
  else
    snprintf(name, NAME_BYTES, "%.200s_%c", vector->name[0], LETTERS[axis]);
}

/* ---- reading
 * ------------------------------------------------------------------------------ */

static fg_status check_options(fg_context *context, const fg__source *source,
                               const fg_read_options *options)
{
  if (options->vars_from)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a second file with the other component cannot be used with VTK "
                    "files",
                    source->path);
  if (options->time != 0 || options->level != 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %s %d is asked for, but the file holds one only, number 0",
                    source->path, options->time != 0 ? "time" : "level",
                    options->time != 0 ? options->time : options->level);
  return FG_STATUS_OK;
}

static fg_status create_axes(double *out[2], const fg__vti *vti,
                             const fg__vti_plane *plane)
{
  for (int k = 0; k < 2; ++k) {
    int axis = plane->axis[k];
    out[k] = fg__allocate(plane->points[k], sizeof(double));
    if (!out[k])
      return fg__fail_memory(vti->context, "an axis", plane->points[k] * sizeof(double));
    for (size_t i = 0; i < plane->points[k]; ++i)
      out[k][i] = vti->origin[axis] +
                  vti->spacing[axis] * ((double)vti->extent[2 * axis] + (double)i);
    if (!(out[k][1] > out[k][0]) || !isfinite(out[k][plane->points[k] - 1]))
      return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                      "%s: points along %c from %g in steps of %g are no axis", vti->path,
                      LETTERS[axis], out[k][0], vti->spacing[axis]);
  }
  return FG_STATUS_OK;
}

static fg_status build(fg_field **out, const fg__vti *vti, const fg__vti_plane *plane,
                       const fg__vti_vector *vector, const fg_read_options *options)
{
  float *velocity[2] = {NULL, NULL};
  double *axis[2] = {NULL, NULL};
  char *time = NULL;
  fg_status status = create_axes(axis, vti, plane);
  if (status == FG_STATUS_OK)
    status = read_time(&time, vti);
  if (status == FG_STATUS_OK)
    status = fg__vti_plane_read(velocity, vti, plane, vector, options->mask);
  if (status == FG_STATUS_OK) {
    char component[2][NAME_BYTES], axis_name[2][2] = {"", ""};
    fg_field_arrays arrays = {.dimension = 2,
                              .scale = options->scale == FG_SCALE_AUTO ? FG_SCALE_PLAIN
                                                                       : options->scale,
                              .velocity_units = vector->units,
                              .title = vector->names == 1 ? vector->name[0] : NULL,
                              .time = time};
    for (int k = 0; k < 2; ++k) {
      name_component(component[k], vector, plane->axis[k],
                     vector->components == 3 ? plane->axis[k] : k);
      axis_name[k][0] = LETTERS[plane->axis[k]];
      arrays.size[k] = (int)plane->points[k];
      arrays.axis[k] = axis[k];
      arrays.velocity[k] = velocity[k];
      arrays.velocity_name[k] = component[k];
      arrays.axis_name[k] = axis_name[k];
    }
    status = fg_field_create(out, vti->context, &arrays);
  }
  for (int k = 0; k < 2; ++k) {
    free(velocity[k]);
    free(axis[k]);
  }
  free(time);
  return status;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options)
{
  *out = NULL;
  fg_status status = check_options(context, source, options);
  if (status != FG_STATUS_OK)
    return status;
  fg__vti vti;
  fg__vti_plane plane;
  fg__vti_vector vector;
  char *names = NULL;
  status = fg__vti_open(&vti, context, source);
  if (status == FG_STATUS_OK)
    status = fg__vti_choose(&vector, &names, &vti, options->vars);
  if (status == FG_STATUS_OK)
    status = fg__vti_plane_find(&plane, &vti);
  if (status == FG_STATUS_OK)
    status = build(out, &vti, &plane, &vector, options);
  free(names);
  fg__vti_close(&vti);
  return status;
}

/* ---- inventory
 * ------------------------------------------------------------------------------ */

static fg_status count_missing(double *share, const fg__vti *vti,
                               const fg__vti_plane *plane, const fg__vti_vector *vector)
{
  float *velocity[2];
  fg_status status = fg__vti_plane_read(velocity, vti, plane, vector, NULL);
  if (status != FG_STATUS_OK)
    return status;
  size_t count = plane->points[0] * plane->points[1], missing = 0;
  for (size_t i = 0; i < count; ++i)
    if (isnan(velocity[0][i]) || isnan(velocity[1][i]))
      ++missing;
  *share = (double)missing / (double)count;
  free(velocity[0]);
  free(velocity[1]);
  return FG_STATUS_OK;
}

static void set_bounds(fg_inventory_vector *entry, const fg__vti *vti, int k, int axis)
{
  entry->size[k] = (int)fg__vti_length(vti->extent, axis, FG__VTI_POINTS);
  for (int end = 0; end < 2; ++end)
    entry->bounds[2 * k + end] =
        vti->origin[axis] + vti->spacing[axis] * (double)vti->extent[2 * axis + end];
}

/* What is not supported is said of the vector, not held against the file. */
static fg_status describe(fg_inventory_vector *entry, const fg__vti *vti,
                          const fg__vti_vector *vector, bool with_samples)
{
  fg__vti_plane plane;
  fg_status status = fg__vti_plane_find(&plane, vti);
  if (status == FG_STATUS_OK) {
    entry->dimension = 2;
    for (int k = 0; k < 2; ++k)
      set_bounds(entry, vti, k, plane.axis[k]);
    if (with_samples)
      status = count_missing(&entry->missing_share, vti, &plane, vector);
  } else {
    entry->dimension = 3;
    for (int k = 0; k < 3; ++k)
      set_bounds(entry, vti, k, k);
  }
  return status;
}

static fg_status inventory(fg_inventory *inventory, fg_context *context,
                           const fg__source *source)
{
  fg__vti vti;
  fg__vti_vector *vectors = NULL;
  size_t count = 0;
  fg_status status = fg__vti_open(&vti, context, source);
  if (status == FG_STATUS_OK)
    status = fg__vti_vectors(&vectors, &count, &vti);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i) {
    fg_inventory_vector entry = {.components = vectors[i].components,
                                 .units = vectors[i].units ? vectors[i].units : "",
                                 .found_by = vectors[i].found_by,
                                 .times = 1,
                                 .levels = 1,
                                 .scale = FG_SCALE_PLAIN};
    for (int k = 0; k < vectors[i].names; ++k)
      entry.name[k] = vectors[i].name[k];
    char *unusable = NULL;
    status = describe(&entry, &vti, &vectors[i], i < DESCRIBED_SAMPLES);
    if (status == FG_STATUS_UNSUPPORTED) {
      const char *message = fg_context_message(context);
      size_t prefix = strlen(source->path) + 2; /* "PATH: " is said elsewhere */
      unusable = fg__copy_text(strlen(message) > prefix ? message + prefix : message);
      entry.unusable = unusable;
      fg_context_clear(context);
      status = FG_STATUS_OK;
    }
    if (status == FG_STATUS_OK)
      status = fg__inventory_add(inventory, context, &entry);
    free(unusable);
  }
  free(vectors);
  fg__vti_close(&vti);
  return status;
}

const fg__format fg__format_vti = {.name = "VTK XML image data",
                                   .is_mine = is_mine,
                                   .inventory = inventory,
                                   .read = read_field};
