/* Clusters cut where they cross a periodic boundary: a map ends there. */
#ifndef FG__RIVAL_PIECES_H
#define FG__RIVAL_PIECES_H

#include "rival/domain.h"

typedef struct fg__rival_pieces {
  int *label;   /* a number a cell, 0: none, else 1 ... count */
  int *cluster; /* [count] the cluster that a part belongs to, ascending */
  int *cells;   /* [count] */
  int count;
} fg__rival_pieces;

/* Divides the clusters that have cells on both sides of a periodic boundary, in the same
 * row or column, into pieces joined within the box: the largest is a part, and so is each
 * with a quarter of the cluster, or of the mean cluster, as in 2D icons
 * (cluster/raster.h). Other clusters are one part. label: as fg__clusters_draw takes it.
 * All zero after a failure. MEMORY. */
fg_status fg__rival_pieces_create(fg__rival_pieces *out, fg_context *context,
                                  const fg__domain *domain, const int *label, int count);
void fg__rival_pieces_clear(fg__rival_pieces *pieces);

#endif
