/* How the contour tracers grow their polygons. */
#ifndef FG__POLYGONS_H
#define FG__POLYGONS_H

#include "picture/contour.h"

/* Begins a loop; adds a vertex to it; both say false when there is no memory. */
bool fg__polygons_begin(fg__polygons *polygons);
bool fg__polygons_add(fg__polygons *polygons, const double point[2]);

void fg__polygons_drop_last(fg__polygons *polygons);

/* Appends loops like those of `from`, whose corners are rounded over a distance; what is
 * smaller becomes smaller still or goes. Points on the box stay. MEMORY: false. */
bool fg__polygons_add_smooth(fg__polygons *polygons, const fg__polygons *from,
                             double distance, const double low[2], const double high[2]);

/* Whether a loop contains a point, by the even-odd rule. */
bool fg__polygon_contains(const fg__polygons *polygons, size_t loop, double x, double y);

#endif
