/* The rectangle of a projection's plane that shows a part of the globe, in square
 * samples. */
#ifndef FG__MAP_PLANE_H
#define FG__MAP_PLANE_H

#include "map/choose.h"
#include "map/map.h"

typedef struct fg__map_plane {
  double first[2], spacing; /* the sample at the lower left, in the plane's units */
  int size[2];
  bool bounded; /* `area` bounds what is shown, not the rectangle alone */
  fg__map_area area;
  double reach; /* degrees from the centre; 0: no bound */
} fg__map_plane;

/* Positions in degrees. */
typedef struct fg__map_places {
  size_t count;
  double *longitude, *latitude;
} fg__map_places;

/* Finds the rectangle round the image of an area. is_region: the area was asked for; one
 * that goes all round bounds what is shown. Projections without an outline are shown to
 * where they enlarge lengths threefold, Mercator's to 80 degrees. samples: along the
 * longer side. places: all that is to be seen, where no area was asked for; NULL or none
 * of them: all of the area. ARGUMENT: nothing of the area has an image, or the image is
 * torn elsewhere than along the meridian opposite the centre. */
fg_status fg__map_plane_find(fg__map_plane *out, fg_context *context, const fg__map *map,
                             const fg__map_area *area, const fg__map_places *places,
                             bool is_region, int samples);

/* Whether a position that the map has an image of is to be shown. */
bool fg__map_plane_shows(const fg__map_plane *plane, const fg__map *map, double longitude,
                         double latitude);

#endif
