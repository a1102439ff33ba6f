/* The collective Gauss-Seidel sweep. Part of solver/kernel/body.h. */
#ifndef FG__KERNEL_SWEEP_H
#define FG__KERNEL_SWEEP_H

#include "solver/kernel/row.h"

/* For a sweep: a node past a minimum, where Psi'' is 4 and more, may go as far again, so
 * that noise beyond the minima is smoothed as fast as other noise. */
INLINE vector bounded_changes(vector u, vector change)
{
  lanes_mask sign = sign_of_lanes(change);
  vector to_minimum = size_of_lanes(1.0F - (vector)((lanes_mask)u ^ sign));
  vector size = at_most_lanes(size_of_lanes(change), to_minimum + leeway);
  return (vector)((lanes_mask)size | sign);
}

/* A block of nodes of one colour. Eliminating dw from
 *     m du + tau l0 dw = first,   m dw - g du = second,   g = Psi''(u) + k0
 * (m = 1 on the finest level) leaves a denominator m^2 + tau l0 g, which in the spinodal
 * region may vanish: it (on coarse levels g) is kept above a quarter of its value without
 * Psi''. On coarse levels its inverse, the relaxation, is found once a cycle. */
INLINE void relax(const fg__level *level, ptrdiff_t at, const laplacian *l, vector energy,
                  vector flux, bool linear, bool masked)
{
  vector u = load(level->u + at), w = load(level->w + at), p = load(level->p + at);
  vector k0 = load(level->energy.center + at), l0 = {0};
  l0 += l->center;
  if (masked) {
    vector inverse = load(level->mass_inverse + at);
    energy *= inverse;
    flux *= l->tau * inverse;
    k0 *= inverse;
    l0 = l->tau * load(level->laplacian.center + at) * inverse;
  }
  vector du, dw;
  if (linear) {
    vector curvature = load(level->curvature + at), m = load(level->coupling + at);
    vector inverse = load(level->relaxation + at);
    vector first = (p - m * u) - flux;
    vector second = (load(level->q + at) + curvature * u + energy) - m * w;
    vector g = greater_lanes(curvature + k0, 0.25F * k0);
    du = (m * first - l0 * second) * inverse;
    dw = (m * second + g * first) * inverse;
  } else {
    vector square = u * u;
    vector first = (p - u) - flux;
    vector second = (2.0F * u * (square - 1.0F) + energy) - w;
    vector g = (6.0F * square - 2.0F) + k0;
    vector denominator = greater_lanes(1.0F + l0 * g, 0.25F + 0.25F * l0 * k0);
    du = bounded_changes(u, (first - l0 * second) / denominator);
    dw = second + g * du;
  }
  store(level->u + at, u + du);
  store(level->w + at, w + dw);
}

/* Both colours of a row. What lies beyond its end is filled after. */
INLINE void smooth_nodes(const fg__level *level, ptrdiff_t at, const laplacian *constants,
                         bool linear, bool masked)
{
  const laplacian copy = *constants, *l = &copy;
  block n = first_block(level);
  strand energy =
      strand_of(level, &level->energy, l, neighbours_round(level, level->u, at), at);
  strand flux = strand_of(level, masked ? &level->laplacian : NULL, l,
                          neighbours_round(level, level->w, at), at);
  begin(&energy, &n);
  begin(&flux, &n);
  for (; n.even < n.evens; next_block(&n)) {
    advance(&energy, n.even, n.odd);
    advance(&flux, n.even, n.odd);
    relax(level, at + n.even, l, at_even_block(&energy, &n), at_even_block(&flux, &n),
          linear, masked);
    if (n.even > 0)
      relax(level, at + n.odd - WIDTH, l, at_odd_before(&energy, &n),
            at_odd_before(&flux, &n), linear, masked);
  }
  fg__fill_ghost_columns(level, level->u + at);
  fg__fill_ghost_columns(level, level->w + at);
  if (n.even - WIDTH >= n.odds)
    return;
  relax(level, at + n.odd - WIDTH, l, at_last_odd(&energy, &n), at_last_odd(&flux, &n),
        linear, masked);
  fg__fill_ghost_columns(level, level->u + at);
  fg__fill_ghost_columns(level, level->w + at);
}

