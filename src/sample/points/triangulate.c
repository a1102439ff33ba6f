/* Triangles between points, in the plane or on the sphere. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/vector.h"
#include "sample/points/points.h"

/* Triangles round larger empty circles are dropped. Of 1e6 points at random the largest
 * empty circle has 2.2 times their spacing (docs/design/points.md). */
static const double MOST_EMPTY_CIRCLE = 2.5;

/* Of their width: points that are no farther from a line are on it. */
static const double ON_LINE = 1e-6;

/* Cosine of the angle from their centre within which points are flattened from the
 * opposite place; others go round the globe. */
static const double FARTHEST_COSINE = -0.2;

/* Half the square of a distance that is rounding. */
static const double NEAREST = 1e-32;

enum { CANDIDATES = 64 };

/* Smallest over largest root mean square distance from a line through the centre. */
static double flatness(size_t points, const double *x, const double *y)
{
  double mean[2] = {0.0, 0.0}, xx = 0.0, xy = 0.0, yy = 0.0;
  const double share = 1.0 / (double)points;
  for (size_t i = 0; i < points; ++i) {
    mean[0] += share * x[i];
    mean[1] += share * y[i];
  }
  for (size_t i = 0; i < points; ++i) {
    xx += share * (x[i] - mean[0]) * (x[i] - mean[0]);
    xy += share * (x[i] - mean[0]) * (y[i] - mean[1]);
    yy += share * (y[i] - mean[1]) * (y[i] - mean[1]);
  }
  /* eigenvalues a + b and a - b; the smaller one as the determinant over the larger */
  const double large = 0.5 * (xx + yy) + hypot(0.5 * (xx - yy), xy);
  const double small = large > 0.0 ? (xx * yy - xy * xy) / large : 0.0;
  return large > 0.0 ? sqrt(fmax(0.0, small / large)) : 0.0;
}

/* The point at infinity is number `far`. */
static void name_far_point(fg__triangles *triangles, int far)
{
  for (size_t c = 0; c < 3 * triangles->count; ++c) {
    int *corner = &triangles->corner[c];
    *corner = *corner == FG__FAR_POINT ? far : *corner + (*corner >= far);
  }
}

fg_status fg__scatter_triangulate(fg__triangles *out, fg__scatter_between *between,
                                  const fg__scatter *points, const double *x,
                                  const double *y, const double *position, int far)
{
  const size_t flat = points->count - (far >= 0);
  fg_status status = fg__delaunay(out, points->context, flat, x, y, far >= 0);
  if (status == FG_STATUS_OK && (out->count == 0 || flatness(flat, x, y) < ON_LINE))
    status = fg__fail(points->context, FG_STATUS_UNSUPPORTED,
                      "%s: its %zu points lie on one line; a field needs an area",
                      points->path, points->count);
  if (status == FG_STATUS_OK && far >= 0)
    name_far_point(out, far);
  if (status == FG_STATUS_OK)
    status = fg__triangles_cut(out, &between->gaps, points->context, points->count,
                               position, MOST_EMPTY_CIRCLE);
  between->cells = out->count;
  return status;
}

/* The point opposite to the middle of all; false when they lie all round. */
static bool find_opposite(double pole[3], const double *position, size_t points)
{
  double least = 1.0;
  pole[0] = pole[1] = pole[2] = 0.0;
  for (size_t i = 0; i < points; ++i)
    for (int k = 0; k < 3; ++k)
      pole[k] -= position[3 * i + (size_t)k] / (double)points;
  if (fg__dot(pole, pole) < 1e-12)
    return false;
  fg__normalise(pole);
  for (size_t i = 0; i < points; ++i)
    least = fmin(least, -fg__dot(pole, position + 3 * i));
  return least > FARTHEST_COSINE;
}

/* Of some points, the one whose nearest neighbour is farthest. */
static int find_lonely(const double *position, size_t points)
{
  const size_t step = points / CANDIDATES + 1;
  double best = 1.0;
  int found = 0;
  for (size_t c = 0; c < points; c += step) {
    double nearest = -1.0;
    for (size_t i = 0; i < points; ++i)
      if (i != c)
        nearest = fmax(nearest, fg__dot(position + 3 * c, position + 3 * i));
    if (nearest < best) {
      best = nearest;
      found = (int)c;
    }
  }
  return found;
}

