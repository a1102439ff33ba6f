/* The clusters of a density on a grid that ranks and threads divide: each rank has a
 * block, each of its threads cuts a slab of that block as one of the boxes of
 * components.h, and all pieces are joined, alike on every rank. A process alone has one
 * block; one thread has one slab. */
#ifndef FG__CLUSTERS_H
#define FG__CLUSTERS_H

#include "base/threads.h"
#include "component/components.h"
#include "grid/exchange/halo.h"
#include "grid/layout.h"

/* This rank's block of the grid. */
typedef struct fg__cluster_grid {
  const fg__partition *partition; /* of the nodes */
  const fg__layout *layout;       /* of the block's arrays */
  const unsigned char *active; /* the cell whose lowest corner is node (0, 0, 0), with one
                                  cell more beyond each side; NULL: all are active */
  ptrdiff_t cell_row, cell_plane;
  fg__threads *threads; /* NULL: one thread */
} fg__cluster_grid;

/* Result and working memory; zero it before the first use, use it again and again on the
 * same grid. */
typedef struct fg__clusters {
  fg__components found; /* count, debris and area, once clusters are counted */
  double covered;       /* cells, of all ranks */
  fg__component_box block;
  fg__halo halo;
  float *u;    /* as the halo has it, like the number of each node's piece; which is */
  int *number; /* NULL where a single slab is all of the grid */
  int slabs;
  fg__components *slab; /* [slabs] */
  int *first;           /* [slabs + 1] slices of each */
  fg_status *status;    /* [slabs] */
  uint64_t *table;      /* [ranks] */
  int before;           /* pieces of the ranks before this one */
} fg__clusters;

typedef struct fg__cluster_request {
  bool counting;      /* clusters too, not only what is covered */
  double debris_area; /* in cells */
  double exact_below; /* areas above may be lower bounds instead, which are above, too; 0:
                    all are exact */
} fg__cluster_request;

/* Finds what is covered and the clusters of u, an array of the layout whose ghosts are
 * filled (NULL: 1 everywhere). The same result for any ranks and threads. Collective.
 * MEMORY, ARGUMENT (a block too large for int labels). */
fg_status fg__clusters_find(fg__clusters *clusters, fg_context *context,
                            const fg__cluster_grid *grid, const float *u,
                            const fg__cluster_request *request);

/* Writes the labels (components.h) of the block's nodes to a plain array, x fastest, once
 * clusters were counted. */
void fg__clusters_label(const fg__clusters *clusters, int *label);

void fg__clusters_clear(fg__clusters *clusters);

#endif
