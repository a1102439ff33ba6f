/* Cells of a coarse level with a mask: Galerkin element matrices. The mean tensor of fine
 * cells, which does without a mask, is wrong for a coarse cell of which only a corner is
 * active: a correction that begins at this corner has up to three times the energy there
 * that the mean says, and cycles diverge. */
#ifndef FG__ELEMENTS_H
#define FG__ELEMENTS_H

#include "grid/layout.h"
#include "solver/cells/cells.h"

enum { FG__MOST_CORNERS = 8, FG__MOST_ELEMENT_VALUES = 64 };

/* Laid out as solver/cells/images.h says. Corner a of a cell is its node at offset a & 1,
 * a >> 1 & 1, a >> 2. Of the values of a cell, a matrix of C x C for C corners, the
 * diagonal are the corners' masses, what is above it (row before column) the Laplacian's
 * couplings, what is below those of the energy; all over the cell's volume. */
typedef struct fg__elements {
  int dimension;
  int nodes[3];
  ptrdiff_t row, plane;
  float *value[FG__MOST_ELEMENT_VALUES]; /* cell (0, 0, 0); value[0] NULL: none */
  void *memory;
} fg__elements;

static inline int fg__element_values(int dimension)
{
  return 1 << 2 * dimension;
}

static inline int fg__element_mass(int dimension, int corner)
{
  return (corner << dimension) + corner;
}

static inline int fg__element_coupling(int dimension, bool laplacian, int a, int b)
{
  int low = a < b ? a : b, high = a < b ? b : a;
  return laplacian ? (low << dimension) + high : (high << dimension) + low;
}

static inline ptrdiff_t fg__element_at(const fg__elements *elements, int i, int j, int k)
{
  return (ptrdiff_t)i + (ptrdiff_t)j * elements->row + (ptrdiff_t)k * elements->plane;
}

/* The exact Q1 stiffness of a cell of the given sides with constant tensor, over its
 * volume: corners a and b couple by the sum of weight[c] A_c over the tensor's
 * components. */
void fg__cell_coupling(int a, int b, int dimension, const double spacing[3],
                       double weight[FG__TENSOR_COMPONENTS]);

/* The fine cells of a level, and how its nodes follow coarse ones (interpolation.h). */
typedef struct fg__fine_cells {
  const fg__cells_of_box *tensor; /* of the finest level; or */
  const fg__elements *elements;   /* of a coarser one */
  const double *spacing;
  double gamma; /* of the tensor */
  const fg__layout *layout;
  float *const *interpolation; /* with ghosts */
} fg__fine_cells;

/* Cells of a box of a coarser level, count along each axis from the box's first: P' A P.
 * The ring below comes from the neighbours. MEMORY. */
fg_status fg__elements_coarsen(fg__elements *out, fg_context *context,
                               const fg__fine_cells *fine, const int nodes[3],
                               const int count[3], fg__threads *threads);

/* Images beyond the sides of a box, as fg__cell_images_fill. */
void fg__elements_fill_images(const fg__elements *elements, const fg__box *box,
                              const int level_cells[3], const bool periodic[3]);

/* The cells of a whole level, images included, from arrays of all its cells, x fastest.
 * MEMORY. */
fg_status fg__elements_from_arrays(fg__elements *out, fg_context *context,
                                   const float *const values[], int dimension,
                                   const int cells[3], const bool periodic[3]);

void fg__elements_clear(fg__elements *elements);

#endif
