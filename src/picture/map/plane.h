/* The plane of a field on the Earth: a projection's, or longitude and latitude. */
#ifndef FG__PLANE_H
#define FG__PLANE_H

#include "map/map.h"
#include "picture/contour.h"

typedef enum fg__plane_kind {
  FG__PLANE_NONE,      /* the field is on no map */
  FG__PLANE_DEGREES,   /* its axes are longitude and latitude */
  FG__PLANE_AZIMUTHAL, /* lines are cut at a distance from the centre */
  FG__PLANE_CUT        /* lines are cut at the meridian opposite the centre's */
} fg__plane_kind;

/* What a picture shows of it. */
typedef struct fg__plane {
  fg__plane_kind kind;
  fg__map *map;           /* NULL: degrees */
  double center[2];       /* longitude, latitude */
  double low[2], high[2]; /* what the frame shows, in the field's coordinates */
  double west, east;      /* longitudes that it shows, with a margin; east - west is 360
                             at most */
  double south, north;    /* latitudes, likewise */
  double reach;           /* azimuthal: the farthest that is shown, degrees from the
                             centre, with a margin */
  double metres;          /* in a unit of the coordinates, as the projection has it */
  bool whole;             /* bounded by `outline`, not by a box */
  bool disc;              /* and that is a circle round the centre */
  double radius;          /* of the disc, degrees */
  fg__polygons outline;   /* field's coordinates; empty unless whole */
} fg__plane;

/* low, high: what the frame would show; of a map of the world they become the outline's
 * box. Of a field without projection, or in a build without projections: kind NONE.
 * ARGUMENT (PROJ refuses the projection), MEMORY. */
fg_status fg__plane_create(fg__plane *out, fg_context *context, const fg_field *field,
                           double low[2], double high[2]);
void fg__plane_clear(fg__plane *plane);

/* Degrees to the field's coordinates, n each; NaN where there is no image. */
void fg__plane_forward(const fg__plane *plane, size_t n, const double *longitude,
                       const double *latitude, double *x, double *y);
void fg__plane_inverse(const fg__plane *plane, size_t n, const double *x, const double *y,
                       double *longitude, double *latitude);

/* Metres on the ground in a unit of the coordinates along x, at the middle of what is
 * shown; 0 where that differs by more than a third over the frame, or on maps of the
 * world. */
double fg__plane_true_metres(const fg__plane *plane);

#endif
