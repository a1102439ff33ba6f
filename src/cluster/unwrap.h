/* Bounds of a cluster in coordinates that go on across periodic boundaries. */
#ifndef FG__UNWRAP_H
#define FG__UNWRAP_H

#include "component/components.h"

typedef struct fg__unwrap {
  const fg__component_grid *grid;
  const int *label;
  int (*place)[3];     /* [nodes] where the flood met a node, unwrapped */
  unsigned char *seen; /* [nodes] */
  int *queue;          /* [nodes] */
} fg__unwrap;

/* Takes memory for a grid; `label` and `grid` are borrowed. MEMORY. */
fg_status fg__unwrap_create(fg__unwrap *out, fg_context *context,
                            const fg__component_grid *grid, const int *label);
void fg__unwrap_clear(fg__unwrap *unwrap);

/* Follows the cluster of node `first` across the boundaries: its first and last node
 * along each axis, and whether it meets itself a period on, in which case the axis is cut
 * at the column (row, plane) with the fewest nodes of the cluster and the bounds are that
 * column and its next copy. The lower bounds lie inside the grid. */
void fg__unwrap_bounds(fg__unwrap *unwrap, int first, int bounds[6], bool closed[3]);

#endif
