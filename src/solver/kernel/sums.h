/* Energy, mass, norms, and operations on whole arrays. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_SUMS_H
#define FG__KERNEL_SUMS_H

#include "solver/kernel/sweep.h"

/* Weights of a row that make sums over nodes integrals: halves at natural boundaries, and
 * no coupling twice or to a ghost. */
typedef struct row_weights {
  const float *mass, *east, *west; /* by column */
  const float *masked;             /* relative mass, or NULL */
  float whole, upper[UPPER_ROWS];  /* of the row; of its couplings to upper rows */
} row_weights;

/* Along one axis, for couplings by d = -1, 0 or 1. */
INLINE float axis_weight(const fg__level *level, int axis, int at, int d)
{
  bool low = level->boundary[axis][0] && at == 0;
  bool high = level->boundary[axis][1] && at == level->layout.nodes[axis] - 1;
  if (d == 0)
    return low || high ? 0.5F : 1.0F;
  return (d < 0 && low) || (d > 0 && high) ? 0.0F : 1.0F;
}

INLINE row_weights weights_of(const fg__level *level, int j, int k, int colour,
                              bool masked)
{
  ptrdiff_t own = begin_of(level, colour);
  row_weights r = {.mass = level->column_mass + own,
                   .east = level->column_east + own,
                   .west = level->column_west + own};
  if (masked)
    r.masked = level->mass + fg__row_at(&level->layout, j, k) + own;
#if FG__DIMENSION == 3
  r.whole = axis_weight(level, 1, j, 0) * axis_weight(level, 2, k, 0);
  for (int n = 0; n < UPPER_ROWS; ++n) {
    int dy, dz;
    fg__upper_row(n, &dy, &dz);
    r.upper[n] = axis_weight(level, 1, j, dy) * axis_weight(level, 2, k, dz);
  }
#else
  r.whole = axis_weight(level, 1, j, 0);
  r.upper[0] = axis_weight(level, 1, j, 1);
#endif
  return r;
}

/* One node's part of the gradient energy: the couplings to its neighbours as
 * -k (u_a - u_b)^2, which loses nothing to cancellation. */
INLINE float upper_gradient(const row_weights *r, const couplings *c, const around *x,
                            float u, int n, int k)
{
  float middle = x->upper[n][k] - u;
  float east = x->upper_other[n][k + 1] - u, west = x->upper_other[n][k] - u;
  return r->upper[n] * (r->mass[k] * c->upper[n][k] * (middle * middle) +
                        r->east[k] * c->upper_east[n][k] * (east * east) +
                        r->west[k] * c->upper_west[n][k] * (west * west));
}

INLINE float gradient_at(const row_weights *r, const couplings *c, const around *x, int k)
{
  float u = x->center[k], east = x->middle[k + 1] - u;
  float sum = r->whole * r->east[k] * c->east[k] * (east * east) +
              upper_gradient(r, c, x, u, 0, k);
#if FG__DIMENSION == 3
  sum += (upper_gradient(r, c, x, u, 1, k) + upper_gradient(r, c, x, u, 3, k)) +
         upper_gradient(r, c, x, u, 2, k);
#endif
  return sum;
}

INLINE float mass_at(const row_weights *r, int k)
{
  float mass = r->whole * r->mass[k];
  return r->masked ? mass * r->masked[k] : mass;
}

/* A multiple of the level's smallest number: sums of such are exact (level.h). */
INLINE double rounded(double term, double rounding)
{
  return (term + rounding) - rounding;
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
  int columns = level->layout.nodes[0];
  return colour == ODD ? columns / 2 : (columns + 1) / 2;
}

/* What nodes start ... start + lanes - 1 of a row give to the lanes' sums, and their
 * chemical potential. With a constant number of lanes the loop is one straight piece of
 * vector code. */
INLINE void evaluate_nodes(const row_weights *r, const couplings *c, const around *x,
                           const float *mass_inverse, const fg__level *level, float *w,
                           int start, int lanes, double sum[3][FG__LANES])
{
  double rounding = level->rounding, weight = level->gradient_weight;
  INDEPENDENT
  for (int n = 0; n < lanes; ++n) {
    int k = start + n;
    float u = x->center[k], mass = mass_at(r, k);
    float energy = apply(c, x, k);
    if (mass_inverse)
      energy *= mass_inverse[k];
    float well = u * u - 1.0F;
    w[k] = 2.0F * u * well + energy;
    double chemical = (double)(mass * (well * well));
    double terms = chemical - weight * (double)gradient_at(r, c, x, k);
    sum[0][n] += rounded(terms, rounding);
    sum[1][n] += rounded((double)(mass * u), rounding);
    sum[2][n] += rounded(chemical, rounding);
  }
}

