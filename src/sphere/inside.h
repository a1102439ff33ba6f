/* A sphere's own representation. */
#ifndef FG__SPHERE_INSIDE_H
#define FG__SPHERE_INSIDE_H

#include <stdint.h>

#include "base/vector.h"
#include "sphere/sphere.h"

enum { FG__SPHERE_FACES = 6, FG__SPHERE_WORDS = 8 };

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

  double *position;     /* of points in cells: [3 * points] unit vectors */
  int *corner;          /* [4 * count] */
  unsigned char *faces; /* [count] while cells are sorted: a bit for each face */
  fg__sphere_face face[FG__SPHERE_FACES]; /* +x, -x, +y, -y, +z, -z */
};

/* Points of a cell round it; returns 3 or 4. */
int fg__sphere_corners(const fg__sphere *sphere, size_t cell, int point[4]);

/* Makes room for the vectors of the points. MEMORY. */
fg_status fg__sphere_begin(fg__sphere *sphere, fg_context *context, size_t points,
                           const fg_field_arrays *words);

/* Gives point n its vector; one that is not finite is missing. MEMORY. */
fg_status fg__sphere_set(fg__sphere *sphere, fg_context *context, size_t n,
                         const fg__sphere_frame *at, float east, float north);

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

/* locate.c: sorts the cells into the squares of the faces, and finds among them one that
 * holds a unit vector and whose nearest corner is not missing. *hint is a cell to try
 * first, or -1, and becomes the one found. MEMORY. */
fg_status fg__sphere_sort_cells(fg__sphere *sphere, fg_context *context);
bool fg__sphere_place_in_cells(fg__sphere_place *out, const fg__sphere *sphere,
                               const double up[3], int *hint);

/* extent.c: measures what the cells cover; longitude and latitude of the points, NULL on
 * a longitude-latitude grid. Returns the cells' area, all together, over that between the
 * longitudes and latitudes in which they lie. */
double fg__sphere_measure(fg__sphere *sphere, const double *longitude,
                          const double *latitude);

#endif
