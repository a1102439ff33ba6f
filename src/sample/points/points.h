/* Vectors at points: on the grid that the points lie on, whichever their order, or
 * interpolated between them (docs/design/points.md). */
#ifndef FG__POINTS_H
#define FG__POINTS_H

#include "sample/cells/set.h"
#include "sample/globe.h"
#include "sample/points/delaunay.h"

/* Points with a velocity each, as a file lists them. Two components are x and y's; with
 * three, dimension is 3. */
typedef struct fg__scatter {
  fg_context *context;
  const char *path;
  size_t count;
  int dimension;           /* coordinates a point has */
  double *position[3];     /* [count] each */
  float *velocity[3];      /* [count] each; NaN: missing */
  int *record;             /* [count], where each stands in the file, or NULL */
  const char *records;     /* what that is: "line" */
  bool geographic;         /* longitude and latitude in degrees; east and north */
  fg__field_region region; /* that samples between them are wanted of, of no map */
} fg__scatter;

void fg__scatter_clear(fg__scatter *points);

/* The words of a field whose points may turn out to lie in a plane. */
typedef struct fg__flat_words {
  fg_field_arrays all;
  char level[192];
} fg__flat_words;

/* Points in space that lie in one plane become points in 2D: of two of the axes as they
 * are, else in the plane's own coordinates (field/plane.h), with the velocity's part in
 * it. What all have in common is their level. */
void fg__scatter_flatten(fg__scatter *points, fg__flat_words *words);

/* Samples where lines along the axes cross: each one of the file's where both numbers are
 * 0, else interpolated from so many triangles, or from so many points in space. */
typedef struct fg__point_grid {
  int dimension, size[3];
  double *axis[3]; /* [size[k]], ascending */
  double period;   /* of the first axis, or 0 */
  float *velocity[3];
  size_t cells, points, gaps;
} fg__point_grid;

void fg__point_grid_clear(fg__point_grid *grid);
size_t fg__point_grid_samples(const fg__point_grid *grid);

/* What the samples of a field are interpolated from; both 0: each is the file's. */
typedef struct fg__scatter_between {
  size_t cells, points;
  size_t gaps; /* cells, or intervals of a grid, that are left out: they bridge gaps */
} fg__scatter_between;

/* The field of points, whose arrays it may change; the words are those of
 * fg_field_arrays. Points at one place become their mean. FILE_FORMAT (no numbers, more
 * places with several values than a slip explains), UNSUPPORTED (points on one line; in
 * space, on no grid, in no plane, and too few), ARGUMENT, MEMORY, STOPPED. */
fg_status fg__scatter_field(fg_field **out, fg__scatter_between *between,
                            fg__scatter *points, const fg_field_arrays *words,
                            fg__slab_index slab);

/* The same of longitudes and latitudes as a field on the sphere; *out stays NULL where
 * they are a grid's. */
fg_status fg__scatter_sphere(fg__sphere **out, fg__scatter_between *between,
                             fg__scatter *points, const fg_field_arrays *words);

/* The steps of both. Triangles between points that were made flat, x and y, those round
 * large empty circles in space left out; `far`: the number of the point that went to
 * infinity and is not among x and y, or -1. */
fg_status fg__scatter_triangulate(fg__triangles *out, fg__scatter_between *between,
                                  const fg__scatter *points, const double *x,
                                  const double *y, const double *position, int far);
fg_status fg__scatter_on_sphere(fg__sphere **out, fg__scatter_between *between,
                                fg__scatter *points, const fg_field_arrays *words);

/* The grid of points that are where its lines cross; *found: there is one. Of those lines
 * none may lack more crossings than have a point, but in holes. */
fg_status fg__scatter_find_grid(fg__point_grid *out, bool *found,
                                const fg__scatter *points);

/* Whether points in space are enough for a field between them; it, on a lattice, missing
 * where points are on one side only or far. MEMORY, STOPPED. */
bool fg__scatter_fills_space(const fg__scatter *points);
fg_status fg__scatter_fit(fg__point_grid *out, const fg__scatter *points);

/* The raster of cells that are located, with the samples of two components at their
 * points between them. MEMORY. */
fg_status fg__point_grid_sample(fg__point_grid *out, const fg__cell_set *set,
                                float *const velocity[2]);

/* Makes the axes ascend, and finds out whether the longitudes go round. */
fg_status fg__point_grid_straighten(fg__point_grid *grid, fg_context *context,
                                    const char *path, bool geographic);

/* The field of a grid, whose samples it takes over; the words are those of
 * fg_field_arrays. */
fg_status fg__point_grid_field(fg_field **out, fg_context *context, fg__point_grid *grid,
                               const fg_field_arrays *words, fg__slab_index slab);

#endif