INLINE void evaluate_nodes_of_row(const fg__level *level, const float *u, float *w, int j,
                                  int k, bool masked, double sum[3][FG__LANES])
{
  ptrdiff_t at = fg__row_at(&level->layout, j, k);
  for (int colour = EVEN; colour <= ODD; ++colour) {
    int count = nodes_of(level, colour), start = 0;
    ptrdiff_t own = at + begin_of(level, colour);
    around x = around_row(level, u, at, colour);
    couplings c = couplings_row(level, &level->energy, at, colour);
    row_weights r = weights_of(level, j, k, colour, masked);
    const float *inverse = masked ? level->mass_inverse + own : NULL;
    for (; start + FG__LANES <= count; start += FG__LANES)
      evaluate_nodes(&r, &c, &x, inverse, level, w + own, start, FG__LANES, sum);
    evaluate_nodes(&r, &c, &x, inverse, level, w + own, start, count - start, sum);
  }
  fg__fill_ghost_columns(level, w + at);
}

ROW_LOOP void evaluate_plain(const fg__level *level, const float *u, float *w, int j,
                             int k, double sum[3][FG__LANES])
{
  evaluate_nodes_of_row(level, u, w, j, k, false, sum);
}

ROW_LOOP void evaluate_masked(const fg__level *level, const float *u, float *w, int j,
                              int k, double sum[3][FG__LANES])
{
  evaluate_nodes_of_row(level, u, w, j, k, true, sum);
}

/* The rows of slice s: one in 2D, a plane in 3D. */
INLINE int rows_of_slice(const fg__level *level)
{
  return FG__DIMENSION == 3 ? level->layout.nodes[1] : 1;
}

INLINE int row_index(int slice, int n)
{
  return FG__DIMENSION == 3 ? n : slice;
}

INLINE int plane_index(int slice)
{
  return FG__DIMENSION == 3 ? slice : 0;
}

static void fill_ghosts_of_slice(const fg__level *level, float *array, int s)
{
  for (int side = 0; side < 2; ++side) {
    int source = level->ghost_row_source[side];
#if FG__DIMENSION == 3
    if (source >= 0 && source < level->layout.nodes[1])
      fg__fill_ghost_row(level, array, s, side);
#else
    if (source == s)
      fg__fill_ghost_row(level, array, 0, side);
#endif
  }
#if FG__DIMENSION == 3
  for (int side = 0; side < 2; ++side)
    if (level->ghost_plane_source[side] == s)
      fg__fill_ghost_plane(level, array, side);
#endif
}

static fg__sums evaluate(const fg__level *level, const float *u, float *w,
                         const fg__thread *thread)
{
  double sum[3][FG__LANES] = {{0.0}};
  slab mine = slab_of(level, thread);
  for (int s = mine.begin; s < mine.end; ++s) {
    for (int n = 0; n < rows_of_slice(level); ++n)
      (level->mass ? evaluate_masked : evaluate_plain)(level, u, w, row_index(s, n),
                                                       plane_index(s), sum);
    fill_ghosts_of_slice(level, w, s);
  }
  fg__threads_barrier(thread);
  return (fg__sums){0.5 * total(sum[0]), total(sum[1]), 0.5 * total(sum[2])};
}

INLINE void explicit_nodes(const fg__level *level, const float *u, const float *w,
                           ptrdiff_t row, int colour, const laplacian *constants,
                           float *p, bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  ptrdiff_t own = row + begin_of(level, colour);
  int count = colour == ODD ? level->odd_count : level->even_count;
  around x = around_row(level, w, row, colour);
  couplings c = {0};
  if (masked)
    c = couplings_row(level, &level->laplacian, row, colour);
  const float *inverse = masked ? level->mass_inverse + own : NULL;
  INDEPENDENT
  for (int k = 0; k < count; ++k) {
    float flux =
        masked ? l->tau * apply(&c, &x, k) * inverse[k] : apply_constant(l, &x, k);
    p[own + k] = u[own + k] - flux;
  }
}

ROW_LOOP void explicit_plain(const fg__level *level, const float *u, const float *w,
                             ptrdiff_t row, int colour, const laplacian *l, float *p)
{
  explicit_nodes(level, u, w, row, colour, l, p, false);
}

ROW_LOOP void explicit_masked(const fg__level *level, const float *u, const float *w,
                              ptrdiff_t row, int colour, const laplacian *l, float *p)
{
  explicit_nodes(level, u, w, row, colour, l, p, true);
}

static void explicit_part(const fg__level *level, const float *u, const float *w,
                          float tau, float *p, const fg__thread *thread)
{
  laplacian l = laplacian_times(level, tau);
  slab mine = slab_of(level, thread);
  for (int s = mine.begin; s < mine.end; ++s)
    for (int n = 0; n < rows_of_slice(level); ++n)
      for (int colour = EVEN; colour <= ODD; ++colour)
        (level->mass ? explicit_masked : explicit_plain)(
            level, u, w, fg__row_at(&level->layout, row_index(s, n), plane_index(s)),
            colour, &l, p);
  fg__threads_barrier(thread);
}

