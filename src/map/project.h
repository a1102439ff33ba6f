/* A field on the sphere as one on the plane of a map. */
#ifndef FG__MAP_PROJECT_H
#define FG__MAP_PROJECT_H

#include "base/context.h"
#include "flowgrain/map.h"
#include "sphere/sphere.h"

/* Whether a map is asked for: not NULL, not "none". */
bool fg__map_is_asked(const fg_map_options *options);

/* Whether the options choose a map, centre or region, beyond "auto". */
bool fg__map_is_named(const fg_map_options *options);

/* A field on the plane of a projection (scale MAP, 2D, whole) as one on the sphere, which
 * keeps the projection among its words: samples become points, their vectors are turned
 * to east and north. ARGUMENT, UNSUPPORTED (a build without maps), MEMORY. */
fg_status fg__sphere_of_plane(fg__sphere **out, fg_context *context,
                              const fg_field *field);

/* Slab `number` of `count` (field/slab.h; with a count of 1 all) of the sphere's field on
 * the plane of a map, as fg_field_project; "auto" is the projection among the sphere's
 * words, if any, unless a centre is given. */
fg_status fg__sphere_project(fg_field **out, fg_context *context,
                             const fg__sphere *sphere, const fg_map_options *options,
                             int number, int count);

#endif
