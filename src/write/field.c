/* Fields as VTK XML image data or as NetCDF. */
#include "field/field.h"
#include "base/memory.h"
#include "file/number_text.h"
#include "write/field_close.h"
#include "write/netcdf/netcdf.h"
#include "write/vti.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* vtkDataSetAttributes::HIDDENPOINT */
enum { HIDDEN_POINT = 2, NAME_BYTES = 256 };

/* An axis is even when no sample is off by more of a step than this: below what a picture
 * shows, above the rounding of coordinates that a file keeps in 32 bits. */
static const double LARGEST_UNEVENNESS = 1e-3;

static bool ends_with(const char *path, const char *end)
{
  size_t length = strlen(path), wanted = strlen(end);
  return length > wanted && strcmp(path + length - wanted, end) == 0;
}

static fg_status describe_axis(fg__vti_image *image, fg_context *context,
                               const char *path, const fg_field_arrays *field, int k)
{
  const double *axis = field->axis[k];
  int last = field->size[k] - 1;
  double spacing = (axis[last] - axis[0]) / last;
  for (int i = 0; i <= last; ++i)
    if (fabs(axis[i] - (axis[0] + i * spacing)) > LARGEST_UNEVENNESS * spacing) {
      fg__fail(
          context, FG_STATUS_UNSUPPORTED,
          "%s: the axis %s is uneven: sample %d is at %g, not at %g; an image has even "
          "axes",
          path, field->axis_name[k], i, axis[i], axis[0] + i * spacing);
      fg__hint(context, "write it as .nc");
      return FG_STATUS_UNSUPPORTED;
    }
  image->points[k] = field->size[k];
  image->origin[k] = axis[0];
  image->spacing[k] = spacing;
  return FG_STATUS_OK;
}

/* "U" for components U_x, U_y and U_z, as a reader of images made them; else "velocity".
 */
static void name_vector(char name[NAME_BYTES], const fg_field_arrays *field)
{
  const char *u = field->velocity_name[0];
  size_t length = strlen(u);
  snprintf(name, NAME_BYTES, "velocity");
  if (length <= 2 || length >= NAME_BYTES || u[length - 2] != '_')
    return;
  for (int k = 1; k < field->dimension; ++k)
    if (strlen(field->velocity_name[k]) != length ||
        strncmp(u, field->velocity_name[k], length - 1) != 0)
      return;
  snprintf(name, NAME_BYTES, "%.*s", (int)(length - 2), u);
}

static fg_status write_samples(FILE *stream, fg_context *context,
                               const fg_field_arrays *field, const char *name)
{
  size_t count = fg__field_samples(field);
  float *vectors = fg__allocate(count, 3 * sizeof *vectors);
  unsigned char *ghost = fg__allocate(count, 1);
  bool some_missing = false;
  fg_status status;
  if (!vectors || !ghost) {
    status = fg__fail_memory(context, "a field to write", count * 3 * sizeof *vectors);
    goto cleanup;
  }
  for (size_t i = 0; i < count; ++i) {
    bool missing = fg__field_is_missing(field, i);
    for (size_t k = 0; k < (size_t)field->dimension; ++k)
      vectors[3 * i + k] = missing ? NAN : field->velocity[k][i];
    ghost[i] = missing ? HIDDEN_POINT : 0;
    some_missing = some_missing || missing;
  }
  status = fg__vti_write_array(stream, context,
                               &(fg__vti_output){.name = name,
                                                 .type = "Float32",
                                                 .units = field->velocity_units,
                                                 .data = vectors,
                                                 .bytes = count * 3 * sizeof *vectors,
                                                 .components = 3});
  if (status == FG_STATUS_OK && some_missing)
    status = fg__vti_write_array(stream, context,
                                 &(fg__vti_output){.name = "vtkGhostType",
                                                   .type = "UInt8",
                                                   .data = ghost,
                                                   .bytes = count,
                                                   .components = 1});

cleanup:
  free(ghost);
  free(vectors);
  return status;
}

static fg_status write_image(fg_context *context, const char *path,
                             const fg_field_arrays *field)
{
  fg__vti_image image = {.field = field};
  for (int k = 0; k < field->dimension; ++k) {
    fg_status status = describe_axis(&image, context, path, field, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  char name[NAME_BYTES];
  name_vector(name, field);
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(context, "a locale", sizeof locale);
  fg__whole_file file = {0};
  fg_status status = fg__whole_file_open(&file, context, path);
  if (status == FG_STATUS_OK) {
    fg__vti_write_open(file.stream, &image, name, NULL);
    status = write_samples(file.stream, context, field, name);
    fg__vti_write_cells(file.stream);
    fg__vti_write_close(file.stream);
  }
  status = fg__whole_file_close(&file, context, status);
  fg__number_locale_end(&locale);
  return status;
}

fg_status fg_field_write(fg_context *context, const char *path, const fg_field *field)
{
  if (!path || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: %s to write",
                    path ? "none" : "no file name");
  if (fg_field_is_slab(field, NULL, NULL))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: a field that ranks share cannot be written", path);
  bool image = ends_with(path, ".vti");
  if (image || ends_with(path, ".nc")) {
    fg__closed_field closed;
    fg_status status =
        fg__closed_field_create(&closed, context, fg_field_contents(field));
    if (status == FG_STATUS_OK)
      status = image ? write_image(context, path, &closed.arrays)
                     : fg__netcdf_write(context, path, &closed.arrays);
    fg__closed_field_clear(&closed);
    return status;
  }
  fg_status status =
      fg__fail(context, FG_STATUS_UNSUPPORTED,
               "%s: fields are not written in a format of this name", path);
  fg__hint(context, "names end in .vti (VTK XML image data) or .nc (NetCDF)");
  return status;
}
