/* Map projections, by PROJ: longitude and latitude to coordinates of a plane and back.
 *
 * A projection is given by a PROJ string, "+proj=laea +lat_0=90 +R=6371000 +units=km". No
 * file is read and no network used: strings that name files (grids, init files) or
 * pipelines are refused. */
#ifndef FG__MAP_H
#define FG__MAP_H

#include "base/context.h"

/* A map is used by one thread at a time, const or not; each thread makes its own. */
typedef struct fg__map fg__map;

typedef enum fg__map_kind {
  FG__MAP_OTHER = 0,
  FG__MAP_CYLINDRICAL, /* parallels and meridians are straight and at right angles */
  FG__MAP_AZIMUTHAL,   /* directions at the centre are true */
  FG__MAP_CONIC
} fg__map_kind;

/* Makes a map of a PROJ string. ARGUMENT (no projection, a file or a pipeline named, what
 * PROJ refuses; the message names the string), UNSUPPORTED (a build without PROJ),
 * MEMORY. */
fg_status fg__map_create(fg__map **out, fg_context *context, const char *projection);
void fg__map_destroy(fg__map *map);

/* The string that it was made of, without what changes nothing ("+no_defs"). */
const char *fg__map_projection(const fg__map *map);

/* Degrees to the plane's coordinates, n each. Longitudes within 360 degrees of the
 * centre's are not wrapped, so that a line may go on past the cut. NaN where there is no
 * image. */
void fg__map_forward(const fg__map *map, size_t n, const double *longitude,
                     const double *latitude, double *x, double *y);

/* Back to degrees, longitudes within 180 of the centre's. NaN where the plane has no
 * image of the globe: beyond the outline, and where the way back is over 1 km off. */
void fg__map_inverse(const fg__map *map, size_t n, const double *x, const double *y,
                     double *longitude, double *latitude);

/* Turns n vectors (east, north) at positions in degrees into the plane's axes, by the
 * projection's Jacobian, and keeps their length. NaN where there is no image. */
void fg__map_turn(const fg__map *map, size_t n, const double *longitude,
                  const double *latitude, float *east, float *north);

/* The way back: vectors along the plane's axes at positions in degrees become east and
 * north. */
void fg__map_turn_back(const fg__map *map, size_t n, const double *longitude,
                       const double *latitude, float *x, float *y);

/* As fg__map_turn, of positions whose images lie on a line, evenly spaced and less than a
 * hundredth of the Earth's radius apart or so: faster, where derivatives are smooth. */
void fg__map_turn_row(const fg__map *map, size_t n, const double *longitude,
                      const double *latitude, float *east, float *north);

/* Area on the plane over area on the ground, in the plane's own length, at a position in
 * degrees: 1 everywhere of equal-area projections; NaN where there is no image. */
double fg__map_area_scale(const fg__map *map, double longitude, double latitude);

/* The largest length on the plane over the length on the ground, over all directions at a
 * position; NaN where there is no image. */
double fg__map_length_scale(const fg__map *map, double longitude, double latitude);

/* Metres in a unit of the plane; of a plane in degrees (a rotated pole) those of a
 * degree.
 */
double fg__map_unit(const fg__map *map);

/* The ellipsoid's larger half-axis a in metres, and e squared. */
void fg__map_ellipsoid(const fg__map *map, double *radius, double *flatness);

/* The central meridian lon0: the cut is at lon0 - 180 and lon0 + 180. */
double fg__map_center(const fg__map *map);

/* The latitude of the centre of azimuthal projections, the reference latitude of others,
 * 0 of those without. */
double fg__map_center_latitude(const fg__map *map);

fg__map_kind fg__map_kind_of(const fg__map *map);

/* Whether the whole globe has an image inside a finite outline (eqearth; not merc). */
bool fg__map_is_world(const fg__map *map);

#endif
