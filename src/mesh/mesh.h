/* The mesh: a p4est forest whose leaves are patches of patch_cells x patch_cells equal Q1
 * cells, and the tiles into which the leaves of this rank are merged.
 *
 * A tile is a rectangle of leaves of one size. Everything that computes works on tiles as
 * plain arrays with a ring of ghost nodes, filled by mirroring at natural borders and by
 * copying at periodic ones; this ring is also where neighbouring tiles, other ranks and
 * hanging nodes put their values. A uniform mesh on one rank is one tile: a plain array
 * at full speed (docs/design/mesh.md has the measurement). */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "base/context.h"

/* Cells [first, first + cells) along each axis, at the forest's finest level. */
typedef struct fg__tile {
  int first[2];
  int cells[2];
} fg__tile;

typedef struct fg__mesh {
  int dimension;
  int cells[2]; /* of the whole domain, along x and y */
  bool periodic[2];
  double spacing[2]; /* in units of the domain's longest side */
  double length;     /* the longest side in the input's coordinates */
  double origin[2];  /* lower corner, input coordinates */
  int patch_cells;   /* along each side of a leaf */
  int tile_count;
  fg__tile *tile; /* [tile_count] of this rank */
  struct fg__forest *forest;
} fg__mesh;

typedef struct fg__mesh_description {
  double origin[2]; /* lower corner of the box, input coordinates */
  double side[2];   /* lengths of its sides */
  bool periodic[2];
  int nodes; /* wanted along the longest side */
} fg__mesh_description;

/* Builds a uniform mesh. The cells along the longest side are nodes - 1 rounded up to a
 * multiple of 16, the other side gets the multiple of 8 (16 when periodic) that makes
 * cells most nearly square; so both can be halved at least three times; a domain so thin
 * that this makes cells more than twice as wide as long gets more cells along it.
 * Collective over the communicator. ARGUMENT (fewer than 9 or too many nodes, an empty
 * box), MEMORY, MPI.
 */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);
void fg__mesh_clear(fg__mesh *mesh);

#endif
