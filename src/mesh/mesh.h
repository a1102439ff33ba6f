/* The mesh: a forest whose leaves are patches of patch_cells equal Q1 cells along each
 * axis, shared out over the ranks along a Morton curve.
 *
 * Levels. Level n is the grid of cells 2^n times as wide as the finest. A leaf of side
 * 2^n (in units of the smallest leaves) has cells of level n. Level n covers every leaf
 * of that side and, coarsely, whatever is refined further: all that is not covered by
 * leaves larger than 2^n. So the levels nest, and level level_count - 1 covers the
 * domain. Leaves that touch differ by one level at most: each level covers the next finer
 * one and a ring of a patch round it.
 *
 * Boxes. A patch owns the nodes of its cells' lower corners, and those that close the
 * level at upper ends: of natural axes, and where a level ends inside the domain
 * (closure.h); it belongs to the rank of the first leaf in it. The nodes that a rank owns
 * on a level are merged into few boxes (partition.h); everything that computes works on
 * boxes as plain arrays (layout.h) with a ring of ghosts: mirror images, the other end of
 * a periodic axis, nodes of other boxes and ranks (exchange.h). A uniform mesh on one
 * rank is one box: a plain array at full speed (docs/design/mesh.md has the measurement).
 */
#ifndef FG__MESH_H
#define FG__MESH_H

#include "mesh/forest.h"
#include "mesh/partition.h"

/* Cells [first, first + cells) along each axis, at the forest's finest level. */
typedef struct fg__tile {
  int first[3];
  int cells[3];
} fg__tile;

enum { FG__MOST_REFINEMENTS = 12 };

typedef struct fg__mesh {
  int dimension;     /* 2 or 3 */
  int cells[3];      /* of the whole finest level, along x, y and z; 1 along z in 2D */
  bool periodic[3];  /* false along z in 2D */
  double spacing[3]; /* in units of the domain's longest side; 1 along z in 2D */
  double length;     /* the longest side in the input's coordinates */
  double origin[3];  /* lower corner, input coordinates; 0 along z in 2D */
  int patch_cells;   /* along each side of a leaf */
  const fg__ranks *ranks;
  int level_count; /* the largest leaves there may be are of the last level */
  fg__partition level[FG__MOST_REFINEMENTS + 1]; /* of the nodes of a level's cells */
  fg__partition
      cover[FG__MOST_REFINEMENTS + 1]; /* of its cells, by their lower corners:
                                          a cell is covered when that is owned */
  int leaf_count;
  fg__leaf *leaf; /* [leaf_count] of this rank, in Morton order */
  int tile_count;
  fg__tile *tile; /* cells of each of this rank's boxes of level 0, in their order */
  const fg__forest_kind *kind;
  fg__forest *forest;
} fg__mesh;

typedef struct fg__mesh_description {
  int dimension;    /* 2 or 3 */
  double origin[3]; /* lower corner of the box, input coordinates */
  double side[3];   /* lengths of its sides */
  bool periodic[3];
  int nodes;              /* wanted along the longest side */
  int patch_cells;        /* of leaves that can be coarsened: a power of two, at least 4;
                             0: the mesh stays uniform */
  int refinements;        /* how many times */
  const fg__ranks *ranks; /* who shares it; NULL: all */
} fg__mesh_description;

/* Builds a uniform mesh. The cells along the longest side are nodes - 1 rounded up to a
 * multiple of 16, every other side gets the multiple of 8 (16 when periodic) that makes
 * cells most nearly cubes; so all can be halved at least three times; a domain so thin
 * that this makes cells more than twice as wide as long gets more cells along it. Where
 * it can be coarsened, sides are multiples of patch_cells 2^refinements instead.
 * Otherwise leaves are as large as they can be without one rank getting 5 % more than the
 * mean, but have 16 cells a side at least (8 in 3D) where more ranks ask for smaller
 * ones: so many ranks are uneven. Collective. ARGUMENT (fewer than 9 or too many nodes,
 * an empty box), MEMORY, MPI.
 */
fg_status fg__mesh_create(fg__mesh *out, fg_context *context,
                          const fg__mesh_description *description);

/* Another mesh of the same domain: refined where wanted[l], a level, is finer than this
 * rank's leaf l, coarsened by one level where all sisters want that (forest.h), shared
 * out anew. The mesh given stays, for its values to be moved (exchange.h, between).
 * Collective. MEMORY. */
fg_status fg__mesh_adapt(fg__mesh *out, fg_context *context, const fg__mesh *mesh,
                         const signed char *wanted);
void fg__mesh_clear(fg__mesh *mesh);

/* Where the nodes of a leaf of this rank are. */
typedef struct fg__leaf_place {
  int level;
  int box;      /* among the rank's own boxes of that level */
  int first[3]; /* local indices of its lower corner */
} fg__leaf_place;

/* Its nodes are first ... first + patch_cells along each axis; the last of these may be
 * another box's, and so ghosts. */
fg__leaf_place fg__mesh_place(const fg__mesh *mesh, const fg__leaf *leaf);

#endif
