/* A vector field on the sphere, to be sampled anywhere on it. */
#ifndef FG__SPHERE_H
#define FG__SPHERE_H

#include "base/context.h"

typedef struct fg__sphere fg__sphere;

/* Points with a vector each, and the cells between them. */
typedef struct fg__sphere_cells {
  size_t points;
  double *longitude, *latitude; /* [points] degrees; NaN: its cells do not count */
  float *east, *north;          /* [points]; NaN, infinite: missing */
  size_t count;                 /* cells */
  int *corner; /* [4 * count] points round each cell, in either sense; a triangle has -1
                  as its last */
  const fg_field_arrays *words; /* names and units of the velocity, title, time, level;
                                   NULL: none */
} fg__sphere_cells;

/* A field on a longitude-latitude grid (scale GEO, 2D, all of its rows), borrowed: it
 * must go last. Where the last row lies within 1.01 rows of a pole and the longitudes
 * close, the pole has the mean of that row. ARGUMENT, MEMORY. */
fg_status fg__sphere_of_field(fg__sphere **out, fg_context *context,
                              const fg_field *field);

/* Takes over the arrays, even after a failure. Cells are left out whose corners lie 30
 * degrees or more apart, or of which all corners are missing. ARGUMENT (sizes, indices,
 * no cell left, a field that is zero everywhere), MEMORY. */
fg_status fg__sphere_of_cells(fg__sphere **out, fg_context *context,
                              fg__sphere_cells *taken);

void fg__sphere_destroy(fg__sphere *sphere);

/* Components at n positions in degrees, longitudes in any turn; NaN where no cell is, or
 * the nearest corner of its cell is missing. Between the corners of a cell the vectors
 * are interpolated as vectors in space, so that poles and the antimeridian are like any
 * other place; a missing corner then counts as the mean of those beside it that are not.
 * Threads may share a sphere. */
void fg__sphere_sample(float *east, float *north, const fg__sphere *sphere, size_t n,
                       const double *longitude, const double *latitude);

/* What it covers. */
typedef struct fg__sphere_extent {
  double west, east; /* west in [-180, 180), east - west in [0, 360]; 360: all round */
  double south, north;
  double spacing; /* degrees: root of the mean area of a point that is not missing */
  double share;   /* of the sphere's area that has values */
  size_t points;  /* that are not missing */
  bool scattered; /* all cells are triangles: the spacing varies from place to place */
} fg__sphere_extent;

void fg__sphere_extent_of(fg__sphere_extent *out, const fg__sphere *sphere);

/* The field's words, borrowed: names and units of the velocity, title, time, level. */
const fg_field_arrays *fg__sphere_words(const fg__sphere *sphere);

#endif
