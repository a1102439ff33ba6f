/* The tensor of the cells round a box of nodes, those beyond its sides included. */
#ifndef FG__CELLS_H
#define FG__CELLS_H

#include "base/context.h"
#include "base/threads.h"
#include "grid/box.h"
#include "tensor/tensor.h"

enum { FG__TENSOR_COMPONENTS = 6 }; /* xx, xy, yy, zz, xz, yz; three in 2D */

/* Laid out as solver/cells/images.h says. */
typedef struct fg__cells_of_box {
  int dimension;
  int nodes[3];
  ptrdiff_t row, plane;                    /* from a cell to the next along y and z */
  float *component[FG__TENSOR_COMPONENTS]; /* times weight; points to cell (0, 0, 0) */
  float *weight;                           /* the cell's active share */
  void *memory;
} fg__cells_of_box;

static inline ptrdiff_t fg__cell_at(const fg__cells_of_box *cells, int i, int j, int k)
{
  return (ptrdiff_t)i + (ptrdiff_t)j * cells->row + (ptrdiff_t)k * cells->plane;
}

/* Functions that take threads (NULL: one) give the same result with any number. */

/* The cells of the whole domain, with their images beyond its sides: mirrored at natural
 * boundaries, where off-diagonal components change sign for each axis mirrored, or
 * wrapped round. `cells` counts along each axis. MEMORY. */
fg_status fg__cells_from_tensor(fg__cells_of_box *out, fg_context *context,
                                const fg__tensor *tensor, int dimension,
                                const int cells[3], const bool periodic[3],
                                fg__threads *threads);

/* What is needed to compute the tensor of any cells. */
typedef struct fg__tensor_recipe {
  const fg_field *field;
  const fg_energy_law *law;
  double anisotropy, width; /* see fg__tensor_fill_box */
  int dimension;
  int cells[3]; /* of the domain */
  bool periodic[3];
  double origin[3], spacing[3]; /* input coordinates */
} fg__tensor_recipe;

/* The cells at whose centres the recipe evaluates the field for a box of nodes. */
fg__cells fg__cells_needed(const fg__tensor_recipe *recipe, const fg__box *box);

/* The cells round a box of nodes of the finest level. wide: the recipe's law at
 * fg__cells_needed (solver/cells/field_boxes.h), which is used unless it is empty, and
 * cleared. MEMORY, and the statuses of the law. */
fg_status fg__cells_for_box(fg__cells_of_box *out, fg_context *context,
                            const fg__tensor_recipe *recipe, const fg__box *box,
                            fg__wide_tensor *wide, fg__threads *threads);

/* The cells round a box of a coarser level of so many cells, as means over 2 x 2 (x 2) of
 * those of the box on the next finer level, which begins at even nodes: only those whose
 * lowest corner the box owns. The ring below comes from the neighbours; what lies beyond
 * the level's boundary from fill_images then. MEMORY. */
fg_status fg__cells_coarsen(fg__cells_of_box *out, fg_context *context,
                            const fg__cells_of_box *fine, const fg__box *box,
                            const int level_cells[3], fg__threads *threads);

/* Images beyond the sides of a box, as fg__cell_images_fill. */
void fg__cells_fill_images(const fg__cells_of_box *cells, const fg__box *box,
                           const int level_cells[3], const bool periodic[3]);

/* An array of all cells of a level, x fastest, as fg__cells_of_box with images: values[n]
 * are the components, the last the weight. MEMORY. */
fg_status fg__cells_from_arrays(fg__cells_of_box *out, fg_context *context,
                                const float *const values[], int dimension,
                                const int cells[3], const bool periodic[3]);

/* Which cells are active at all: a byte each, laid out like the cells, `origin` bytes
 * from the start to cell (0, 0, 0). To be freed; NULL when there is no memory. */
unsigned char *fg__cells_mask(const fg__cells_of_box *cells, ptrdiff_t *origin);

void fg__cells_clear(fg__cells_of_box *cells);

#endif
