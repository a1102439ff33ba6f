/* The mesh: a forest whose leaves are patches of patch_cells equal Q1 cells along each
 * axis, and the tiles into which the leaves of this rank are merged.
 *
 * A tile is a brick of leaves of one size. Everything that computes works on tiles as
 * plain arrays with a ring of ghost nodes, filled by mirroring at natural borders and by
 * copying at periodic ones; this ring is also where neighbouring tiles, other ranks and
 * hanging nodes put their values. A uniform mesh on one rank is one tile: a plain array
 * at full speed (docs/design/mesh.md has the measurement). */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "mesh/forest.h"

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
  int tile_count;
  fg__tile *tile; /* [tile_count] of this rank */
  const fg__ranks *ranks;
  const fg__forest_kind *kind;
  fg__forest *forest;
} fg__mesh;

typedef struct fg__mesh_description {
  int dimension;    /* 2 or 3 */
  double origin[3]; /* lower corner of the box, input coordinates */
  double side[3];   /* lengths of its sides */
  bool periodic[3];
  int nodes; /* wanted along the longest side */
} fg__mesh_description;

/* Builds a uniform mesh. The cells along the longest side are nodes - 1 rounded up to a
 * multiple of 16, every other side gets the multiple of 8 (16 when periodic) that makes
 * cells most nearly cubes; so all can be halved at least three times; a domain so thin
 * that this makes cells more than twice as wide as long gets more cells along it.
 * Collective over all ranks. ARGUMENT (fewer than 9 or too many nodes, an empty box),
 * MEMORY, MPI.
 */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);
void fg__mesh_clear(fg__mesh *mesh);

#endif
