/* What the stages after the evolution see of the density: labels on its grid, and a
 * window a cluster (in 3D: cluster/volume.h). Nothing here knows a mesh. In 2D the third
 * axis has one node, without a cell. */
#ifndef FG__RASTER_H
#define FG__RASTER_H

#include "flowgrain/flowgrain.h"

/* Labels of the nodes: 0 outside every cluster, else 1 ... count in the order of each
 * cluster's first node (x fastest). Nodes are joined when they are neighbours along an
 * axis or across a cell (in 3D a cell's face) whose bilinear density stays positive on
 * the diagonal, and an active cell joins them (component/components.h). A node without an
 * active cell is outside. */
typedef struct fg__labels {
  int *label;       /* a number a node of the density */
  int count;        /* clusters, debris not counted */
  double *area;     /* [count], input coordinates squared (cubed), sub-cell: area (volume)
                       of {u > 0} */
  int (*bounds)[6]; /* [count], first and last node: x0, x1, y0, y1, z0, z1; across a
                       periodic border x1 goes past the last node, x0 never does */
  bool (*closed)[3]; /* [count], the cluster goes round the whole period: it is cut at the
                        column (row, plane) where it has fewest nodes, which is x0 and
                        again x1 */
  int debris;        /* components too small to be clusters: labelled -1 */
} fg__labels;

fg_status fg__labels_create(fg__labels *out, fg_context *context,
                            const fg_density_arrays *density);
void fg__labels_clear(fg__labels *labels);

/* Part of a density's grid with its labels: what one cluster's window is cut from. */
typedef struct fg__patch {
  int first[3], nodes[3]; /* of the grid; along a periodic axis it may begin before node 0
                             and end behind the last, or be all of the period */
  const float *u;
  const int *label;
  const unsigned char *active; /* cells, nodes[k] - 1 along an axis, or nodes[k] when it
                                  is all of a period; NULL: all active */
} fg__patch;

/* The whole grid as a patch. */
fg__patch fg__patch_of(const fg_density_arrays *density, const fg__labels *labels);

/* Sets first and nodes to what the window of a cluster with these bounds is cut from. */
void fg__patch_place(fg__patch *patch, const fg_density_arrays *density,
                     const int bounds[6], const bool closed[3]);

/* One cluster on a grid of its own: its bounding box and a rim of 2 nodes round it (cut
 * where the domain ends, unless periodic). A cluster that goes round the whole period is
 * cut: the window then spans one period from cut to cut, without a rim; what hangs on the
 * cluster by the cut alone is left out. */
typedef struct fg__window {
  int cluster;      /* its label */
  int nodes[2];     /* along x and y */
  double origin[2]; /* node (0, 0), input coordinates, unwrapped */
  double spacing[2];
  float *level;          /* nodes[0] * nodes[1]: > 0 inside this cluster, where it is the
                            density; other clusters, debris and masked places are <= 0 */
  unsigned char *active; /* (nodes[0] - 1) * (nodes[1] - 1) cells; 0 = masked */
  bool at_border[4];     /* the window's left, right, lower, upper edge is the domain's
                            border (not a periodic one), or the cut through a band */
} fg__window;

/* Whether the edge from node (x, y) of a window to its next node along `axis` adjoins an
 * active cell: only then are its ends neighbours. The edge must exist. */
bool fg__window_edge_active(const fg__window *window, int x, int y, int axis);

/* Cuts the window of a cluster out of the whole density, or out of a patch: then the
 * density's own u and active, and the labels' own label, are not read. MEMORY, ARGUMENT
 * (no such cluster). */
fg_status fg__window_create(fg__window *out, fg_context *context,
                            const fg_density_arrays *density, const fg__labels *labels,
                            int cluster);
fg_status fg__window_cut(fg__window *out, fg_context *context,
                         const fg_density_arrays *density, const fg__labels *labels,
                         const fg__patch *patch, int cluster);
void fg__window_clear(fg__window *window);

/* Room for the levels, zero, and active cells of a window whose nodes are set; the window
 * is empty after a failure. MEMORY. */
fg_status fg__window_allocate(fg__window *window, fg_context *context);

/* Of the pieces of {level > 0} only the largest stays. MEMORY. */
fg_status fg__window_keep_largest(fg__window *window, fg_context *context);

/* A part of a cluster that gets an icon of its own, of at most so many, in 2D and 3D: a
 * box has eight corners. */
enum { FG__WINDOW_PARTS = 8 };

typedef struct fg__window_part {
  fg__window window;
  double share; /* of the cluster: those of all parts are 1 together */
} fg__window_part;

/* Cuts a cluster's window where it crosses periodic borders, since a map ends there: the
 * largest part, and the larger ones of those that hold a quarter of the cluster, or of
 * the mean cluster, each where it lies in the domain; in the window's order, x fastest.
 * A cut edge is at_border. One that crosses none is the only part. Takes `whole`, which
 * is empty afterwards; *count parts are to be cleared, also after a failure. MEMORY. */
fg_status fg__window_divide(fg__window_part part[FG__WINDOW_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__window *whole);

/* Bilinear level at a point in input coordinates; a negative number outside the window or
 * in a masked cell. */
double fg__window_level(const fg__window *window, const double position[2]);

#endif
