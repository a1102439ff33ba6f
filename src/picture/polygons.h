/* How the contour tracers grow their polygons. */
#ifndef FG__POLYGONS_H
#define FG__POLYGONS_H

#include "picture/contour.h"

/* Begins a loop; adds a vertex to it; both say false when there is no memory. */
bool fg__polygons_begin(fg__polygons *polygons);
bool fg__polygons_add(fg__polygons *polygons, const double point[2]);

void fg__polygons_drop_last(fg__polygons *polygons);

#endif
