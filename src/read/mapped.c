#include "read/mapped.h"

#include "map/map.h"
#include "map/project.h"

#include <stdio.h>
#include <string.h>

/* On longitudes and latitudes, or on a plane that is to become another. */
static bool goes_on_map(const fg_field *field, const fg_map_options *map)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  return arrays->dimension == 2 &&
         (arrays->scale == FG_SCALE_GEO ||
          (arrays->scale == FG_SCALE_MAP && arrays->projection && fg__map_is_named(map)));
}

fg__field_region fg__region_asked(const fg_read_options *options)
{
  const fg_map_options *map = options->map;
  fg__field_region out = {.axes = 0};
  if (!fg__map_is_asked(map) || !map->has_region)
    return out;
  out.axes = map->region_is_box ? 3 : 2;
  for (int k = 0; k < out.axes; ++k) {
    out.low[k] = map->region[2 * k];
    out.high[k] = map->region[2 * k + 1];
  }
  return out;
}

/* Whether a region is all that is asked of a map: fields on none are cut by it. */
static bool is_region_alone(const fg_map_options *map)
{
  return map && map->has_region && !map->has_center &&
         (!map->projection || strcmp(map->projection, "auto") == 0);
}

/* The part of a field in a region, or a slab of it. */
static fg_status cut(fg_field **out, fg_context *context, fg__file_field *samples,
                     const char *path, const fg__field_region *region,
                     fg__slab_index slab)
{
  fg_status status = fg__region_cut(&samples->field, context, path, region);
  if (status == FG_STATUS_OK && slab.count > 1)
    return fg__field_slab_of(out, context, samples->field, slab);
  if (status == FG_STATUS_OK) {
    *out = samples->field;
    samples->field = NULL;
  }
  return status;
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

/* Projects a longitude-latitude field, or one on a plane, to the options' map. */
static fg_status project(fg_field **out, fg_context *context, const fg_field *field,
                         const char *path, const fg_map_options *map, fg__slab_index slab)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  const bool on_plane = arrays->scale == FG_SCALE_MAP;
  fg__sphere *sphere = NULL;
  fg_status status =
      on_plane ? check_projection(context, path, arrays->projection) : FG_STATUS_OK;
  if (status == FG_STATUS_OK)
    status =
        (on_plane ? fg__sphere_of_plane : fg__sphere_of_field)(&sphere, context, field);
  if (status == FG_STATUS_OK)
    status = fg__sphere_project(out, context, sphere, map, slab.number, slab.count);
  fg__sphere_destroy(sphere);
  return status;
}

fg_status fg__file_field_read(fg__file_field *out, fg_context *context,
                              const fg__format *format, const fg__source *source,
                              const fg_read_options *options, fg__slab_index slab)
{
  *out = (fg__file_field){.field = NULL};
  fg_status status = fg__dataset_sphere(&out->sphere, context, format, source, options);
  if (status != FG_STATUS_OK || out->sphere)
    return status;
  if (fg__region_asked(options).axes > 0) /* each rank cuts the whole field */
    slab = (fg__slab_index){0, 1};
  status = fg__dataset_read(&out->field, context, format, source, options, slab);
  if (status != FG_STATUS_OK || slab.count == 1 || !fg__map_is_asked(options->map) ||
      !goes_on_map(out->field, options->map))
    return status;
  /* the rows that a rank has of a map lie across those of all ranks */
  fg__file_field_clear(out);
  return fg__dataset_read(&out->field, context, format, source, options,
                          (fg__slab_index){0, 1});
}

fg_status fg__file_field_place(fg_field **out, fg_context *context,
                               fg__file_field *samples, const char *path,
                               const fg_read_options *options, fg__slab_index slab)
{
  const fg_map_options *map = fg__map_is_asked(options->map) ? options->map : NULL;
  const fg__field_region region = fg__region_asked(options);
  fg_status status = FG_STATUS_OK;
  *out = NULL;
  if (region.axes == 3 && (samples->sphere || goes_on_map(samples->field, map)))
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "%s: a region of six numbers, and the field goes on a map: west, "
                      "east, south and north are needed",
                      path);
  else if (samples->sphere && map)
    status =
        fg__sphere_project(out, context, samples->sphere, map, slab.number, slab.count);
  else if (samples->sphere)
    status = fg__globe_field(out, context, samples->sphere, slab);
  else if (map && goes_on_map(samples->field, map))
    status = project(out, context, samples->field, path, map, slab);
  else if (is_region_alone(map))
    status = cut(out, context, samples, path, &region, slab);
  else if (fg__map_is_named(map))
    status = refuse(context, path, samples->field);
  else {
    *out = samples->field;
    samples->field = NULL;
  }
  if (status == FG_STATUS_OK)
    status = check_projection(context, path, fg_field_contents(*out)->projection);
  return status;
}

void fg__file_field_clear(fg__file_field *samples)
{
  fg__sphere_destroy(samples->sphere);
  fg_field_destroy(samples->field);
  *samples = (fg__file_field){.field = NULL};
}
