/* A sphere's own representation. */
#ifndef FG__SPHERE_INSIDE_H
#define FG__SPHERE_INSIDE_H

#include <stdint.h>

#include "base/threads.h"
#include "base/vector.h"
#include "sphere/sphere.h"

enum { FG__SPHERE_FACES = 6, FG__SPHERE_WORDS = 9 };

/* Points of a place that no sample is at: the poles. */
enum { FG__SPHERE_SOUTH = -1, FG__SPHERE_NORTH = -2 };

/* The part of a face of the cube round the sphere where cells lie, divided into columns *
 * rows squares; the cells that may have a part in square n are cell[start[n]] to
 * cell[start[n + 1] - 1]. */
typedef struct fg__sphere_face {
  double low[2], high[2], inverse[2]; /* in the gnomonic projection onto the face */
  int columns, rows;                  /* 0: no cell lies there */
  uint32_t *start;
  int *cell;
} fg__sphere_face;

struct fg__sphere {
  fg_field_arrays words;
  char *word[FG__SPHERE_WORDS]; /* owned copies of the texts */
  int texts;
  size_t points, count;   /* count: cells */
  float *vector;          /* [3 * points] in space; NaN: missing like all beside it */
  unsigned char *missing; /* [points]; NULL: none is */
  fg__sphere_extent extent;

  const fg_field *field; /* on a longitude-latitude grid; else NULL */
  float pole[2][3];      /* south, north */
  bool has_pole[2];      /* beyond the last row */

  double *position; /* of points in cells: [3 * points] unit vectors */
  int *corner;      /* [4 * count] */
  fg__sphere_face face[FG__SPHERE_FACES]; /* +x, -x, +y, -y, +z, -z */
};

/* Of a cell of a longitude-latitude grid. */
void fg__sphere_grid_corners(const fg__sphere *sphere, size_t cell, int point[4]);

/* Points of a cell round it; returns 3 or 4. */
static inline int fg__sphere_corners(const fg__sphere *sphere, size_t cell, int point[4])
{
  if (sphere->field) {
    fg__sphere_grid_corners(sphere, cell, point);
    return 4;
  }
  for (int k = 0; k < 4; ++k)
    point[k] = sphere->corner[4 * cell + (size_t)k];
  return point[3] < 0 ? 3 : 4;
}

/* Into how many parts the cells are divided for threads, whose number it does not depend
 * on. */
static inline int fg__sphere_parts(const fg__sphere *sphere)
{
  return sphere->count < 1 << 16 ? 1 : 64;
}

/* Makes room for the vectors of the points, and what is missing of them. MEMORY. */
fg_status fg__sphere_begin(fg__sphere *sphere, fg_context *context, size_t points,
                           const fg_field_arrays *words);

/* Gives point n its vector; false: one that is not finite is missing. */
static inline bool fg__sphere_set(fg__sphere *sphere, size_t n,
                                  const fg__sphere_frame *at, float east, float north)
{
  if (!isfinite(east) || !isfinite(north)) {
    sphere->missing[n] = 1;
    return false;
  }
  for (int k = 0; k < 3; ++k)
    sphere->vector[3 * n + (size_t)k] =
        (float)((double)east * at->east[k] + (double)north * at->north[k]);
  return true;
}

/* Once all points have one: `missing` is freed where none is. */
void fg__sphere_all_set(fg__sphere *sphere, bool any_missing);

/* Missing points become the mean of those in their cells that are not. MEMORY. */
fg_status fg__sphere_fill(fg__sphere *sphere, fg_context *context);

/* Where a position lies: the points round it and their weights. */
typedef struct fg__sphere_place {
  int point[4];
  double weight[4];
} fg__sphere_place;

/* Whether the corner of the largest weight, which is the nearest, is missing. */
bool fg__sphere_place_is_missing(const fg__sphere *sphere, const fg__sphere_place *place);

/* grid.c: a position in degrees on a longitude-latitude grid; false outside. */
bool fg__sphere_place_in_grid(fg__sphere_place *out, const fg__sphere *sphere,
                              double longitude, double latitude);

/* Positions a rounding error outside a cell, in widths of the cell, are inside. */
#define FG__SPHERE_ROUNDING 1e-7

/* A face of the cube reaches 54.7 degrees from its centre, and a cell's corners lie
 * within 30 of each other: this is the cosine of a little more than the sum. */
#define FG__SPHERE_LEAST_HEIGHT 0.08

static inline const double *fg__sphere_position(const fg__sphere *sphere, int point)
{
  return sphere->position + 3 * (size_t)point;
}

static inline int fg__sphere_face_of(const double up[3])
{
  int axis = fabs(up[1]) > fabs(up[0]) ? 1 : 0;
  axis = fabs(up[2]) > fabs(up[axis]) ? 2 : axis;
  return 2 * axis + (up[axis] < 0.0);
}

/* Gnomonic coordinates on face f; false at or behind its horizon. */
static inline bool fg__sphere_onto_face(double out[2], const double up[3], int f)
{
  const int axis = f / 2, first = axis == 2 ? 0 : axis + 1;
  const double height = f & 1 ? -up[axis] : up[axis];
  if (height < FG__SPHERE_LEAST_HEIGHT)
    return false;
  const double inverse = 1.0 / height;
  out[0] = up[first] * inverse;
  out[1] = up[first == 2 ? 0 : first + 1] * inverse;
  return true;
}

/* The square of `count` in which a place along an axis of a face lies, or is nearest. */
static inline int fg__sphere_square(double x, int count)
{
  if (!(x > 0.0))
    return 0;
  return x < count ? (int)x : count - 1;
}

/* sort.c: sorts the cells into the squares of the faces; the same on any number of
 * threads. MEMORY. */
fg_status fg__sphere_sort_cells(fg__sphere *sphere, fg_context *context,
                                fg__threads *threads);

/* locate.c: finds a cell that holds a unit vector and whose nearest corner is not
 * missing. *hint is a cell to try first, or -1, and becomes the one found. */
bool fg__sphere_place_in_cells(fg__sphere_place *out, const fg__sphere *sphere,
                               const double up[3], int *hint);

/* extent.c: measures what the cells cover; longitude and latitude of the points, NULL on
 * a longitude-latitude grid. Returns the cells' area, all together, over that between the
 * longitudes and latitudes in which they lie; the same on any number of threads. MEMORY.
 */
fg_status fg__sphere_measure(double *layers, fg__sphere *sphere, fg_context *context,
                             fg__threads *threads, const double *longitude,
                             const double *latitude);

#endif
