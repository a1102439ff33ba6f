/* A field on the sphere as one on a longitude-latitude grid. */
#ifndef FG__GLOBE_H
#define FG__GLOBE_H

#include "flowgrain/inventory.h"
#include "sample/rows.h"
#include "sphere/sphere.h"

/* The rows of a slab of a longitude-latitude grid that has a sphere's mean spacing and
 * covers what the sphere covers. FILE_FORMAT (its cells have no area), MEMORY. */
fg_status fg__globe_field(fg_field **out, fg_context *context, const fg__sphere *sphere,
                          fg__slab_index slab);

/* Size, bounds and period of that grid, as an inventory has them; the size is 0 x 0 where
 * the cells have no area. */
void fg__globe_describe(fg_inventory_vector *vector, const fg__sphere_extent *extent);

#endif
