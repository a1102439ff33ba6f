/* Clusters of cells about their means, by Lloyd's method (S. Lloyd, "Least squares
 * quantization in PCM", IEEE Transactions on Information Theory 28, 1982), in 2D or 3D.
 */
#ifndef FG__RIVAL_LLOYD_H
#define FG__RIVAL_LLOYD_H

#include "rival/method.h"

typedef struct fg__lloyd {
  int count;           /* clusters; each has a member */
  double (*center)[3]; /* [count] mean of the members' places, in the box */
  int *first;          /* [count + 1] members of cluster n: from first[n] on */
  int *member;         /* cells of the raster, cluster by cluster, those nearest to the
                          centre first */
} fg__lloyd;

/* Divides the cells that have a direction into `count` clusters, or as many as there are
 * cells. A cell belongs to the nearest centre, by |dx|^2 / lambda^2 + weight^2 |dd|^2
 * with x the place, d the unit direction and lambda the fair-share length of `count`.
 * Starts from halves of equal cells across the axis of largest variance. MEMORY, STOPPED.
 */
fg_status fg__lloyd_create(fg__lloyd *out, fg_context *context, const fg__domain *domain,
                           int count, double weight);
void fg__lloyd_clear(fg__lloyd *lloyd);

/* Adds a curved arrow a cluster, of the options' length: through its centre, with
 * `through_member` through the member nearest to it; where there is no room for one,
 * through the next member. MEMORY, STOPPED. */
fg_status fg__lloyd_draw(fg_icons *icons, const fg_rival *rival, const fg__lloyd *lloyd,
                         int count, bool through_member);

#endif
