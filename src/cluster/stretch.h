/* Where a cluster's window crosses the periodic borders of the domain. */
#ifndef FG__STRETCH_H
#define FG__STRETCH_H

#include "cluster/raster.h"

/* Nodes of a window along one axis between two neighbouring borders of the domain. */
typedef struct fg__stretch {
  int first, last; /* of the window, both included */
  int start;       /* the first on the density's grid, in [0, period] */
} fg__stretch;

/* Sets the stretch number n, from 0 on, of a window of `nodes` nodes from `origin` (input
 * coordinates) on; false when there are fewer. */
bool fg__stretch_find(fg__stretch *out, const fg_density_arrays *density, int axis,
                      double origin, int nodes, int n);

/* The share of a cluster from which on a part that is not its largest gets an icon: a
 * quarter of it, or of the mean cluster when that is less. */
double fg__stretch_least(const fg__labels *labels, int cluster);

#endif
