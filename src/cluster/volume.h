/* A cluster's window in 3D, as raster.h has it in 2D. */
#ifndef FG__VOLUME_H
#define FG__VOLUME_H

#include "cluster/raster.h"

/* One cluster on a grid of its own: its bounding box and a rim of 2 nodes round it (cut
 * where the domain ends, unless periodic; without a rim along an axis that the cluster
 * goes round, where it is cut). */
typedef struct fg__volume {
  int cluster;                  /* its label */
  int nodes[3];                 /* at least 2 each */
  double origin[3], spacing[3]; /* node (0, 0, 0), input coordinates, unwrapped */
  float *level;                 /* [nodes]: > 0 inside this cluster alone */
  unsigned char *active;        /* [cells], nodes[k] - 1 along an axis; 0 = masked */
  bool at_border[6]; /* the window's low and high side of each axis is the domain's border
                        (not a periodic one), or the cut through a closed cluster */
} fg__volume;

/* Cuts the window of a cluster out of a patch. MEMORY, ARGUMENT (no such cluster). */
fg_status fg__volume_cut(fg__volume *out, fg_context *context,
                         const fg_density_arrays *density, const fg__labels *labels,
                         const fg__patch *patch, int cluster);
void fg__volume_clear(fg__volume *volume);

/* As fg__window_allocate. MEMORY. */
fg_status fg__volume_allocate(fg__volume *volume, fg_context *context);

/* Of the pieces of {level > 0} only the largest stays. MEMORY. */
fg_status fg__volume_keep_largest(fg__volume *volume, fg_context *context);

/* As fg__window_part. */
typedef struct fg__volume_part {
  fg__volume volume;
  double share;
} fg__volume_part;

/* As fg__window_divide. MEMORY. */
fg_status fg__volume_divide(fg__volume_part part[FG__WINDOW_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__volume *whole);

/* Trilinear level at a point in input coordinates; a negative number outside the window
 * or in a masked cell. */
double fg__volume_level(const fg__volume *volume, const double position[3]);

/* Trilinear value of another array of the window's nodes; that of the nearest point
 * outside. */
double fg__volume_value(const fg__volume *volume, const double *value,
                        const double position[3]);

static inline size_t fg__volume_count(const fg__volume *volume)
{
  return (size_t)volume->nodes[0] * (size_t)volume->nodes[1] * (size_t)volume->nodes[2];
}

static inline size_t fg__volume_node(const fg__volume *volume, int x, int y, int z)
{
  return ((size_t)z * (size_t)volume->nodes[1] + (size_t)y) * (size_t)volume->nodes[0] +
         (size_t)x;
}

static inline size_t fg__volume_cell(const fg__volume *volume, int x, int y, int z)
{
  size_t cells_x = (size_t)volume->nodes[0] - 1, cells_y = (size_t)volume->nodes[1] - 1;
  return ((size_t)z * cells_y + (size_t)y) * cells_x + (size_t)x;
}

#endif
