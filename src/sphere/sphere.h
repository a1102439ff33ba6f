/* A vector field on the sphere, to be sampled anywhere on it. */
#ifndef FG__SPHERE_H
#define FG__SPHERE_H

#include <math.h>

#include "base/angle.h"
#include "base/context.h"

/* Metres in a degree of a great circle of the Earth. */
#define FG__DEGREE_METRES 111195.0

/* The unit vector to a position in degrees. */
static inline void fg__sphere_unit_vector(double out[3], double longitude,
                                          double latitude)
{
  const double l = longitude * FG__RADIANS, p = latitude * FG__RADIANS;
  out[0] = cos(p) * cos(l);
  out[1] = cos(p) * sin(l);
  out[2] = sin(p);
}

/* Unit vectors up, east and north at a position in degrees. */
typedef struct fg__sphere_frame {
  double up[3], east[3], north[3];
} fg__sphere_frame;

static inline fg__sphere_frame fg__sphere_frame_at(double longitude, double latitude)
{
  const double s = sin(longitude * FG__RADIANS), c = cos(longitude * FG__RADIANS);
  const double sine = sin(latitude * FG__RADIANS), cosine = cos(latitude * FG__RADIANS);
  return (fg__sphere_frame){
      {cosine * c, cosine * s, sine}, {-s, c, 0.0}, {-sine * c, -sine * s, cosine}};
}

/* Degrees of the great circle between two positions in degrees, longitude first. */
static inline double fg__sphere_distance(const double a[2], const double b[2])
{
  const double s = sin(0.5 * (b[1] - a[1]) * FG__RADIANS);
  const double t = sin(0.5 * (b[0] - a[0]) * FG__RADIANS);
  const double h = s * s + cos(a[1] * FG__RADIANS) * cos(b[1] * FG__RADIANS) * t * t;
  return 2.0 * asin(fmin(sqrt(h), 1.0)) / FG__RADIANS;
}

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
                                   `projection`: of the plane in which the points are a
                                   grid; NULL: none */
  int threads; /* 0: as many as there are cores, where there is work for them */
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

/* Sets `points`, allocates the arrays of points, uninitialised, and `corner` for `cells`
 * cells; `count` is left to the caller. False without memory; then to be cleared, too. */
bool fg__sphere_cells_allocate(fg__sphere_cells *out, size_t points, size_t cells);

/* Frees arrays that were not taken over. */
void fg__sphere_cells_clear(fg__sphere_cells *cells);

void fg__sphere_destroy(fg__sphere *sphere);

/* Components at n positions in degrees, longitudes in any turn; NaN where no cell is, or
 * the nearest corner of its cell is missing. Between the corners of a cell the vectors
 * are interpolated as vectors in space, so that poles and the antimeridian are like any
 * other place; a missing corner then counts as the mean of those beside it that are not.
 * Threads may share a sphere. */
void fg__sphere_sample(float *east, float *north, const fg__sphere *sphere, size_t n,
                       const double *longitude, const double *latitude);

/* Adds the vectors at n unit vectors `up`, as vectors in space, to a sum; returns how
 * many are there. *hint is -1 at first, and then what the last call has left. */
size_t fg__sphere_add(double sum[3], const fg__sphere *sphere, size_t n,
                      const double (*up)[3], int *hint);

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

/* Degrees of points in cells that have values, evenly among all, `most` at most: returns
 * how many; of a longitude-latitude grid none. */
size_t fg__sphere_places(double *longitude, double *latitude, const fg__sphere *sphere,
                         size_t most);

/* The field's words, borrowed: names and units of the velocity, title, time, level, and
 * the projection in whose plane the points are a grid, where there is one. */
const fg_field_arrays *fg__sphere_words(const fg__sphere *sphere);

#endif
