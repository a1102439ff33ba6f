/* How far each cell of the domain lies from the nearest of the points so far, in 2D or
 * 3D. */
#ifndef FG__RIVAL_VOIDS_H
#define FG__RIVAL_VOIDS_H

#include "rival/domain.h"
#include "skeleton/heap.h"

typedef struct fg__voids {
  const fg__domain *domain;
  double *square;         /* a number a cell: squared distance of its centre */
  double (*nearest)[3];   /* the point that it is measured to */
  unsigned char *waiting; /* a byte a cell: it is in the queue */
  int *queue;             /* of cells, in a ring */
  int head, waits;
  fg__heap
      heap; /* of the cells not yet taken, those farthest when last looked at first */
  bool is_heaped;
} fg__voids;

/* Begins without a point: all distances are infinite. MEMORY. */
fg_status fg__voids_create(fg__voids *out, fg_context *context, const fg__domain *domain);
void fg__voids_clear(fg__voids *voids);

/* Adds a point in the box or, round a period, out of it. Its distances are known only
 * after fg__voids_update. */
void fg__voids_add(fg__voids *voids, const double point[]);

/* Brings distances up to date: each cell passes the point nearest to it on to the cells
 * round it, as long as that is nearer to those (P.-E. Danielsson, "Euclidean distance
 * mapping", Computer Graphics and Image Processing 14, 1980). Off by a small part of a
 * cell. */
void fg__voids_update(fg__voids *voids);

/* Adds all of the domain's boundary: the middle of each face between a cell with
 * a velocity and one without, or the end of the box. */
void fg__voids_add_boundary(fg__voids *voids);

/* Takes the cell farthest from all points among those whose flow has a direction; no cell
 * is taken twice; -1: there is none left. MEMORY. */
fg_status fg__voids_take_farthest(fg__voids *voids, fg_context *context, int *cell);

#endif
