/* A node's neighbours, couplings and residuals. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_STENCIL_H
#define FG__KERNEL_STENCIL_H

#include "solver/kernel/kernel.h"
#include "solver/kernel/vector.h"

#if defined(__clang__)
/* clang 14 leaves one loop of the masked 3D energy as it is: slower, not wrong */
#pragma clang diagnostic ignored "-Wpass-failed"
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#define UNROLLED _Pragma("clang loop unroll(full)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#define UNROLLED _Pragma("GCC unroll 4")
#endif
/* Loops over one row, a function each, so that each is compiled once. */
#define ROW_LOOP static __attribute__((noinline))

#if FG__DIMENSION == 3
enum { UPPER_ROWS = 4 };
#else
enum { UPPER_ROWS = 1 };
#endif

/* Colours of columns. */
enum { EVEN = 0, ODD = 1 };

INLINE float greater(float a, float b)
{
  return a > b ? a : b;
}

/* From a row to its upper row r. */
INLINE ptrdiff_t upper_row(const fg__level *level, int r)
{
  return r == 0 ? level->layout.stride
                : level->layout.plane + (r - 2) * level->layout.stride;
}

/* Where the nodes of a colour begin in a row. */
INLINE ptrdiff_t begin_of(const fg__level *level, int colour)
{
  return colour == ODD ? level->layout.odd_offset : 0;
}

/* The neighbours of the nodes of one colour in a row: index k is the k-th node of the
 * colour; `other` pointers are shifted so that [k] is the western, [k + 1] the eastern
 * column. */
typedef struct around {
  const float *center, *middle; /* this row: own colour, other colour */
  const float *upper[UPPER_ROWS], *upper_other[UPPER_ROWS];
  const float *lower[UPPER_ROWS], *lower_other[UPPER_ROWS];
} around;

INLINE around around_row(const fg__level *level, const float *array, ptrdiff_t row,
                         int colour)
{
  ptrdiff_t own = row + begin_of(level, colour);
  ptrdiff_t other = row + (colour == ODD ? 0 : level->layout.odd_offset - 1);
  around x = {.center = array + own, .middle = array + other};
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    ptrdiff_t up = upper_row(level, r);
    x.upper[r] = array + own + up;
    x.upper_other[r] = array + other + up;
    x.lower[r] = array + own - up;
    x.lower_other[r] = array + other - up;
  }
  return x;
}

/* Rows of a symmetric stencil: couplings of the nodes of one colour, and of the
 * neighbours that hold the other half. */
typedef struct couplings {
  const float *center, *east, *west;
  const float *upper[UPPER_ROWS], *upper_east[UPPER_ROWS], *upper_west[UPPER_ROWS];
  const float *lower[UPPER_ROWS], *lower_east[UPPER_ROWS], *lower_west[UPPER_ROWS];
} couplings;

INLINE couplings couplings_row(const fg__level *level, const fg__stencil *stencil,
                               ptrdiff_t row, int colour)
{
  ptrdiff_t own = row + begin_of(level, colour);
  ptrdiff_t other = row + (colour == ODD ? 0 : level->layout.odd_offset - 1);
  couplings c = {.center = stencil->center + own,
                 .east = stencil->to[0] + own,
                 .west = stencil->to[0] + other};
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    ptrdiff_t up = upper_row(level, r);
    c.upper_west[r] = stencil->to[1 + 3 * r] + own;
    c.upper[r] = stencil->to[2 + 3 * r] + own;
    c.upper_east[r] = stencil->to[3 + 3 * r] + own;
    c.lower_east[r] = stencil->to[1 + 3 * r] + other + 1 - up;
    c.lower[r] = stencil->to[2 + 3 * r] + own - up;
    c.lower_west[r] = stencil->to[3 + 3 * r] + other - up;
  }
  return c;
}

/* The shape in which an interface's motion changes u: u' of a resting interface is in
 * proportion to 1 - u^2. */
INLINE float interface_shape(float u)
{
  return greater(1.0F - u * u, 0.0F);
}

/* Where a droplet vanishes the equations are next to singular, and a change that is found
 * from them as linear ones would carry u far past the minimum that it moves to. So
 * neither a coarse correction nor a sweep takes a node past a minimum by more than this,
 * which is what the curvature of interfaces does there. Near a solution changes are
 * smaller, and it is the same solution (docs/design/evolution.md). */
static const float leeway = 0.02F;

/* For a correction: a node past a minimum goes no farther than the leeway, either. */
INLINE float bounded_change(float u, float change)
{
  float up = greater(1.0F - u, 0.0F) + leeway, down = -greater(1.0F + u, 0.0F) - leeway;
  float bounded = change > up ? up : change; /* NaN remains NaN */
  return bounded < down ? down : bounded;
}

INLINE float apply_pair(const couplings *c, const around *x, int r, int k)
{
  return (c->upper[r][k] * x->upper[r][k] + c->lower[r][k] * x->lower[r][k]) +
         ((c->upper_east[r][k] * x->upper_other[r][k + 1] +
           c->lower_west[r][k] * x->lower_other[r][k]) +
          (c->upper_west[r][k] * x->upper_other[r][k] +
           c->lower_east[r][k] * x->lower_other[r][k + 1]));
}

INLINE float apply(const couplings *c, const around *x, int k)
{
  float sum = (c->center[k] * x->center[k] +
               (c->east[k] * x->middle[k + 1] + c->west[k] * x->middle[k])) +
              apply_pair(c, x, 0, k);
#if FG__DIMENSION == 3
  sum += (apply_pair(c, x, 1, k) + apply_pair(c, x, 3, k)) + apply_pair(c, x, 2, k);
#endif
  return sum;
}

/* The Laplacian's constants times tau, kept in registers. */
typedef struct laplacian {
  float center, east, middle[UPPER_ROWS], side[UPPER_ROWS], tau;
} laplacian;

INLINE laplacian laplacian_times(const fg__level *level, float tau)
{
  laplacian l = {.center = tau * level->laplacian_center,
                 .east = tau * level->laplacian_east,
                 .tau = tau};
  for (int r = 0; r < UPPER_ROWS; ++r) {
    l.middle[r] = tau * level->laplacian_middle[r];
    l.side[r] = tau * level->laplacian_side[r];
  }
  return l;
}

INLINE float apply_constant_pair(const laplacian *l, const around *x, int r, int k)
{
  return l->middle[r] * (x->upper[r][k] + x->lower[r][k]) +
         l->side[r] * ((x->upper_other[r][k + 1] + x->lower_other[r][k]) +
                       (x->upper_other[r][k] + x->lower_other[r][k + 1]));
}

INLINE float apply_constant(const laplacian *l, const around *x, int k)
{
  float sum = (l->center * x->center[k] + l->east * (x->middle[k + 1] + x->middle[k])) +
              apply_constant_pair(l, x, 0, k);
#if FG__DIMENSION == 3
  sum += (apply_constant_pair(l, x, 1, k) + apply_constant_pair(l, x, 3, k)) +
         apply_constant_pair(l, x, 2, k);
#endif
  return sum;
}

#endif