#define SMOOTH_ROW(name, linear, masked)                                                 \
  ROW_LOOP void name(const fg__level *level, ptrdiff_t at, const laplacian *l)           \
  {                                                                                      \
    smooth_nodes(level, at, l, linear, masked);                                          \
  }
SMOOTH_ROW(smooth_plain, false, false)
SMOOTH_ROW(smooth_masked, false, true)
SMOOTH_ROW(smooth_linear_plain, true, false)
SMOOTH_ROW(smooth_linear_masked, true, true)
#undef SMOOTH_ROW

typedef void smooth_row_loop(const fg__level *level, ptrdiff_t at, const laplacian *l);

/* By linear, masked. */
static smooth_row_loop *const smooth_loop[2][2] = {
    {smooth_plain, smooth_masked}, {smooth_linear_plain, smooth_linear_masked}};

/* Row j of plane k, and the ghost rows that are its copies. */
static void smooth_row(const fg__level *level, int j, int k, const laplacian *l,
                       bool linear)
{
  ptrdiff_t at = fg__row_at(&level->layout, j, k);
  smooth_loop[linear][level->mass != NULL](level, at, l);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_row_source[side] == j) {
      fg__fill_ghost_row(level, level->u, k, side);
      fg__fill_ghost_row(level, level->w, k, side);
    }
}

#if FG__DIMENSION == 3
/* Rows j (even) and j - 1: even rows run one ahead of odd rows, so that a sweep passes
 * memory once and yet every odd row finds both its neighbours done. */
static void smooth_rows(const fg__level *level, int j, int k, const laplacian *l,
                        bool linear)
{
  int count = level->layout.nodes[1];
  if (j < count)
    smooth_row(level, j, k, l, linear);
  if (j > 0 && j - 1 < count)
    smooth_row(level, j - 1, k, l, linear);
}

static void smooth_slice(const fg__level *level, int k, const laplacian *l, bool linear)
{
  for (int j = 0; j < level->layout.nodes[1] + 2; j += 2)
    smooth_rows(level, j, k, l, linear);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_plane_source[side] == k) {
      fg__fill_ghost_plane(level, level->u, side);
      fg__fill_ghost_plane(level, level->w, side);
    }
}
#else
static void smooth_slice(const fg__level *level, int j, const laplacian *l, bool linear)
{
  smooth_row(level, j, 0, l, linear);
}
#endif

/* A thread's slices in a sweep: [begin, end), begin even. */
typedef struct slab {
  int begin, end;
} slab;

static slab slab_of(const fg__level *level, const fg__thread *thread)
{
  slab p;
  fg__threads_range(thread, fg__slices(level), 2, &p.begin, &p.end);
  return p;
}

/* The first slice of each part comes first: the last one of the part before needs it. */
static void begin_sweep(const fg__level *level, slab mine, const laplacian *l,
                        bool linear, const fg__thread *thread)
{
  if (mine.begin < mine.end)
    smooth_slice(level, mine.begin, l, linear);
  fg__threads_exchange(thread, FG__FIRST_SLICE);
}

/* Slices s (even, not the first) and s - 1, as far as they are of the part: again even
 * ones run ahead. */
static void continue_sweep(const fg__level *level, int s, slab mine, const laplacian *l,
                           bool linear)
{
  if (s < mine.end)
    smooth_slice(level, s, l, linear);
  if (s - 1 < mine.end)
    smooth_slice(level, s - 1, l, linear);
}

static void sweep(const fg__level *level, float tau, bool linear,
                  const fg__thread *thread)
{
  laplacian l = laplacian_times(level, tau);
  slab mine = slab_of(level, thread);
  begin_sweep(level, mine, &l, linear, thread);
  for (int s = mine.begin + 2; s <= mine.end + 1; s += 2)
    continue_sweep(level, s, mine, &l, linear);
  fg__threads_exchange(thread, FG__LAST_SLICE);
}

static void smooth_linear(const fg__level *level, float tau, const fg__thread *thread)
{
  sweep(level, tau, true, thread);
}

static void smooth(const fg__level *level, float tau, const fg__thread *thread)
{
  sweep(level, tau, false, thread);
}

#endif
