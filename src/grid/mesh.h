/* The mesh: a uniform grid of Q1 cells, which ranks share in blocks along the outer axes:
 * slabs of whole rows or planes, or pencils in 3D (blocks.h).
 *
 * A block owns the nodes of its cells' lower corners, and those that close the grid at
 * upper ends of natural axes. Everything that computes works on a block as a plain array
 * (layout.h) with a ring of ghosts: mirror images, the other end of a periodic axis,
 * nodes of neighbours (exchange/exchange.h). A process alone has one block, whose
 * neighbours are itself or the boundary. */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "grid/partition.h"

typedef struct fg__mesh {
  int dimension;     /* 2 or 3 */
  int cells[3];      /* along x, y and z; 1 along z in 2D */
  bool periodic[3];  /* false along z in 2D */
  double spacing[3]; /* in units of the domain's longest side; 1 along z in 2D */
  double length;     /* the longest side in the input's coordinates */
  double origin[3];  /* lower corner, input coordinates; 0 along z in 2D */
  int coarsest;      /* see the description */
  const fg__ranks *ranks;
  fg__partition partition; /* of the nodes */
} fg__mesh;

typedef struct fg__mesh_description {
  int dimension;    /* 2 or 3 */
  double origin[3]; /* lower corner of the box, input coordinates */
  double side[3];   /* lengths of its sides */
  bool periodic[3];
  int nodes;    /* wanted along the longest side */
  int coarsest; /* 0, or cells along it of the coarsest mesh to be made of this */
  const fg__ranks *ranks; /* who shares it; NULL: all */
  bool may_idle;          /* ranks that do not fit get no block, and are not refused */
} fg__mesh_description;

/* Builds a mesh. The cells along the longest side are nodes - 1 rounded up to a multiple
 * of 16, every other side gets the multiple of 8 (16 when periodic) that makes cells most
 * nearly cubes; so all can be coarsened at least three times. These multiples are doubled
 * for each time that the cells can be halved to no fewer than `coarsest`. A domain so
 * thin that this makes cells more than twice as wide as long gets more cells along it.
 * Collective. ARGUMENT (fewer than 9 or too many nodes, an empty box, more ranks than
 * fit), MEMORY, MPI. */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);
void fg__mesh_clear(fg__mesh *mesh);

/* Whether there is a mesh of the same domain with exactly half the cells along each axis:
 * fg__mesh_create makes it for half as many, and one, nodes along the longest side. */
bool fg__mesh_can_coarsen(const fg__mesh *mesh);

/* Cells along the longest side. */
int fg__mesh_most_cells(const fg__mesh *mesh);

#endif
