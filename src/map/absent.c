/* In builds without PROJ: there are no projections. */
#include "base/feature.h"
#include "map/map.h"
#include "map/project.h"

#include <math.h>
#include <string.h>

fg_status fg__map_create(fg__map **out, fg_context *context, const char *projection)
{
  *out = NULL;
  return fg__fail_absent(context, projection, FG_FEATURE_MAPS);
}

/* No map can be made: what follows is never called, and is there to be linked. */

void fg__map_destroy(fg__map *map)
{
  (void)map;
}

const char *fg__map_projection(const fg__map *map)
{
  (void)map;
  return "";
}

static void fill(size_t n, double *one, double *other)
{
  for (size_t i = 0; i < n; ++i)
    one[i] = other[i] = (double)NAN;
}

void fg__map_forward(const fg__map *map, size_t n, const double *longitude,
                     const double *latitude, double *x, double *y)
{
  (void)map;
  (void)longitude;
  (void)latitude;
  fill(n, x, y);
}

void fg__map_inverse(const fg__map *map, size_t n, const double *x, const double *y,
                     double *longitude, double *latitude)
{
  (void)map;
  (void)x;
  (void)y;
  fill(n, longitude, latitude);
}

void fg__map_turn(const fg__map *map, size_t n, const double *longitude,
                  const double *latitude, float *east, float *north)
{
  (void)map;
  (void)longitude;
  (void)latitude;
  for (size_t i = 0; i < n; ++i)
    east[i] = north[i] = NAN;
}

void fg__map_turn_back(const fg__map *map, size_t n, const double *longitude,
                       const double *latitude, float *x, float *y)
{
  fg__map_turn(map, n, longitude, latitude, x, y);
}

void fg__map_turn_row(const fg__map *map, size_t n, const double *longitude,
                      const double *latitude, float *east, float *north)
{
  fg__map_turn(map, n, longitude, latitude, east, north);
}

void fg__map_ellipsoid(const fg__map *map, double *radius, double *flatness)
{
  (void)map;
  *radius = *flatness = (double)NAN;
}

double fg__map_area_scale(const fg__map *map, double longitude, double latitude)
{
  (void)map;
  (void)longitude;
  (void)latitude;
  return (double)NAN;
}

double fg__map_length_scale(const fg__map *map, double longitude, double latitude)
{
  return fg__map_area_scale(map, longitude, latitude);
}

double fg__map_unit(const fg__map *map)
{
  (void)map;
  return 1.0;
}

double fg__map_center(const fg__map *map)
{
  (void)map;
  return 0.0;
}

double fg__map_center_latitude(const fg__map *map)
{
  (void)map;
  return 0.0;
}

fg__map_kind fg__map_kind_of(const fg__map *map)
{
  (void)map;
  return FG__MAP_OTHER;
}

bool fg__map_is_world(const fg__map *map)
{
  (void)map;
  return false;
}

bool fg__map_is_asked(const fg_map_options *options)
{
  return fg__map_is_named(options);
}

bool fg__map_is_named(const fg_map_options *options)
{
  const char *asked = options && options->projection ? options->projection : "auto";
  return options && strcmp(asked, "none") != 0 &&
         (options->has_center || options->has_region || strcmp(asked, "auto") != 0);
}

fg_status fg__sphere_project(fg_field **out, fg_context *context,
                             const fg__sphere *sphere, const fg_map_options *options,
                             int number, int count)
{
  (void)sphere;
  (void)options;
  (void)number;
  (void)count;
  *out = NULL;
  return fg__fail_absent(context, "projection", FG_FEATURE_MAPS);
}

fg_status fg__sphere_of_plane(fg__sphere **out, fg_context *context,
                              const fg_field *field)
{
  (void)field;
  *out = NULL;
  return fg__fail_absent(context, "projection", FG_FEATURE_MAPS);
}

fg_status fg_field_project(fg_field **out, fg_context *context, const fg_field *field,
                           const fg_map_options *options)
{
  (void)field;
  (void)options;
  if (out)
    *out = NULL;
  return fg__fail_absent(context, "projection", FG_FEATURE_MAPS);
}

const char *fg_map_auto(const fg_inventory_vector *vector)
{
  (void)vector;
  return NULL;
}
