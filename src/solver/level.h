/* One level of the multigrid hierarchy: nodal arrays and coefficients of a box of nodes
 * (grid/layout.h). The box is the whole level, or this rank's block of it
 * (distributed.h).
 *
 * Scaling. Rows of the equations are divided by the lumped mass; the cell's volume is
 * divided out of everything, so a node's relative mass is 1 inside, and with a mask the
 * active share of the cells round it, mirrored at boundaries. The stiffness coefficients
 * are the off-diagonal entries of the node's row, with mirrored cells beyond natural
 * boundaries: a mirrored row over a mirrored mass equals the true row over the true mass.
 */
#ifndef FG__LEVEL_H
#define FG__LEVEL_H

#include "base/context.h"
#include "base/threads.h"
#include "grid/box.h"
#include "grid/layout.h"
#include "solver/cells/elements.h"

/* Rows of neighbours "above" a row, each with couplings to the west, middle and east: one
 * in 2D (y + 1), four in 3D (y + 1; y - 1, y, y + 1 at z + 1). */
enum { FG__MOST_UPPER_ROWS = 4, FG__MOST_COUPLINGS = 1 + 3 * FG__MOST_UPPER_ROWS };

/* The symmetric stencil of a 9- or 27-point operator: each node keeps its own diagonal
 * and the couplings to half of its neighbours: to[0] east; to[1 + 3 r + c] those in upper
 * row r at column c - 1. */
typedef struct fg__stencil {
  float *center, *to[FG__MOST_COUPLINGS];
} fg__stencil;

static inline int fg__upper_rows(int dimension)
{
  return dimension == 3 ? FG__MOST_UPPER_ROWS : 1;
}

/* Half of a node's couplings, those that it keeps itself. */
static inline int fg__coupling_count(int dimension)
{
  return 1 + 3 * fg__upper_rows(dimension);
}

/* Offsets along y and z of upper row r. */
static inline void fg__upper_row(int r, int *dy, int *dz)
{
  *dy = r == 0 ? 1 : r - 2;
  *dz = r == 0 ? 0 : 1;
}

typedef struct fg__level {
  fg__layout layout;
  int cells[3];
  bool periodic[3];
  double spacing[3];
  double cell_volume;        /* area in 2D */
  double nodes;              /* of the level */
  int even_count, odd_count; /* even and odd columns, rounded up to whole vectors */
  ptrdiff_t ghost_column[2], ghost_column_source[2]; /* offsets in a row */
  int ghost_row_source[2];   /* rows that rows -1 and nodes[1] are copies of */
  int ghost_plane_source[2]; /* the same for planes */
  bool boxed; /* one block of several: ghosts that are not images come from an exchange */
  bool boundary[3][2]; /* a natural boundary at the low, the high end of an axis */
  /* Terms are rounded to multiples of a fixed small number before they are added, so that
   * a sum does not depend on its order: (x + rounding) - rounding. The first for terms
   * whose mean is at most 8, the other for squares of changes, at most 1/8. */
  double rounding, change_rounding;

  float *u, *w; /* density and chemical potential; corrections on coarse levels */
  float *p, *q; /* right-hand sides of the first and second equation */
  /* The space of a coarse level's corrections, and Psi'' in it
   * (solver/kernel/coarse_space.h). Between restriction and find_scale the coupling holds
   * the restricted d. */
  float *coupling, *shape_curvature, *scale, *scale_inverse, *curvature, *relaxation;
  float bulk;             /* d in the pure phases */
  fg__stencil energy;     /* gamma L_A / volume */
  double gradient_weight; /* of that energy in sums: 1 when the stencil holds all of it */
  /* The Laplacian: constants where there is no mask (laplacian.center NULL): of the node
   * itself, its eastern neighbour, the middle and the sides of the upper rows. */
  float laplacian_center, laplacian_east;
  float laplacian_middle[FG__MOST_UPPER_ROWS], laplacian_side[FG__MOST_UPPER_ROWS];
  fg__stencil laplacian;
  /* Weights of columns in sums over nodes, one row each: 1/2 at natural boundaries; 0 for
   * couplings to the east (west) that leave the domain. */
  float *column_mass, *column_east, *column_west;
  float *scratch;      /* for the kernels' own use, one piece a thread */
  size_t scratch_size; /* floats of one piece */
  float *shapes; /* finest levels: three slices a thread (solver/kernel/restrict.h) */
  /* Of ranks that have a slab each: this one's last slice gathered
   * (solver/kernel/restrict.h), for the rank above, and that of the rank below; NULL
   * where there is none. */
  float *sent, *received;
  float *mass,
      *mass_inverse; /* relative; NULL without a mask; inverse 0 where mass is 0 */

  /* With a mask: how far a node follows the coarse node at the low or (bits of the
   * index) high side along the axes where it is odd (interpolation.h). */
  float *interpolation[FG__MOST_CORNERS];

  fg__cells_of_box tensor; /* tensor and weight per cell; cleared once it is used up */
  fg__elements elements;   /* instead of it on coarse levels with a mask */
  void *memory[8];
  int memory_count;
} fg__level;

