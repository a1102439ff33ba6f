/* One cluster on a grid of its own, in 2D or 3D. In 2D the third axis has one node and
 * one layer of cells. */
#ifndef FG__WINDOW_H
#define FG__WINDOW_H

#include "cluster/raster.h"

/* A cluster's bounding box and a rim of 2 nodes round it, cut where the domain ends
 * unless it is periodic. A cluster that goes round the whole period is cut: the window
 * then covers one period from cut to cut, without a rim, and what is connected to the
 * cluster by the cut alone is left out. */
typedef struct fg__window {
  int cluster;       /* its label */
  int dimension;     /* 2 or 3 */
  int nodes[3];      /* at least 2 along each axis; 1 along z in 2D */
  double origin[3];  /* of the first node, input coordinates, unwrapped; z = 0 in 2D */
  double spacing[3]; /* 0 along z in 2D */
  float *level;      /* [nodes]: > 0 inside this cluster, where it is the density; other
                        clusters, debris and masked places are <= 0 */
  unsigned char *active; /* [cells], nodes[k] - 1 along an axis; 0 = masked */
  bool at_boundary[6];   /* the window's low and high side of each axis is the domain's
                            boundary (not a periodic one), or the cut through a closed
                            cluster */
} fg__window;

static inline size_t fg__window_count(const fg__window *window)
{
  return (size_t)window->nodes[0] * (size_t)window->nodes[1] * (size_t)window->nodes[2];
}

static inline size_t fg__window_node(const fg__window *window, int x, int y, int z)
{
  return ((size_t)z * (size_t)window->nodes[1] + (size_t)y) * (size_t)window->nodes[0] +
         (size_t)x;
}

static inline size_t fg__window_cell(const fg__window *window, int x, int y, int z)
{
  size_t cells_x = (size_t)window->nodes[0] - 1, cells_y = (size_t)window->nodes[1] - 1;
  return ((size_t)z * cells_y + (size_t)y) * cells_x + (size_t)x;
}

static inline void fg__window_place(const fg__window *window, size_t node, int place[3])
{
  size_t width = (size_t)window->nodes[0], height = (size_t)window->nodes[1];
  place[0] = (int)(node % width);
  place[1] = (int)(node / width % height);
  place[2] = (int)(node / width / height);
}

/* Input coordinates of a node. */
static inline void fg__window_position(const fg__window *window, size_t node,
                                       double position[3])
{
  int place[3];
  fg__window_place(window, node, place);
  for (int k = 0; k < 3; ++k)
    position[k] = window->origin[k] + place[k] * window->spacing[k];
}

/* The least spacing of its axes. */
double fg__window_spacing(const fg__window *window);

/* Whether the edge from a node to its next node along `axis` adjoins an active cell: only
 * then are its ends neighbours. The edge must exist. */
bool fg__window_edge_active(const fg__window *window, const int place[3], int axis);

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

/* Memory for the levels, zero, and active cells of a window whose nodes are set; the
 * window is empty after a failure. MEMORY. */
fg_status fg__window_allocate(fg__window *window, fg_context *context);

/* Of the pieces of {level > 0} only the largest stays. MEMORY. */
fg_status fg__window_keep_largest(fg__window *window, fg_context *context);

/* A part of a cluster that gets an icon of its own, of at most so many, in 2D and 3D: a
 * box has eight corners. */
enum { FG__WINDOW_PIECES = 8 };

typedef struct fg__window_piece {
  fg__window window;
  double share; /* of the cluster: those of all parts are 1 together */
} fg__window_piece;

/* Cuts a cluster's window where it crosses periodic boundaries, since a map ends there:
 * the largest part, and the larger ones of those that hold a quarter of the cluster, or
 * of the mean cluster, each where it lies in the domain; in the window's order, x
 * fastest. A cut edge is at_boundary. One that crosses none is the only part. Takes
 * `whole`, which is empty afterwards; *count parts are to be cleared, also after a
 * failure. MEMORY. */
fg_status fg__window_divide(fg__window_piece part[FG__WINDOW_PIECES], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__window *whole);

/* The first node of the cell of a point, and how far along each axis the point lies in
 * it, from 0 to 1; the nearest point of the window stands for one outside, and then it
 * returns false. */
bool fg__window_find(const fg__window *window, const double position[], int corner[3],
                     double share[3]);

/* Level at a point in input coordinates, linear along each axis; a negative number
 * outside the window or in a masked cell. */
double fg__window_level(const fg__window *window, const double position[]);

/* Value of another array of the window's nodes, linear along each axis; that of the
 * nearest point outside. */
double fg__window_value(const fg__window *window, const double *value,
                        const double position[]);

#endif
