/* What methods that divide the domain into clusters share: icons and pictures of them. */
#ifndef FG__RIVAL_CLUSTERS_H
#define FG__RIVAL_CLUSTERS_H

#include "rival/domain.h"

/* Adds a curved arrow a cluster, as long as the root of its area, through its centre: the
 * mean of its cells, or the cell of the cluster nearest to it. A cluster across a
 * periodic boundary has one for each of its parts (rival/cluster/pieces.h), and all end
 * there. label: a number a cell of the raster, 0 none, 1 ... count. MEMORY, STOPPED. */
fg_status fg__clusters_draw(fg_icons *icons, fg_context *context,
                            const fg__domain *domain, const int *label, int count,
                            int left_out);

/* The clusters as a density, 1 within them and -1 on the lines between them: what is
 * drawn behind arrows, and written with labels. MEMORY. */
fg_status fg__clusters_density(fg_density **out, fg_context *context,
                               const fg__domain *domain, const int *label, int count);

#endif
