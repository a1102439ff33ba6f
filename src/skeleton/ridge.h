/* The path along the ridge of the distance map, node by node, in 2D or 3D. */
#ifndef FG__RIDGE_H
#define FG__RIDGE_H

#include "cluster/window.h"

typedef struct fg__ridge {
  int count; /* at least 1 */
  int *node; /* of the window, each joined to the next; open: from end to end */
  bool closed;
} fg__ridge;

/* Finds the ridge path between the two ends of a cluster that are farthest apart inside
 * it; or, in 2D, when the cluster has a hole and the way round it is the longer one, the
 * ridge path round the largest hole. MEMORY. */
fg_status fg__ridge_create(fg__ridge *out, fg_context *context, const fg__window *window,
                           const double *distance);
void fg__ridge_clear(fg__ridge *ridge);

#endif
