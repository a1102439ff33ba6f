/* The clusters of a whole grid, found by a team: each member cuts a slab of it, as if it
 * were one of several boxes (components.h). */
#ifndef FG__TEAM_CLUSTERS_H
#define FG__TEAM_CLUSTERS_H

#include "base/team.h"
#include "component/components.h"
#include "grid/layout.h"

/* Result and working memory; zero it before the first use, use it again and again on the
 * same grid. */
typedef struct fg__team_clusters {
  fg__components whole; /* count, debris and area, once clusters are counted */
  double covered;       /* as in components.h */

  int slabs;
  fg__components *slab; /* [slabs] */
  int *first;           /* [slabs + 1] slices of each */
  fg_status *status;    /* [slabs] */
  float *u;             /* plain, with a slice before the first and one behind the last */
  int *number;          /* laid out like it */
} fg__team_clusters;

/* The grid's nodes are those of the layout; u in that layout. active and debris_area as
 * in fg__component_grid. counting: clusters too, not only what is covered. The same
 * result for any team. MEMORY, ARGUMENT. */
fg_status fg__team_clusters_find(fg__team_clusters *clusters, fg_context *context,
                                 fg__team *team, const fg__layout *layout,
                                 const bool periodic[3], const float *u,
                                 const unsigned char *active, double debris_area,
                                 bool counting);
void fg__team_clusters_clear(fg__team_clusters *clusters);

#endif