typedef struct fg__level_description {
  int dimension;
  int cells[3];
  bool periodic[3];
  double spacing[3];
  double gamma;
  bool finest;          /* has no second right-hand side and no space of corrections */
  bool masked;          /* somewhere on the level, if not here */
  fg__threads *threads; /* that builds it and will work on it; NULL: one thread */
  const fg__box *box;   /* the block, when there are several; NULL: all nodes */
} fg__level_description;

/* Both roundings for a level of so many nodes. */
double fg__level_rounding(double nodes);
double fg__level_change_rounding(double nodes);

/* A sum of such terms as an integer multiple of its smallest unit, in which sums of
 * several ranks are added (fg__ranks_add); NaN becomes more than any sum can be. */
uint64_t fg__level_units(double sum, double rounding, int ranks);
double fg__level_sum(uint64_t units, double rounding);

/* Slices are what threads share: rows in 2D, planes in 3D. */
static inline int fg__slices(const fg__level *level)
{
  return level->layout.nodes[level->layout.dimension - 1];
}

/* Floats of a slice with its ghosts. */
static inline ptrdiff_t fg__slice_floats(const fg__level *level)
{
  return level->layout.dimension == 3 ? level->layout.plane : level->layout.stride;
}

/* Floats of one quantity of a fine slice gathered to coarse rows and columns. */
static inline ptrdiff_t fg__gathered_floats(const fg__level *level)
{
  if (level->layout.dimension == 2 || level->mass)
    return fg__slice_floats(level);
  return level->layout.odd_offset * ((level->layout.nodes[1] + 1) / 2);
}

/* Occasions of fg__threads_exchange: which slices the neighbouring ranks need by then. */
enum {
  FG__FIRST_SLICE = 1,   /* of u and w, for the rank below */
  FG__LAST_SLICE = 2,    /* of u and w, for the rank above */
  FG__GATHERED_SLICE = 4 /* level->sent */
};

static inline float *fg__row(const fg__level *level, float *array, int j, int k)
{
  return array + fg__row_at(&level->layout, j, k);
}

static inline float *fg__node(const fg__level *level, float *array, int i, int j, int k)
{
  return array + fg__node_at(&level->layout, i, j, k);
}

/* Lays out a level and computes its stencils from the cells' tensor times weight or from
 * their element matrices (the other NULL), which it takes over. The masses and the
 * interpolation of a block of several lack ghosts (distributed.h). MEMORY. */
fg_status fg__level_create(fg__level *out, fg_context *context,
                           const fg__level_description *description,
                           fg__cells_of_box *tensor, fg__elements *elements);

/* The cells of the next coarser level, of a box of so many nodes, without images; of a
 * level with a mask, whose interpolation has its ghosts. gamma: of the finest level.
 * MEMORY. */
fg_status fg__level_coarsen_cells(fg__elements *out, fg_context *context,
                                  const fg__level *fine, double gamma, const int nodes[3],
                                  const int count[3], fg__threads *threads);

/* The next coarser level: half the cells, tensor averaged, or with a mask P' A P. */
fg_status fg__level_create_coarser(fg__level *out, fg_context *context,
                                   const fg__level *fine, double gamma,
                                   fg__threads *threads);

/* True when all sides can be coarsened and something is left. */
bool fg__level_can_coarsen(const fg__level *level);
void fg__level_clear(fg__level *level);

/* Fills the ghosts of a row, or of a whole array. */
static inline void fg__fill_ghost_columns(const fg__level *level, float *row)
{
  row[level->ghost_column[0]] = row[level->ghost_column_source[0]];
  row[level->ghost_column[1]] = row[level->ghost_column_source[1]];
}
/* Of the whole level, or of a box whose ghosts there are images of its own nodes. */
void fg__fill_ghost_row(const fg__level *level, float *array, int k, int side);
void fg__fill_ghost_plane(const fg__level *level, float *array, int side);
void fg__fill_ghosts(const fg__level *level, float *array);

/* Copies nodal values from or to plain arrays, x fastest; ghosts are left alone. */
void fg__level_import(const fg__level *level, float *array, const float *plain);
void fg__level_export(const fg__level *level, const float *array, float *plain);

#endif