/* Stereographic projection from the pole, which keeps circles circles, and so makes
 * Delaunay's triangulation of the sphere one of the plane. */
static void flatten(double *x, double *y, const double pole[3], const double *position,
                    size_t points, int left_out)
{
  double e[3] = {0.0, 0.0, 0.0}, f[3];
  e[fabs(pole[2]) < 0.7 ? 2 : 0] = 1.0;
  const double along = fg__dot(e, pole);
  for (int k = 0; k < 3; ++k)
    e[k] -= along * pole[k];
  fg__normalise(e);
  for (int k = 0; k < 3; ++k)
    f[k] = pole[(k + 1) % 3] * e[(k + 2) % 3] - pole[(k + 2) % 3] * e[(k + 1) % 3];
  size_t n = 0;
  for (size_t i = 0; i < points; ++i) {
    const double *p = position + 3 * i;
    if ((int)i == left_out)
      continue;
    /* 1 - pole . p, without cancellation close to the pole */
    double near = 0.0;
    for (int k = 0; k < 3; ++k)
      near += 0.5 * (p[k] - pole[k]) * (p[k] - pole[k]);
    near = fmax(near, NEAREST); /* another point at the very place */
    x[n] = fg__dot(e, p) / near;
    y[n++] = fg__dot(f, p) / near;
  }
}

static fg_status triangulate_sphere(fg__triangles *out, fg__scatter_between *between,
                                    const fg__scatter *points)
{
  const size_t count = points->count;
  double *position = fg__allocate(3 * count, sizeof *position);
  double *x = fg__allocate(count, sizeof *x), *y = fg__allocate(count, sizeof *y);
  fg_status status = FG_STATUS_OK;
  double pole[3];
  int far = -1;
  if (!position || !x || !y)
    status = fg__fail_memory(points->context, "points", 5 * count * sizeof *x);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i)
    fg__sphere_unit_vector(position + 3 * i, points->position[0][i],
                           points->position[1][i]);
  if (status == FG_STATUS_OK) {
    if (!find_opposite(pole, position, count)) {
      far = find_lonely(position, count);
      for (int k = 0; k < 3; ++k)
        pole[k] = position[3 * (size_t)far + (size_t)k];
    }
    flatten(x, y, pole, position, count, far);
    status = fg__scatter_triangulate(out, between, points, x, y, position, far);
  }
  free(position);
  free(x);
  free(y);
  return status;
}

/* Hands the points' arrays over to the cells. */
static fg_status make_cells(fg__sphere_cells *out, const fg__triangles *triangles,
                            fg__scatter *points, const fg_field_arrays *words)
{
  *out = (fg__sphere_cells){.points = points->count,
                            .longitude = points->position[0],
                            .latitude = points->position[1],
                            .east = points->velocity[0],
                            .north = points->velocity[1],
                            .count = triangles->count,
                            .words = words};
  for (int k = 0; k < 2; ++k) {
    points->position[k] = NULL;
    points->velocity[k] = NULL;
  }
  out->corner = fg__allocate(4 * triangles->count, sizeof *out->corner);
  if (!out->corner)
    return fg__fail_memory(points->context, "cells", 16 * triangles->count);
  for (size_t t = 0; t < triangles->count; ++t) {
    for (size_t k = 0; k < 3; ++k)
      out->corner[4 * t + k] = triangles->corner[3 * t + k];
    out->corner[4 * t + 3] = -1;
  }
  return FG_STATUS_OK;
}

fg_status fg__scatter_on_sphere(fg__sphere **out, fg__scatter_between *between,
                                fg__scatter *points, const fg_field_arrays *words)
{
  fg__triangles triangles = {0};
  fg__sphere_cells made = {0};
  *out = NULL;
  fg_status status = triangulate_sphere(&triangles, between, points);
  if (status == FG_STATUS_OK) {
    status = make_cells(&made, &triangles, points, words);
    if (status == FG_STATUS_OK)
      status = fg__sphere_of_cells(out, points->context, &made);
    else
      fg__sphere_cells_clear(&made);
  }
  fg__triangles_clear(&triangles);
  return status;
}
