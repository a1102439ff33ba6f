/* From a cluster's window to its distance map, in 2D or 3D. */
#ifndef FG__MARCH_H
#define FG__MARCH_H

#include "cluster/window.h"

/* Distance to the cluster's boundary by fast marching, from the sub-cell zero set of
 * `level` inwards, input coordinates; 0 outside. `distance` has the window's nodes.
 * Sethian's upwind stencil with second order differences where the front is smooth.
 * Boundaries of the mask count as the cluster's boundary; whether the domain's boundary
 * (and the cut through a closed cluster) does, the caller says: it should for spines and
 * for the clearance of an arrow, since a picture ends there (a cluster that is the whole
 * domain has no other boundary, so there it always does). MEMORY. */
fg_status fg__march(double *distance, fg_context *context, const fg__window *window,
                    bool domain_boundary_counts);

#endif
