/* Energy, mass, norms, and operations on whole arrays. Part of kernel_body.h. */
#ifndef FG__KERNEL_SUMS_H
#define FG__KERNEL_SUMS_H

#include "evolve/kernel_stencil.h"

/* ---- potential and sums
 * ----------------------------------------------------------------- */

/* Weights of a row that make sums over nodes integrals: halves at natural borders, and no
 * coupling twice or to a ghost. */
typedef struct row_weights {
  const float *mass, *east, *west; /* by column */
  const float *masked;             /* relative mass, or NULL */
  float whole, north;              /* of the row: mass and east; the row above */
} row_weights;

INLINE row_weights weights_of(const fg__level *level, int j, int colour, bool masked)
{
  ptrdiff_t own = colour == ODD ? level->odd_offset : 0;
  bool border = !level->periodic[1] && (j == 0 || j == level->rows - 1);
  bool top = !level->periodic[1] && j == level->rows - 1;
  return (row_weights){.mass = level->column_mass + own,
                       .east = level->column_east + own,
                       .west = level->column_west + own,
                       .masked = masked ? level->mass + (ptrdiff_t)j * level->stride + own
                                        : NULL,
                       .whole = border ? 0.5F : 1.0F,
                       .north = top ? 0.0F : 1.0F};
}

/* One node's part of the gradient energy: the couplings to its east, north and diagonal
 * neighbours as -k (u_a - u_b)^2, which loses nothing to cancellation. */
INLINE float gradient_at(const row_weights *r, const couplings *c, const around *x, int k)
{
  float u = x->center[k];
  float east = x->middle[k + 1] - u, north = x->north[k] - u;
  float northeast = x->north_other[k + 1] - u, northwest = x->north_other[k] - u;
  return r->whole * r->east[k] * c->east[k] * (east * east) +
         r->north * (r->mass[k] * c->north[k] * (north * north) +
                     r->east[k] * c->northeast[k] * (northeast * northeast) +
                     r->west[k] * c->northwest[k] * (northwest * northwest));
}

INLINE float mass_at(const row_weights *r, int k)
{
  float mass = r->whole * r->mass[k];
  return r->masked ? mass * r->masked[k] : mass;
}

INLINE double total(const double lanes[FG__LANES])
{
  double sum = 0.0;
  for (int n = 0; n < FG__LANES; ++n)
    sum += lanes[n];
  return sum;
}

INLINE int nodes_of(const fg__level *level, int colour)
{
  return colour == ODD ? level->columns / 2 : (level->columns + 1) / 2;
}

/* What nodes start ... start + lanes - 1 of a row give to the lanes' sums, and their
 * chemical potential. With a constant number of lanes the loop is one straight piece of
 * vector code. */
INLINE void evaluate_nodes(const row_weights *r, const couplings *c, const around *x,
                           const float *mass_inverse, float *w, int start, int lanes,
                           double sum[2][FG__LANES])
{
  INDEPENDENT
  for (int n = 0; n < lanes; ++n) {
    int k = start + n;
    float u = x->center[k], mass = mass_at(r, k);
    float energy = apply(c, x, k);
    if (mass_inverse)
      energy *= mass_inverse[k];
    float well = u * u - 1.0F;
    w[k] = 2.0F * u * well + energy;
    sum[0][n] += (double)(mass * (well * well)) - (double)gradient_at(r, c, x, k);
    sum[1][n] += (double)(mass * u);
  }
}

INLINE fg__sums evaluate_level(const fg__level *level, const float *u, float *w,
                               bool masked)
{
  double sum[2][FG__LANES] = {{0.0}};
  for (int j = 0; j < level->rows; ++j) {
    float *out = w + (ptrdiff_t)j * level->stride;
    for (int colour = EVEN; colour <= ODD; ++colour) {
      int count = nodes_of(level, colour), start = 0;
      ptrdiff_t own = colour == ODD ? level->odd_offset : 0;
      around x = around_row(level, u, j, colour);
      couplings c = couplings_row(level, &level->energy, j, colour);
      row_weights r = weights_of(level, j, colour, masked);
      const float *inverse =
          masked ? level->mass_inverse + (ptrdiff_t)j * level->stride + own : NULL;
      for (; start + FG__LANES <= count; start += FG__LANES)
        evaluate_nodes(&r, &c, &x, inverse, out + own, start, FG__LANES, sum);
      evaluate_nodes(&r, &c, &x, inverse, out + own, start, count - start, sum);
    }
    fg__fill_ghost_columns(level, out);
  }
  fg__fill_ghost_row(level, w, 0);
  fg__fill_ghost_row(level, w, 1);
  return (fg__sums){0.5 * total(sum[0]), total(sum[1])};
}

static fg__sums evaluate(const fg__level *level, const float *u, float *w)
{
  return level->mass ? evaluate_level(level, u, w, true)
                     : evaluate_level(level, u, w, false);
}

INLINE void add_changes(const row_weights *r, const float *u, const float *a,
                        const float *b, const float *c, int start, int lanes,
                        double sum[4][FG__LANES])
{
  INDEPENDENT
  for (int n = 0; n < lanes; ++n) {
    int k = start + n;
    float mass = mass_at(r, k);
    float from_a = u[k] - a[k], from_b = u[k] - b[k];
    sum[0][n] += (double)(mass * u[k]);
    sum[1][n] += (double)(mass * from_a * from_a);
    sum[2][n] += (double)(mass * from_b * from_b);
    sum[3][n] += (double)(mass * from_a * (a[k] - c[k]));
  }
}

INLINE fg__changes changes_of(const fg__level *level, const float *u, const float *a,
                              const float *b, const float *c, bool masked)
{
  double sum[4][FG__LANES] = {{0.0}};
  for (int j = 0; j < level->rows; ++j)
    for (int colour = EVEN; colour <= ODD; ++colour) {
      int count = nodes_of(level, colour), start = 0;
      ptrdiff_t own =
          (ptrdiff_t)j * level->stride + (colour == ODD ? level->odd_offset : 0);
      row_weights r = weights_of(level, j, colour, masked);
      for (; start + FG__LANES <= count; start += FG__LANES)
        add_changes(&r, u + own, a + own, b + own, c + own, start, FG__LANES, sum);
      add_changes(&r, u + own, a + own, b + own, c + own, start, count - start, sum);
    }
  return (fg__changes){total(sum[0]), total(sum[1]), total(sum[2]), total(sum[3])};
}

static fg__changes changes(const fg__level *level, const float *u, const float *a,
                           const float *b, const float *c)
{
  return level->mass ? changes_of(level, u, a, b, c, true)
                     : changes_of(level, u, a, b, c, false);
}

static void extrapolate(const fg__level *level, const float *now, const float *before,
                        float omega, float *out)
{
  ptrdiff_t size = (ptrdiff_t)level->array_size - level->first;
  INDEPENDENT
  for (ptrdiff_t n = -level->first; n < size; ++n)
    out[n] = now[n] + omega * (now[n] - before[n]);
}

static void shift(const fg__level *level, float *u, float amount)
{
  ptrdiff_t size = (ptrdiff_t)level->array_size - level->first;
  const float *mass = level->mass;
  if (mass) {
    INDEPENDENT
    for (ptrdiff_t n = -level->first; n < size; ++n)
      u[n] = mass[n] > 0.0F ? u[n] + amount : 0.0F;
  } else {
    INDEPENDENT
    for (ptrdiff_t n = -level->first; n < size; ++n)
      u[n] += amount;
  }
}

#endif
