/* A node's neighbours, couplings and residuals. Part of kernel_body.h. */
#ifndef FG__KERNEL_STENCIL_H
#define FG__KERNEL_STENCIL_H

#include "evolve/kernel.h"

#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif
#define INLINE static inline __attribute__((always_inline))

/* Colours of columns. */
enum { EVEN = 0, ODD = 1 };

INLINE float greater(float a, float b)
{
  return a > b ? a : b;
}

/* Nine neighbours of the nodes of one colour in row j: index k is the k-th node of the
 * colour; `other` pointers are shifted so that [k] is the western, [k + 1] the eastern
 * column. */
typedef struct around {
  const float *center, *middle; /* this row: own colour, other colour */
  const float *south, *south_other;
  const float *north, *north_other;
} around;

INLINE around around_row(const fg__level *level, const float *array, int j, int colour)
{
  const float *row = array + (ptrdiff_t)j * level->stride;
  ptrdiff_t own = colour == ODD ? level->odd_offset : 0;
  ptrdiff_t other = colour == ODD ? 0 : level->odd_offset - 1;
  return (around){row + own,
                  row + other,
                  row - level->stride + own,
                  row - level->stride + other,
                  row + level->stride + own,
                  row + level->stride + other};
}

/* Rows of a symmetric stencil: couplings of the nodes of one colour, and of the western
 * and southern neighbours that hold the other half. */
typedef struct couplings {
  const float *center, *east, *west, *north, *south;
  const float *northeast, *southwest, *northwest, *southeast;
} couplings;

INLINE couplings couplings_row(const fg__level *level, const fg__stencil *stencil, int j,
                               int colour)
{
  ptrdiff_t row = (ptrdiff_t)j * level->stride;
  ptrdiff_t own = row + (colour == ODD ? level->odd_offset : 0);
  ptrdiff_t other = row + (colour == ODD ? 0 : level->odd_offset - 1);
  return (couplings){.center = stencil->center + own,
                     .east = stencil->east + own,
                     .west = stencil->east + other,
                     .north = stencil->north + own,
                     .south = stencil->north + own - level->stride,
                     .northeast = stencil->northeast + own,
                     .southwest = stencil->northeast + other - level->stride,
                     .northwest = stencil->northwest + own,
                     .southeast = stencil->northwest + other - level->stride + 1};
}

INLINE float apply(const couplings *c, const around *x, int k)
{
  return (c->center[k] * x->center[k] +
          (c->east[k] * x->middle[k + 1] + c->west[k] * x->middle[k])) +
         ((c->north[k] * x->north[k] + c->south[k] * x->south[k]) +
          ((c->northeast[k] * x->north_other[k + 1] +
            c->southwest[k] * x->south_other[k]) +
           (c->northwest[k] * x->north_other[k] +
            c->southeast[k] * x->south_other[k + 1])));
}

/* The Laplacian's constants times tau, kept in registers. */
typedef struct laplacian {
  float center, east, north, diagonal, tau;
} laplacian;

INLINE laplacian laplacian_times(const fg__level *level, float tau)
{
  return (laplacian){tau * level->laplacian_center, tau * level->laplacian_east,
                     tau * level->laplacian_north, tau * level->laplacian_diagonal, tau};
}

INLINE float apply_constant(const laplacian *l, const around *x, int k)
{
  return (l->center * x->center[k] + l->east * (x->middle[k + 1] + x->middle[k])) +
         (l->north * (x->north[k] + x->south[k]) +
          l->diagonal * ((x->north_other[k + 1] + x->south_other[k]) +
                         (x->north_other[k] + x->south_other[k + 1])));
}

/* Everything about the nodes of one colour in one row. The masked versions multiply rows
 * by the inverse of the relative mass. */
typedef struct row {
  int count;
  around u, w;
  couplings energy, laplacian;
  const float *p, *q, *curvature, *mass_inverse;
} row;

INLINE row row_of(const fg__level *level, int j, int colour, bool linear, bool masked)
{
  ptrdiff_t own = (ptrdiff_t)j * level->stride + (colour == ODD ? level->odd_offset : 0);
  row r = {.count = colour == ODD ? level->odd_count : level->even_count,
           .u = around_row(level, level->u, j, colour),
           .w = around_row(level, level->w, j, colour),
           .energy = couplings_row(level, &level->energy, j, colour),
           .p = level->p + own};
  if (linear) {
    r.q = level->q + own;
    r.curvature = level->curvature + own;
  }
  if (masked) {
    r.laplacian = couplings_row(level, &level->laplacian, j, colour);
    r.mass_inverse = level->mass_inverse + own;
  }
  return r;
}

/* Residuals of both equations at node k, and the curvature there. A coarse level's
 * curvature is clipped where it is used, not where it is restricted: negative values in
 * the midst of an interface rightly soften the mean, but by themselves overshoot. */
typedef struct residuals {
  float first, second, curvature;
} residuals;

INLINE residuals residuals_at(const row *r, const laplacian *l, int k, bool linear,
                              bool masked)
{
  float u = r->u.center[k], w = r->w.center[k];
  float energy = apply(&r->energy, &r->u, k);
  float flux =
      masked ? l->tau * apply(&r->laplacian, &r->w, k) : apply_constant(l, &r->w, k);
  if (masked) {
    energy *= r->mass_inverse[k];
    flux *= r->mass_inverse[k];
  }
  float first = (r->p[k] - u) - flux;
  if (linear) {
    float curvature = greater(r->curvature[k], 0.0F);
    return (residuals){first, (r->q[k] + curvature * u + energy) - w, curvature};
  }
  float square = u * u;
  return (residuals){first, (2.0F * u * (square - 1.0F) + energy) - w,
                     6.0F * square - 2.0F};
}

#endif
