/* Whether a map has anything to show. */
#ifndef FG__MAP_VALUES_H
#define FG__MAP_VALUES_H

#include "map/choose.h"
#include "sphere/sphere.h"

/* Refuses samples of a map that are all missing or, of all of it, all zero; the message
 * says where, and counts the points of the field instead of the map's samples. `all`:
 * they are the whole map, and no part of which others may have values. ARGUMENT. */
fg_status fg__map_check_values(fg_context *context, const fg__map_area *area,
                               const fg__sphere *sphere, float *const velocity[2],
                               size_t count, bool all);

#endif
