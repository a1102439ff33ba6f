/* Closed outlines of areas: where a density is positive, and where a grid is masked. */
#ifndef FG__CONTOUR_H
#define FG__CONTOUR_H

#include "base/context.h"

/* Closed polygons, the first vertex not repeated; loop k runs from start[k] to
 * start[k + 1] - 1. Filled by the winding rule: the area lies to the left. */
typedef struct fg__polygons {
  double (*point)[2];
  size_t point_count, point_capacity;
  size_t *start;
  size_t count, start_capacity;
} fg__polygons;

void fg__polygons_clear(fg__polygons *polygons);

/* Area of a loop: positive round an area, negative round a hole in it. */
double fg__polygon_area(const fg__polygons *polygons, size_t loop);

/* Drops vertices that lie within `tolerance` of the polygon through those kept. */
void fg__polygons_simplify(fg__polygons *polygons, double tolerance);

/* The area where u > 0, by marching squares with linear interpolation along the edges of
 * the grid, closed along the domain's boundary. Loops smaller than the density's debris
 * are left out, unless a periodic boundary cuts them. Coordinates of the input. */
fg_status fg__contour_positive(fg__polygons *out, fg_context *context,
                               const fg_density_arrays *density);

/* The cells with a non-zero byte in `mask` (size[0] * size[1], x fastest) as polygons
 * whose corners are rounded within half a cell, but for those on the grid's boundary.
 * edges[k] holds size[k] + 1 coordinates. */
fg_status fg__contour_cells(fg__polygons *out, fg_context *context,
                            const unsigned char *mask, const int size[2],
                            const double *const edges[2]);

#endif
