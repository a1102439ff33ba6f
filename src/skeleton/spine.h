/* From a cluster's window to its distance map and to its spine. */
#ifndef FG__SPINE_H
#define FG__SPINE_H

#include "cluster/raster.h"

/* Distance to the cluster's border by fast marching, from the sub-cell zero set of
 * `level` inwards, input coordinates; 0 outside. `distance` has the window's nodes.
 * Sethian's upwind stencil with second order differences where the front is smooth.
 * Borders of the mask count as the cluster's border; whether the domain's border (and the
 * cut through a band) does, the caller says: it should for spines and for the room an
 * arrow has, since a picture ends there (a cluster that is the whole domain has no other
 * border, so there it always does). MEMORY. */
fg_status fg__march(double *distance, fg_context *context, const fg__window *window,
                    bool domain_border_counts);

/* A line along the ridge of the distance map, through the cluster from border to border:
 * the longest way through it, round the largest hole if that is longer. A cluster hardly
 * longer than wide gets the chord through its middle along its principal axis. */
typedef struct fg__spine {
  int count;          /* at least 1 */
  double (*point)[2]; /* input coordinates, evenly spaced by about one cell */
  double *distance;   /* distance to the border at each point */
  bool closed;        /* a ring: point[count - 1] is next to point[0] */
  double length;      /* input coordinates; of a ring all round */
  int center;         /* index of the middle by arc length; of a ring its widest point */
} fg__spine;

/* MEMORY, ARGUMENT (a window without a positive node). */
fg_status fg__spine_create(fg__spine *out, fg_context *context, const fg__window *window,
                           const double *distance);
void fg__spine_clear(fg__spine *spine);

#endif
