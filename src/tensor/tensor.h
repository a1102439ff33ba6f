/* Interfacial energies: what an interface costs, by place and direction. */
#ifndef FG__TENSOR_H
#define FG__TENSOR_H

#include "base/context.h"
#include "base/threads.h"

/* The cells to give a tensor to: a box of cells of a uniform grid that fills the domain,
 * in the input's coordinates. A cell's tensor has the same bits whichever box it is
 * computed in. */
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

/* The law of one of our own energies; NULL: there is none of that number. */
const fg_energy_law *fg__energy(fg_energy energy);

/* Fills the arrays, which the caller has allocated with one element a cell of the box, by
 * the law of an energy; the same with any number of threads (NULL: one thread). ARGUMENT
 * (anisotropy outside (0, 1]; no active cell in a box that is the whole domain; a law
 * whose eigenvalues are not between the anisotropy and 1). */
fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          const fg_energy_law *law, double anisotropy,
                          const fg__cells *cells, fg__threads *threads);

/* Length of the mean of directions from which on the tensor has the full anisotropy. */
extern const double fg__full_coherence;

/* Averages the directions that a law with axes prefers over a Gaussian of standard
 * deviation `width` (same unit as spacing) within the active cells, in place, so that an
 * interface of that width meets a tensor that hardly varies across it: rough measured
 * fields need that. Where the mean of directions is at least fg__full_coherence long the
 * tensor has the full anisotropy; it tends to I where they cancel
 * (docs/design/tensor.md). The mean is over cells of the box alone, and wraps round a
 * periodic axis that the box spans. MEMORY. */
fg_status fg__tensor_smooth(fg__tensor *tensor, fg_context *context, double anisotropy,
                            const fg__cells *cells, const bool periodic[3], double width,
                            fg__threads *threads);

/* Both for any box of the domain, which may go on beyond the ends of a periodic axis:
 * fills and, for a law with axes and a width above 0, smooths. Cells round the box within
 * the Gaussian's reach are computed, too, so that each rank computes its own boxes alone,
 * with the values of the whole domain. Threads (NULL: one thread) share the work on a box
 * that is the whole domain. A box without an active cell is no
 * failure unless it is the whole domain. Statuses as fg__tensor_fill; MEMORY. */
fg_status fg__tensor_fill_box(fg__tensor *tensor, fg_context *context,
                              const fg_field *field, const fg_energy_law *law,
                              double anisotropy, const fg__cells *cells,
                              const bool periodic[3], double width, fg__threads *threads);

/* The same in steps, for a field that comes window by window: a box's tensor with what
 * smoothing reaches round it. MEMORY. */
typedef struct fg__wide_tensor {
  fg__cells cells; /* at whose centres a law is evaluated; it may read the field within
                      half a cell */
  fg__tensor tensor;
  void *memory;
} fg__wide_tensor;

fg__cells fg__tensor_reach(const fg_energy_law *law, const fg__cells *cells,
                           const bool periodic[3], double width);
fg_status fg__wide_tensor_create(fg__wide_tensor *out, fg_context *context,
                                 const fg__cells *reach);

/* Layers [first, first + count) along its last axis. As fg__tensor_fill. */
fg_status fg__wide_tensor_fill(fg__wide_tensor *wide, fg_context *context,
                               const fg_field *field, const fg_energy_law *law,
                               double anisotropy, int first, int count);

/* Once all are filled: what fg__tensor_fill_box gives. MEMORY. */
fg_status fg__wide_tensor_finish(fg__tensor *tensor, fg_context *context,
                                 fg__wide_tensor *wide, const fg_energy_law *law,
                                 double anisotropy, const fg__cells *cells,
                                 const bool periodic[3], double width);
void fg__wide_tensor_clear(fg__wide_tensor *wide);

/* Cells along z, cells of the box, cells of the domain along axis k. */
int fg__layers(const fg__cells *cells);
size_t fg__cell_count(const fg__cells *cells);
int fg__domain_count(const fg__cells *cells, int k);

/* How many cells far along axis k smoothing reaches. */
int fg__smoothing_radius(const fg__cells *cells, int k, double width);

/* A = e e^T + a (I - e e^T), e = v/|v|. With data, a double: 1 - a falls to 0 with the
 * speed below that one (input's units), once it is smoothed. */
extern const fg_energy_law fg__law_flow;
extern const fg_energy_law fg__law_isotropic; /* A = I */
extern const fg_energy_law fg__law_gradient; /* A = I - (1 - a) e e^T, e along grad |v| */

/* The tensors of the first two: xx, xy, yy, zz, xz, yz for a direction of any length;
 * with direction[2] = 0 the first three are those of a field in 2D. */
void fg__tensor_along(double tensor[6], const double direction[3], double anisotropy);
void fg__tensor_unit(double tensor[6]);

#endif
