/* What the stages after the evolution see of the density: labels on its grid, and the
 * patches that windows (cluster/window.h) are cut from. Nothing here knows a mesh. In 2D
 * the third axis has one node, without a cell. */
#ifndef FG__RASTER_H
#define FG__RASTER_H

#include "flowgrain/flowgrain.h"

/* Labels of the nodes: 0 outside every cluster, else 1 ... count in the order of each
 * cluster's first node (x fastest). Nodes are joined when they are neighbours along an
 * axis or across a cell (in 3D a cell's face) whose bilinear density stays positive on
 * the diagonal, and an active cell joins them (component/components.h). A node without an
 * active cell is outside. */
typedef struct fg__labels {
  const int *label; /* a number a node of this rank's block, the density's own */
  int count;        /* clusters, debris not counted */
  double *area;     /* [count], input coordinates squared (cubed), sub-cell: area (volume)
                       of {u > 0} */
  int (*bounds)[6]; /* [count], first and last node: x0, x1, y0, y1, z0, z1; across a
                       periodic boundary x1 goes past the last node, x0 never does */
  bool (*closed)[3]; /* [count], the cluster goes round the whole period: it is cut at the
                        column (row, plane) where it has fewest nodes, which is x0 and
                        again x1 */
  int debris;        /* components too small to be clusters: labelled -1 */
} fg__labels;

/* The same on all ranks, but for `label`; the density is borrowed. Collective. MEMORY. */
fg_status fg__labels_create(fg__labels *out, fg_context *context,
                            const fg_density *density);
void fg__labels_clear(fg__labels *labels);

/* Part of a density's grid with its labels: what one cluster's window is cut from. */
typedef struct fg__patch {
  int first[3], nodes[3]; /* of the grid; along a periodic axis it may begin before node 0
                             and end behind the last, or be all of the period */
  const float *u;
  const int *label;
  const unsigned char *active; /* cells, nodes[k] - 1 along an axis, or nodes[k] when it
                                  is all of a period; NULL: all active */
  bool owned;                  /* fg__patch_clear frees these arrays */
} fg__patch;

/* The whole grid as a patch. */
fg__patch fg__patch_of(const fg_density_arrays *density, const fg__labels *labels);

/* Sets first and nodes to what the window of a cluster with these bounds is cut from. */
void fg__patch_place(fg__patch *patch, const fg_density_arrays *density,
                     const int bounds[6], const bool closed[3]);

#endif
