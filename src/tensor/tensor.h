/* Interfacial energies: what an interface costs, by place and direction. */
#ifndef FG__TENSOR_H
#define FG__TENSOR_H

#include "base/context.h"
#include "base/team.h"

/* The cells to give a tensor to: a box of cells of a uniform grid that fills the domain,
 * in the input's coordinates. What a cell gets does not depend, to the bit, on the box it
 * is asked for in. */
typedef struct fg__cells {
  int dimension;       /* 2 or 3 */
  int count[3];        /* cells of the box; count[2] is not read in 2D */
  double origin[3];    /* lower corner of the domain's cell (0, 0, 0) */
  double spacing[3];   /* of the cells */
  int domain_count[3]; /* cells of the whole domain; 0: count */
  int first[3];        /* the domain's index of the box's lower corner */
} fg__cells;

/* The symmetric positive definite tensor A of each cell at its centre, x fastest, then y,
 * then z; the last three NULL in 2D. active: 1, or 0 where the field is missing; the
 * tensor there is 0. */
typedef struct fg__tensor {
  float *xx, *xy, *yy, *zz, *xz, *yz;
  unsigned char *active;
} fg__tensor;

/* Fills the arrays, which the caller has allocated with one element a cell of the box,
 * for the energy asked for; the same with any team (NULL: one thread). ARGUMENT
 * (anisotropy outside (0, 1]; no active cell in a box that is the whole domain). */
fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          fg_energy energy, double anisotropy, const fg__cells *cells,
                          fg__team *team);

/* Averages the directions that a flow tensor prefers over a Gaussian of standard
 * deviation `width` (same unit as spacing) within the active cells, in place, so that an
 * interface of that width meets a tensor that hardly varies across it; rough measured
 * fields ask for that. Where directions agree at least by half the full anisotropy comes
 * back, where they cancel the tensor tends to I (docs/design/tensor.md). A box is
 * averaged over what it holds; it goes round a periodic axis when it is all of it.
 * MEMORY.
 */
fg_status fg__tensor_smooth(fg__tensor *tensor, fg_context *context, double anisotropy,
                            const fg__cells *cells, const bool periodic[3], double width,
                            fg__team *team);

/* Both for any box of the domain, which may go on beyond the ends of a periodic axis:
 * fills and, for the flow energy and a width above 0, smooths; what lies round the box
 * within the Gaussian's reach is computed again for that, so that each rank asks for its
 * own boxes alone and gets what the whole domain would have there. A box without an
 * active cell is no failure. ARGUMENT (anisotropy), MEMORY. */
fg_status fg__tensor_fill_box(fg__tensor *tensor, fg_context *context,
                              const fg_field *field, fg_energy energy, double anisotropy,
                              const fg__cells *cells, const bool periodic[3],
                              double width);

/* Cells along z, cells of the box, cells of the domain along axis k. */
int fg__layers(const fg__cells *cells);
size_t fg__cell_count(const fg__cells *cells);
int fg__domain_count(const fg__cells *cells, int k);

/* How many cells far along axis k smoothing reaches. */
int fg__smoothing_radius(const fg__cells *cells, int k, double width);

/* One energy: writes xx, xy, yy, zz, xz, yz for a place whose streamline has direction
 * `tangent`; with tangent[2] = 0 the first three are those of a field in 2D. */
typedef void fg__energy_law(double tensor[6], const double tangent[3], double anisotropy);

fg__energy_law fg__energy_flow;      /* A = e e^T + a (I - e e^T), e = v/|v| */
fg__energy_law fg__energy_isotropic; /* A = I */

#endif
