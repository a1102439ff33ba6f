/* What windows that are cut out of a density have in common in 2D and 3D. */
#ifndef FG__CUT_H
#define FG__CUT_H

#include "cluster/raster.h"

/* Two nodes beyond the cluster: one for the zero set, one more so that gradients next to
 * it can be taken. */
enum { FG__CUT_RIM = 2 };

/* Level of a masked place: the well outside the clusters. */
#define FG__CUT_OUTSIDE (-1.0F)

static inline int fg__cut_wrap(int index, int period)
{
  int rest = index % period;
  return rest < 0 ? rest + period : rest;
}

/* Level where something else than the cluster has u > 0: as near to zero as still is
 * outside, so that the zero set moves least in a cell which two clusters touch from two
 * corners. On the edges of the cells it does not move at all. */
float fg__cut_turned_off(float u);

/* Sets the place of a cluster's window along one axis; returns its first node on the
 * density's grid. */
int fg__cut_place(int *nodes, double *origin, bool at_border[2],
                  const fg_density_arrays *density, const fg__labels *labels, int cluster,
                  int axis);

/* Turns off all pieces of {level > 0} but the largest; nodes[2] is 0 in 2D. MEMORY. */
fg_status fg__cut_keep_largest(float *level, const unsigned char *active,
                               const int nodes[3], fg_context *context);

#endif
