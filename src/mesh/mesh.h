/* The mesh: a forest whose leaves are patches of patch_cells equal Q1 cells along each
 * axis, shared out over the ranks along a Morton curve.
 *
 * A leaf owns the nodes of its cells' lower corners, and at the upper end of a natural
 * axis those that close it. The nodes that a rank owns on a level are merged into few
 * boxes (partition.h); everything that computes works on boxes as plain arrays
 * (layout.h) with a ring of ghost nodes: mirror images, the other end of a periodic axis,
 * nodes of other boxes and ranks (exchange.h), hanging nodes. A uniform mesh on one rank
 * is one box: a plain array at full speed (docs/design/mesh.md has the measurement). */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "mesh/forest.h"
#include "mesh/partition.h"

/* Cells [first, first + cells) along each axis, at the forest's finest level. */
typedef struct fg__tile {
  int first[3];
  int cells[3];
} fg__tile;

typedef struct fg__mesh {
  int dimension;     /* 2 or 3 */
  int cells[3];      /* of the whole domain, along x, y and z; 1 along z in 2D */
  bool periodic[3];  /* false along z in 2D */
  double spacing[3]; /* in units of the domain's longest side; 1 along z in 2D */
  double length;     /* the longest side in the input's coordinates */
  double origin[3];  /* lower corner, input coordinates; 0 along z in 2D */
  int patch_cells;   /* along each side of a leaf */
  const fg__ranks *ranks;
  fg__partition partition; /* of the nodes */
  int tile_count;
  fg__tile *tile; /* [tile_count]: cells of each of this rank's boxes, in their order */
  const fg__forest_kind *kind;
  fg__forest *forest;
} fg__mesh;

typedef struct fg__mesh_description {
  int dimension;    /* 2 or 3 */
  double origin[3]; /* lower corner of the box, input coordinates */
  double side[3];   /* lengths of its sides */
  bool periodic[3];
  int nodes;              /* wanted along the longest side */
  const fg__ranks *ranks; /* who shares it; NULL: all */
} fg__mesh_description;

/* Builds a uniform mesh. The cells along the longest side are nodes - 1 rounded up to a
 * multiple of 16, every other side gets the multiple of 8 (16 when periodic) that makes
 * cells most nearly cubes; so all can be halved at least three times; a domain so thin
 * that this makes cells more than twice as wide as long gets more cells along it. Leaves
 * are as large as they can be without one rank getting 5 % more than the mean, but have
 * 16 cells a side at least (8 in 3D) where more ranks ask for smaller ones: so many ranks
 * are uneven. Collective. ARGUMENT (fewer than 9 or too many nodes, an empty box),
 * MEMORY, MPI.
 */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);
void fg__mesh_clear(fg__mesh *mesh);

#endif
