/* Any bytes as a GRIB file: on axes, by parts, or on the sphere. */
#include "fuzz.h"

#include "fields.h"

bool fg__fuzz_was_read;

static bool try_sphere(const uint8_t *bytes, size_t size)
{
  static const fg_read_options options = {0};
  const fg__source source = {.path = "fuzz.grb", .bytes = bytes, .size = size};
  fg_context *context;
  fg__sphere *sphere = NULL;
  fg_field *field = NULL;
  if (!fg__format_grib.is_mine(bytes, size) || fg_context_create(&context))
    return false;
  fg_status status =
      fg__dataset_sphere(&sphere, context, &fg__format_grib, &source, &options);
  assert(status == FG_STATUS_OK || (!sphere && fg_context_message(context)[0]));
  if (sphere)
    status = fg__globe_field(&field, context, sphere, (fg__slab_index){0, 1});
  assert(status == FG_STATUS_OK || (!field && fg_context_message(context)[0]));
  const bool was_read = field != NULL;
  fg_field_destroy(field);
  fg__sphere_destroy(sphere);
  fg_context_destroy(context);
  return was_read;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  const bool on_axes = try_format(&fg__format_grib, "fuzz.grb", bytes, size);
  fg__fuzz_was_read = on_axes || try_sphere(bytes, size);
  return 0;
}
