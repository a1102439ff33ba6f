/* The spine of a cluster, in 2D or 3D. */
#ifndef FG__SPINE_H
#define FG__SPINE_H

#include "skeleton/march.h"

/* A line along the ridge of the distance map, through the cluster from end to end: the
 * longest way through it. In 2D it goes on to the boundary at both ends, and round the
 * largest hole if that is longer; a cluster hardly longer than wide gets the chord
 * through its middle along its principal axis. In 3D it is the smoothed path of nodes. */
typedef struct fg__spine {
  int count;          /* at least 1 */
  double (*point)[3]; /* input coordinates, about one cell apart; z = 0 in 2D */
  double *distance;   /* distance to the boundary at each point */
  bool closed;        /* a ring: point[count - 1] is next to point[0] */
  double length;      /* input coordinates; of a ring all round */
  int center;         /* index of the middle by arc length; of a ring its widest point */
  double middle[3]; /* in 2D that point, in 3D the middle itself, which lies on the piece
                       after it */
} fg__spine;

/* MEMORY, ARGUMENT (a window without a positive node). */
fg_status fg__spine_create(fg__spine *out, fg_context *context, const fg__window *window,
                           const double *distance);
void fg__spine_clear(fg__spine *spine);

#endif
