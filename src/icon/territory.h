/* Territories: every point of the domain belongs to the cluster that is nearest to it,
 * along ways that cross no mask. */
#ifndef FG__TERRITORY_H
#define FG__TERRITORY_H

#include "base/context.h"
#include "cluster/raster.h"
#include "evolve/components.h"

typedef struct fg__territories {
  fg__component_grid grid; /* the density's */
  const int *label;        /* of the clusters, borrowed */
  double origin[2], spacing[2];
  int *owner;        /* a cluster's label a node; 0 where no way leads */
  double *distance;  /* to that cluster's border, input coordinates; 0 in it */
  double fair_share; /* sqrt(area of the domain / number of clusters) */
} fg__territories;

/* Finds the territories of all clusters at once by fast marching. MEMORY. */
fg_status fg__territories_create(fg__territories *out, fg_context *context,
                                 const fg_density_arrays *density,
                                 const fg__labels *labels);
void fg__territories_clear(fg__territories *territories);

/* The part of one cluster's territory at most `reach` from a point along each axis, as a
 * window: its level is the distance to the border with other territories, right within
 * one spacing of it and cut there. A window without a positive node is possible. MEMORY.
 */
fg_status fg__territory_window(fg__window *out, fg_context *context,
                               const fg__territories *territories, int cluster,
                               const double center[2], double reach);

#endif
