/* Delaunay triangulation of points in a plane: no corner of a triangle lies inside the
 * circle through the corners of another. */
#ifndef FG__DELAUNAY_H
#define FG__DELAUNAY_H

#include "base/context.h"

typedef struct fg__triangles {
  size_t count;
  int *corner; /* [3 * count], numbers of points; FG__FAR_POINT: the point at infinity */
} fg__triangles;

enum { FG__FAR_POINT = -1, FG__DELAUNAY_MOST = 300000000 };

/* Triangulates points at (x[i], y[i]), counter-clockwise, in expected O(n log n) whatever
 * their order and places. Places are rounded to 2^-30 of the larger width, and there all
 * decisions are exact; of points that are then the same one is a corner. With `closed`
 * the triangles between the hull's edges and the point at infinity are there, too. No
 * triangle where all points lie on a line. MEMORY, STOPPED, UNSUPPORTED (more than
 * FG__DELAUNAY_MOST points). */
fg_status fg__delaunay(fg__triangles *out, fg_context *context, size_t points,
                       const double *x, const double *y, bool closed);
void fg__triangles_clear(fg__triangles *triangles);

/* Drops the triangles that bridge a gap between points or a bay of their outline, and the
 * slivers along it: those whose circle's radius is more than `most` times both the local
 * spacing, a median of medians of edges, and the median radius
 * (docs/design/points.md). position[3 * points] in space. MEMORY. */
fg_status fg__triangles_cut(fg__triangles *triangles, size_t *dropped,
                            fg_context *context, size_t points, const double *position,
                            double most);

#endif
