/* The spine of a cluster in 3D: a polyline from one end of it to the other along the
 * ridge of the distance map. */
#ifndef FG__CORE_H
#define FG__CORE_H

#include "cluster/volume.h"

typedef struct fg__core {
  double (*point)[3]; /* input coordinates */
  int count;          /* at least 1 */
  double length;
  double center[3]; /* the middle by length */
  double radius;    /* distance to the border there */
} fg__core;

/* The ends are the two nodes farthest from each other by ways inside the cluster; between
 * them the way that is cheapest when a step near the border costs more, by the square of
 * (greatest distance / distance there): so it keeps to the ridge (penalised distance:
 * Sato, Bitter, Bender, Kaufman and Nakajima, "TEASAR", Pacific Graphics 2000). The
 * staircase of nodes is smoothed. MEMORY. */
fg_status fg__core_create(fg__core *out, fg_context *context, const fg__volume *volume,
                          const double *distance);
void fg__core_clear(fg__core *core);

#endif
