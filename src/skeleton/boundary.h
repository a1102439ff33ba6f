/* Distance to a cluster's boundary for the nodes next to it. */
#ifndef FG__BOUNDARY_H
#define FG__BOUNDARY_H

#include "cluster/window.h"

/* Sets `distance` (the window's nodes) to the distance from the boundary at nodes near
 * it, and to infinity elsewhere. The boundary is the zero set of the level, linear along
 * each axis, in the active cells, where active cells meet masked ones, and, if it counts,
 * that of the domain. In 2D (boundary.c) on either side of the boundary; values up to the
 * smaller spacing are exact but for taking the hyperbola in a cell as two chords (an
 * eighth of its bend off); larger ones are upper bounds. In 3D (boundary_solid.c) inside
 * the cluster only, by the plane through the crossings of the zero set on a node's own
 * edges. */
void fg__boundary_distance(double *distance, const fg__window *window,
                           bool domain_boundary_counts);

/* boundary_solid.c: what that does in 3D. */
void fg__boundary_distance_solid(double *distance, const fg__window *window,
                                 bool domain_boundary_counts);

#endif
