/* Clusters of a density that several ranks share: component/components.h on every block,
 * then joined where blocks meet, alike on all ranks. */
#ifndef FG__SPREAD_CLUSTERS_H
#define FG__SPREAD_CLUSTERS_H

#include "component/components.h"
#include "solver/spread.h"

/* Working memory; zero it before the first use. */
typedef struct fg__spread_clusters {
  fg__components pieces;  /* of this rank's block */
  float *u;               /* of the block with its ring, x fastest */
  int *number;            /* like u */
  unsigned char *active;  /* cells, those one beyond included; NULL: all */
  fg__component_box grid; /* the block */
  fg__components whole;   /* the result on every rank: count, debris, area */
  double covered;         /* cells, of all ranks */
  int before;             /* pieces of the ranks before this one */
} fg__spread_clusters;

/* Finds the share covered and, when `counting`, the clusters of u, an array of the level
 * with ghosts (NULL: 1 everywhere); `scratch` is an array of it. Collective. MEMORY. */
fg_status fg__spread_clusters_find(fg__spread_clusters *clusters, fg_context *context,
                                   const fg__spread *spread, const float *u,
                                   float *scratch, double debris_area, bool counting);

/* Writes the labels (component/components.h) of the block's nodes to a plain array, x
 * fastest, once clusters were counted. */
void fg__spread_clusters_label(const fg__spread_clusters *clusters, int *label);
void fg__spread_clusters_clear(fg__spread_clusters *clusters);

#endif