INLINE void add_changes(const row_weights *r, const float *u, const float *a,
                        const float *b, const float *c, const fg__level *level, int start,
                        int lanes, double sum[4][FG__LANES])
{
  double rounding = level->rounding, fine = level->change_rounding;
  INDEPENDENT
  for (int n = 0; n < lanes; ++n) {
    int k = start + n;
    float mass = mass_at(r, k);
    float from_a = u[k] - a[k], from_b = u[k] - b[k];
    sum[0][n] += rounded((double)(mass * u[k]), rounding);
    sum[1][n] += rounded((double)(mass * from_a * from_a), fine);
    sum[2][n] += rounded((double)(mass * from_b * from_b), fine);
    sum[3][n] += rounded((double)(mass * from_a * (a[k] - c[k])), fine);
  }
}

INLINE void change_nodes_of_row(const fg__level *level, const float *u, const float *a,
                                const float *b, const float *c, int j, int k, bool masked,
                                double sum[4][FG__LANES])
{
  for (int colour = EVEN; colour <= ODD; ++colour) {
    int count = nodes_of(level, colour), start = 0;
    ptrdiff_t own = fg__row_at(&level->layout, j, k) + begin_of(level, colour);
    row_weights r = weights_of(level, j, k, colour, masked);
    for (; start + FG__LANES <= count; start += FG__LANES)
      add_changes(&r, u + own, a + own, b + own, c + own, level, start, FG__LANES, sum);
    add_changes(&r, u + own, a + own, b + own, c + own, level, start, count - start, sum);
  }
}

ROW_LOOP void changes_plain(const fg__level *level, const float *u, const float *a,
                            const float *b, const float *c, int j, int k,
                            double sum[4][FG__LANES])
{
  change_nodes_of_row(level, u, a, b, c, j, k, false, sum);
}

ROW_LOOP void changes_masked(const fg__level *level, const float *u, const float *a,
                             const float *b, const float *c, int j, int k,
                             double sum[4][FG__LANES])
{
  change_nodes_of_row(level, u, a, b, c, j, k, true, sum);
}

static fg__changes changes(const fg__level *level, const float *u, const float *a,
                           const float *b, const float *c, const fg__thread *thread)
{
  double sum[4][FG__LANES] = {{0.0}};
  slab mine = slab_of(level, thread);
  for (int s = mine.begin; s < mine.end; ++s)
    for (int n = 0; n < rows_of_slice(level); ++n)
      (level->mass ? changes_masked : changes_plain)(level, u, a, b, c, row_index(s, n),
                                                     plane_index(s), sum);
  fg__threads_barrier(thread);
  return (fg__changes){total(sum[0]), total(sum[1]), total(sum[2]), total(sum[3])};
}

/* A thread's floats of an array, ghosts and all, from its first one. */
INLINE void floats_of(const fg__level *level, const fg__thread *thread, ptrdiff_t *begin,
                      ptrdiff_t *end)
{
  ptrdiff_t rows = (ptrdiff_t)level->layout.array_size / level->layout.stride;
  *begin =
      rows * thread->index / thread->count * level->layout.stride - level->layout.first;
  *end = rows * (thread->index + 1) / thread->count * level->layout.stride -
         level->layout.first;
}

static void extrapolate(const fg__level *level, const float *now, const float *before,
                        float omega, float *out, const fg__thread *thread)
{
  ptrdiff_t begin, end;
  floats_of(level, thread, &begin, &end);
  INDEPENDENT
  for (ptrdiff_t n = begin; n < end; ++n)
    out[n] = now[n] + omega * (now[n] - before[n]);
  fg__threads_barrier(thread);
}

/* As it is extrapolated no node passes a minimum, unless it is there already: what
 * follows an interface, or a droplet that has just vanished, is pure phase. */
static void predict(const fg__level *level, const float *now, const float *before,
                    float omega, float *out, const fg__thread *thread)
{
  ptrdiff_t begin, end;
  floats_of(level, thread, &begin, &end);
  INDEPENDENT
  for (ptrdiff_t n = begin; n < end; ++n) {
    float u = now[n], high = greater(u, 1.0F), low = -greater(-u, 1.0F);
    float x = u + omega * (u - before[n]);
    out[n] = greater(x < high ? x : high, low);
  }
  fg__threads_barrier(thread);
}

static void subtract_potential_derivative(const fg__level *level, const float *u,
                                          float *w, const fg__thread *thread)
{
  ptrdiff_t begin, end;
  floats_of(level, thread, &begin, &end);
  INDEPENDENT
  for (ptrdiff_t n = begin; n < end; ++n)
    w[n] -= 2.0F * u[n] * (u[n] * u[n] - 1.0F);
  fg__threads_barrier(thread);
}

static void shift(const fg__level *level, float *u, float amount,
                  const fg__thread *thread)
{
  ptrdiff_t begin, end;
  floats_of(level, thread, &begin, &end);
  const float *mass = level->mass;
  if (mass) {
    INDEPENDENT
    for (ptrdiff_t n = begin; n < end; ++n)
      u[n] = mass[n] > 0.0F ? u[n] + amount : 0.0F;
  } else {
    INDEPENDENT
    for (ptrdiff_t n = begin; n < end; ++n)
      u[n] += amount;
  }
  fg__threads_barrier(thread);
}

#endif
