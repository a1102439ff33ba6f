/* The mesh: a uniform grid of Q1 cells. Few ranks share it in slabs of whole slices along
 * the last axis, many in patches of patch_cells along each axis, the leaves of a forest,
 * along a Morton curve.
 *
 * A patch owns the nodes of its cells' lower corners, and those that close the grid at
 * upper ends of natural axes. The nodes that a rank owns are merged into few boxes
 * (partition.h); everything that computes works on boxes as plain arrays (layout.h) with
 * a ring of ghosts: mirror images, the other end of a periodic axis, nodes of other boxes
 * and ranks (exchange.h). On one rank it is one box: a plain array at full speed
 * (docs/design/mesh.md has the measurement). */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "mesh/partition.h"

/* Cells [first, first + cells) along each axis. */
typedef struct fg__tile {
  int first[3];
  int cells[3];
} fg__tile;

typedef struct fg__mesh {
  int dimension;     /* 2 or 3 */
  int cells[3];      /* along x, y and z; 1 along z in 2D */
  bool periodic[3];  /* false along z in 2D */
  double spacing[3]; /* in units of the domain's longest side; 1 along z in 2D */
  double length;     /* the longest side in the input's coordinates */
  double origin[3];  /* lower corner, input coordinates; 0 along z in 2D */
  int patch_cells;   /* boxes begin at multiples of it: a leaf's side, a slab's unit */
  const fg__ranks *ranks;
  fg__partition partition; /* of the nodes */
  int tile_count;
  fg__tile *tile; /* cells of each of this rank's boxes, in their order */
} fg__mesh;

typedef struct fg__mesh_description {
  int dimension;    /* 2 or 3 */
  double origin[3]; /* lower corner of the box, input coordinates */
  double side[3];   /* lengths of its sides */
  bool periodic[3];
  int nodes;              /* wanted along the longest side */
  const fg__ranks *ranks; /* who shares it; NULL: all */
} fg__mesh_description;

/* Builds a mesh. The cells along the longest side are nodes - 1 rounded up to a multiple
 * of 16, every other side gets the multiple of 8 (16 when periodic) that makes cells most
 * nearly cubes; so all can be halved at least three times; a domain so thin that this
 * makes cells more than twice as wide as long gets more cells along it. Each rank gets a
 * slab unless boxes are less work (fg__mesh_slab_unit), or the environment variable
 * FLOWGRAIN_SHARES is "leaves" on a rank (tests do that). Leaves are as large as they can
 * be without one rank getting 5 % more than the mean, but have 16 cells a side at least
 * (8 in 3D) where more ranks ask for smaller ones: so many ranks are uneven. Collective.
 * ARGUMENT (fewer than 9 or too many nodes, an empty box), MEMORY, MPI.
 */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);
void fg__mesh_clear(fg__mesh *mesh);

/* Whether there is a mesh of the same domain with exactly half the cells along each axis:
 * fg__mesh_create makes it for half as many, and one, nodes along the longest side. */
bool fg__mesh_can_be_halved(const fg__mesh *mesh);

/* Cells along the longest side. */
int fg__mesh_most_cells(const fg__mesh *mesh);

#endif
