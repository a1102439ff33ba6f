/* Interfacial energies: what an interface costs, by place and direction. */
#ifndef FG__TENSOR_H
#define FG__TENSOR_H

#include "base/context.h"

/* The cells to give a tensor to: a uniform grid in the input's coordinates. */
typedef struct fg__cells {
  int count[2];
  double origin[2]; /* lower corner of cell (0, 0) */
  double spacing[2];
} fg__cells;

/* The symmetric positive definite tensor A of each cell at its centre, x fastest, and
 * active: 1, or 0 where the field is missing. */
typedef struct fg__tensor {
  float *xx, *xy, *yy;
  unsigned char *active;
} fg__tensor;

/* Fills the arrays, which the caller has allocated with count[0] * count[1] elements, for
 * the energy asked for. ARGUMENT (anisotropy outside (0, 1]; no active cell). */
fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          fg_energy energy, double anisotropy, const fg__cells *cells);

/* Averages the directions that a flow tensor prefers over a Gaussian of standard
 * deviation `width` (same unit as spacing) within the active cells, so that an interface
 * of that width meets a tensor that hardly varies across it; rough measured fields ask
 * for that. Where directions agree at least by half the full anisotropy comes back, where
 * they cancel the tensor tends to I. MEMORY. */
fg_status fg__tensor_smooth(fg__tensor *tensor, fg_context *context, double anisotropy,
                            const fg__cells *cells, const bool periodic[2], double width);

/* One energy: writes xx, xy, yy for a place whose streamline has direction `tangent`. */
typedef void fg__energy_law(double tensor[3], const double tangent[2], double anisotropy);

fg__energy_law fg__energy_flow;      /* A = e e^T + a (I - e e^T), e = v/|v| */
fg__energy_law fg__energy_isotropic; /* A = I */

#endif
