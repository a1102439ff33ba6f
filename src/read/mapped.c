#include "read/mapped.h"

#include "map/map.h"
#include "map/project.h"

#include <stdio.h>

/* On longitudes and latitudes, or on a plane that is to become another. */
static bool goes_on_map(const fg_field *field, const fg_map_options *map)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  return arrays->dimension == 2 &&
         (arrays->scale == FG_SCALE_GEO ||
          (arrays->scale == FG_SCALE_MAP && arrays->projection && fg__map_is_named(map)));
}

static fg_status refuse(fg_context *context, const char *path, const fg_field *field)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  fg_status status = fg__fail(
      context, FG_STATUS_ARGUMENT,
      "%s: no map can be made of it: its axes are '%s' (%s) and '%s' (%s), not longitude "
      "and latitude",
      path, arrays->axis_name[0], arrays->axis_units[0], arrays->axis_name[1],
      arrays->axis_units[1]);
  fg__hint(context, "--scale geo takes the axes for degrees");
  return status;
}

/* A projection that a file tells must be one, and name no files. */
static fg_status check_projection(fg_context *context, const char *path,
                                  const char *projection)
{
  enum { MESSAGE = 512 };
  char message[MESSAGE];
  fg__map *map = NULL;
  if (!projection || !fg_has_feature(FG_FEATURE_MAPS))
    return FG_STATUS_OK;
  const fg_status status = fg__map_create(&map, context, projection);
  fg__map_destroy(map);
  if (status == FG_STATUS_OK || status == FG_STATUS_MEMORY)
    return status;
  snprintf(message, sizeof message, "%s", fg_context_message(context));
  fg_context_clear(context);
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: %s", path, message);
}

/* All ranks need the whole field, for their rows of the map lie across its own. *on_map:
 * it was laid on the map, else *out is as it was read. */
static fg_status project(fg_field **out, bool *on_map, fg_context *context,
                         const fg__format *format, const fg__source *source,
                         const fg_read_options *options, fg__slab_index slab)
{
  fg_field *field = NULL;
  fg__sphere *sphere = NULL;
  fg_status status =
      format->read(&field, context, source, options, (fg__slab_index){0, 1});
  if (status == FG_STATUS_OK && !goes_on_map(field, options->map)) {
    *out = field;
    return FG_STATUS_OK;
  }
  *on_map = true;
  if (status == FG_STATUS_OK)
    status = fg_field_contents(field)->scale == FG_SCALE_MAP
                 ? check_projection(context, source->path,
                                    fg_field_contents(field)->projection)
                 : FG_STATUS_OK;
  if (status == FG_STATUS_OK)
    status = fg_field_contents(field)->scale == FG_SCALE_MAP
                 ? fg__sphere_of_plane(&sphere, context, field)
                 : fg__sphere_of_field(&sphere, context, field);
  if (status == FG_STATUS_OK)
    status =
        fg__sphere_project(out, context, sphere, options->map, slab.number, slab.count);
  fg__sphere_destroy(sphere);
  fg_field_destroy(field);
  return status;
}

static fg_status read_on_map(fg_field **out, fg_context *context,
                             const fg__format *format, const fg__source *source,
                             const fg_read_options *options, fg__slab_index slab)
{
  fg_status status = FG_STATUS_OK;
  bool on_map = false;
  if (slab.count > 1) {
    status = format->read(out, context, source, options, slab);
    if (status == FG_STATUS_OK && goes_on_map(*out, options->map)) {
      fg_field_destroy(*out);
      *out = NULL;
    }
  }
  if (status == FG_STATUS_OK && !*out)
    status = project(out, &on_map, context, format, source, options, slab);
  if (status == FG_STATUS_OK && fg__map_is_named(options->map) && !on_map) {
    status = refuse(context, source->path, *out);
    fg_field_destroy(*out);
    *out = NULL;
  }
  return status;
}

fg_status fg__field_read_known(fg_field **out, fg_context *context,
                               const fg__format *format, const fg__source *source,
                               const fg_read_options *options, fg__slab_index slab)
{
  const bool on_map = fg__map_is_asked(options->map);
  fg__sphere *sphere = NULL;
  *out = NULL;
  fg_status status =
      format->sphere ? format->sphere(&sphere, context, source, options) : FG_STATUS_OK;
  if (status != FG_STATUS_OK) {
    fg__sphere_destroy(sphere);
    return status;
  }
  if (sphere && on_map)
    status =
        fg__sphere_project(out, context, sphere, options->map, slab.number, slab.count);
  else if (sphere)
    status = fg__globe_field(out, context, sphere, slab);
  else if (on_map)
    status = read_on_map(out, context, format, source, options, slab);
  else
    status = format->read(out, context, source, options, slab);
  fg__sphere_destroy(sphere);
  if (status == FG_STATUS_OK)
    status = check_projection(context, source->path, fg_field_contents(*out)->projection);
  if (status != FG_STATUS_OK) {
    fg_field_destroy(*out);
    *out = NULL;
  }
  return status;
}
