/* One level of the multigrid hierarchy: the arrays of a tile and how they are laid out.
 *
 * Layout. A row of nodes is stored as its even columns, then its odd columns, each part
 * padded to whole vectors, so that each colour of the four-colour Gauss-Seidel sweep is a
 * contiguous run: column i is at row + i / 2 when even, at row + odd_offset + (i - 1) / 2
 * when odd. A ghost column lies at i = -1 and i = columns, a ghost row at j = -1 and
 * j = rows; array pointers point to node (0, 0).
 *
 * Scaling. Rows of the equations are divided by the lumped mass; `cell area` (hx hy) is
 * divided out of everything, so a node's relative mass is 1 inside, and with a mask the
 * active quarter cells round it, mirrored at borders. The stiffness coefficients are the
 * off-diagonal entries of the node's row, with mirrored cells beyond natural borders: a
 * mirrored row over a mirrored mass equals the true row over the true mass. */
#ifndef FG__LEVEL_H
#define FG__LEVEL_H

#include "base/context.h"

/* Lanes by which every loop over a row advances: the widest vector of floats. */
enum { FG__LANES = 16, FG__SCRATCH_ROWS = 12 };

/* The symmetric stencil of a 9-point operator: each node keeps its own diagonal and the
 * couplings to its east, north, north-east and north-west neighbours. */
typedef struct fg__stencil {
  float *center, *east, *north, *northeast, *northwest;
} fg__stencil;

typedef struct fg__level {
  int cells[2];
  int columns, rows; /* nodes along x and y, without ghosts */
  bool periodic[2];
  int even_count, odd_count; /* even and odd columns, rounded up to whole vectors */
  ptrdiff_t odd_offset;      /* from an even to the odd part of a row */
  ptrdiff_t stride;          /* from a row to the next */
  size_t array_size;         /* floats of one array, ghosts and pads included */
  ptrdiff_t first;           /* from an array's start to node (0, 0) */
  ptrdiff_t ghost_column[2], ghost_column_source[2]; /* offsets in a row */
  int ghost_row_source[2]; /* rows that rows -1 and rows are copies of */
  double spacing[2];

  float *u, *w;       /* density and chemical potential; corrections on coarse levels */
  float *p, *q;       /* right-hand sides of the first and second equation */
  float *curvature;   /* coarse levels: restricted Psi''(u), of either sign */
  fg__stencil energy; /* gamma L_A / (hx hy) */
  /* The Laplacian's couplings; constants where there is no mask (laplacian.center NULL).
   */
  float laplacian_center, laplacian_east, laplacian_north, laplacian_diagonal;
  fg__stencil laplacian;
  /* Weights of columns in sums over nodes, one row each: 1/2 at natural borders; 0 for
   * couplings to the east (north-west) that leave the domain. */
  float *column_mass, *column_east, *column_west;
  float *scratch; /* FG__SCRATCH_ROWS rows for the kernels' own use */
  float *mass,
      *mass_inverse; /* relative; NULL without a mask; inverse 0 where mass is 0 */

  /* The tensor times the cell's active share, kept to average it for the next level. */
  float *cell_xx, *cell_xy, *cell_yy, *cell_weight;
  void *memory[8];
  int memory_count;
} fg__level;

/* Column of a node within its row. */
static inline ptrdiff_t fg__column(const fg__level *level, int i)
{
  return i % 2 == 0 ? i / 2 : level->odd_offset + (i - 1) / 2;
}

static inline float *fg__row(const fg__level *level, float *array, int j)
{
  return array + (ptrdiff_t)j * level->stride;
}

static inline float *fg__node(const fg__level *level, float *array, int i, int j)
{
  return fg__row(level, array, j) + fg__column(level, i);
}

/* Lays out a level over cells[0] x cells[1] cells whose tensor (times its weight, the
 * active share) is given per cell, x fastest; copies it, and computes the stencils with
 * gamma. `finest` levels have no curvature array. MEMORY. */
fg_status fg__level_create(fg__level *out, fg_context *context, const int cells[2],
                           const bool periodic[2], const double spacing[2], double gamma,
                           const float *xx, const float *xy, const float *yy,
                           const float *weight, bool finest);

/* The next coarser level: half the cells, tensor and weight averaged over four. */
fg_status fg__level_create_coarser(fg__level *out, fg_context *context,
                                   const fg__level *fine, double gamma);

/* True when both sides can be halved and something is left. */
bool fg__level_can_coarsen(const fg__level *level);
void fg__level_clear(fg__level *level);

/* Fills the ghosts of a row, or of a whole array. This is the place of the exchange
 * between tiles and ranks, and of hanging nodes. */
static inline void fg__fill_ghost_columns(const fg__level *level, float *row)
{
  row[level->ghost_column[0]] = row[level->ghost_column_source[0]];
  row[level->ghost_column[1]] = row[level->ghost_column_source[1]];
}
void fg__fill_ghost_row(const fg__level *level, float *array, int side);
void fg__fill_ghosts(const fg__level *level, float *array);

/* Copies nodal values from or to plain arrays, x fastest, columns x rows. */
void fg__level_import(const fg__level *level, float *array, const float *plain);
void fg__level_export(const fg__level *level, const float *array, float *plain);

#endif
