/* The one source of the inner loops; see kernel.h. Included by kernel_*.c only, each of
 * which is compiled for one vector width. */
#include <string.h>

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

/* One colour of one row. Eliminating dw from
 *     du + tau l0 dw = first,   dw - g du = second,   g = Psi''(u) + k0
 * leaves a denominator 1 + tau l0 g, which in the spinodal region may vanish: it is kept
 * above a quarter of its value without Psi''. */
INLINE void smooth_row(const fg__level *level, int j, int colour, const laplacian *l,
                       bool linear, bool masked)
{
  row r = row_of(level, j, colour, linear, masked);
  ptrdiff_t own = (ptrdiff_t)j * level->stride + (colour == ODD ? level->odd_offset : 0);
  float *u = level->u + own, *w = level->w + own;
  INDEPENDENT
  for (int k = 0; k < r.count; ++k) {
    residuals f = residuals_at(&r, l, k, linear, masked);
    float k0 = r.energy.center[k];
    float l0 = masked ? l->tau * r.laplacian.center[k] : l->center;
    if (masked) {
      k0 *= r.mass_inverse[k];
      l0 *= r.mass_inverse[k];
    }
    float g = f.curvature + k0;
    float denominator = 1.0F + l0 * g;
    if (!linear)
      denominator = greater(denominator, 0.25F + 0.25F * l0 * k0);
    float du = (f.first - l0 * f.second) / denominator;
    u[k] += du;
    w[k] += f.second + g * du;
  }
  fg__fill_ghost_columns(level, level->u + (ptrdiff_t)j * level->stride);
  fg__fill_ghost_columns(level, level->w + (ptrdiff_t)j * level->stride);
}

INLINE void smooth_both(const fg__level *level, int j, const laplacian *l, bool linear,
                        bool masked)
{
  smooth_row(level, j, EVEN, l, linear, masked);
  smooth_row(level, j, ODD, l, linear, masked);
  for (int side = 0; side < 2; ++side)
    if (level->ghost_row_source[side] == j) {
      fg__fill_ghost_row(level, level->u, side);
      fg__fill_ghost_row(level, level->w, side);
    }
}

/* Rows j (even) and j - 1: even rows run one ahead of odd rows, so that a sweep passes
 * memory once and yet every odd row finds both its neighbours done. */
INLINE void sweep_rows(const fg__level *level, int j, const laplacian *l, bool linear,
                       bool masked)
{
  if (j < level->rows)
    smooth_both(level, j, l, linear, masked);
  if (j > 0 && j - 1 < level->rows)
    smooth_both(level, j - 1, l, linear, masked);
}

INLINE void sweep(const fg__level *level, float tau, bool linear, bool masked)
{
  laplacian l = laplacian_times(level, tau);
  for (int j = 0; j < level->rows + 2; j += 2)
    sweep_rows(level, j, &l, linear, masked);
}

static void smooth_linear(const fg__level *level, float tau)
{
  if (level->mass)
    sweep(level, tau, true, true);
  else
    sweep(level, tau, true, false);
}

static void smooth(const fg__level *level, float tau)
{
  if (level->mass)
    sweep(level, tau, false, true);
  else
    sweep(level, tau, false, false);
}

/* ---- restriction ------------------------------------------------------------------- */

/* A row in the level's own layout, for what is restricted: three quantities at most. */
enum { MOST_QUANTITIES = 3 };

typedef struct line {
  float *value[MOST_QUANTITIES];
} line;

/* The coarse row that gathers 1/4, 1/2, 1/4 of a fine row, in natural order, which is the
 * order of the fine row's even columns. */
INLINE void gather_columns(const fg__level *fine, const float *from, float *to)
{
  const float *even = from, *odd = from + fine->odd_offset;
  INDEPENDENT
  for (int k = 0; k < fine->even_count; ++k)
    to[k] = 0.5F * even[k] + 0.25F * (odd[k - 1] + odd[k]);
}

INLINE void weigh(const fg__level *fine, int j, float *line_values)
{
  const float *mass = fine->mass + (ptrdiff_t)j * fine->stride;
  INDEPENDENT
  for (int k = -FG__LANES; k < (int)fine->stride - FG__LANES; ++k)
    line_values[k] *= mass[k];
}

INLINE void residual_line(const fg__level *fine, int j, const laplacian *l, line *out,
                          bool linear, bool masked)
{
  for (int colour = EVEN; colour <= ODD; ++colour) {
    row r = row_of(fine, j, colour, linear, masked);
    ptrdiff_t own = colour == ODD ? fine->odd_offset : 0;
    float *first = out->value[0] + own, *second = out->value[1] + own;
    float *curvature = out->value[2] + own;
    INDEPENDENT
    for (int k = 0; k < r.count; ++k) {
      residuals f = residuals_at(&r, l, k, linear, masked);
      first[k] = f.first;
      second[k] = f.second;
      curvature[k] = linear ? r.curvature[k] : f.curvature;
    }
  }
}

INLINE void defect_line(const fg__level *fine, const float *w, int j, const laplacian *l,
                        line *out, bool masked)
{
  for (int colour = EVEN; colour <= ODD; ++colour) {
    ptrdiff_t own = colour == ODD ? fine->odd_offset : 0;
    ptrdiff_t at = (ptrdiff_t)j * fine->stride + own;
    int count = colour == ODD ? fine->odd_count : fine->even_count;
    around x = around_row(fine, w, j, colour);
    couplings c = {0};
    if (masked)
      c = couplings_row(fine, &fine->laplacian, j, colour);
    const float *u = fine->u + at, *p = fine->p + at;
    const float *inverse = masked ? fine->mass_inverse + at : NULL;
    float *out_values = out->value[0] + own;
    INDEPENDENT
    for (int k = 0; k < count; ++k) {
      float flux =
          masked ? l->tau * apply(&c, &x, k) * inverse[k] : apply_constant(l, &x, k);
      out_values[k] = (p[k] - u[k]) - flux;
    }
  }
}

/* Writes a coarse row given in natural order into the split layout. */
INLINE void split(const fg__level *coarse, const float *natural, float *to)
{
  float *even = to, *odd = to + coarse->odd_offset;
  int even_nodes = (coarse->columns + 1) / 2, odd_nodes = coarse->columns / 2;
  INDEPENDENT
  for (int k = 0; k < even_nodes; ++k)
    even[k] = natural[2 * k];
  INDEPENDENT
  for (int k = 0; k < odd_nodes; ++k)
    odd[k] = natural[2 * k + 1];
  fg__fill_ghost_columns(coarse, to);
}

/* What a restriction needs: the fine rows, one after the other, gathered to coarse
 * columns. */
typedef struct restriction {
  const fg__level *fine, *coarse;
  const float *w; /* of a defect; NULL: full residuals */
  laplacian l;
  int quantities;
  line fine_line;
  line gathered[3]; /* rows 2J - 1, 2J, 2J + 1 */
} restriction;

INLINE void gather_row(restriction *r, int j, const line *to, bool linear, bool masked)
{
  const fg__level *fine = r->fine;
  if (r->w)
    defect_line(fine, r->w, j, &r->l, &r->fine_line, masked);
  else
    residual_line(fine, j, &r->l, &r->fine_line, linear, masked);
  for (int n = 0; n < r->quantities; ++n) {
    float *values = r->fine_line.value[n];
    fg__fill_ghost_columns(fine, values);
    if (masked)
      weigh(fine, j, values);
    gather_columns(fine, values, to->value[n]);
  }
}

INLINE void combine_rows(restriction *r, int J, float *const out[], bool masked)
{
  const fg__level *coarse = r->coarse;
  float *sum = r->fine_line.value[0];
  for (int n = 0; n < r->quantities; ++n) {
    const float *low = r->gathered[0].value[n], *middle = r->gathered[1].value[n];
    const float *high = r->gathered[2].value[n];
    INDEPENDENT
    for (int k = 0; k < r->fine->even_count; ++k)
      sum[k] = 0.5F * middle[k] + 0.25F * (low[k] + high[k]);
    float *to = fg__row(coarse, out[n], J);
    split(coarse, sum, to);
    if (masked) {
      const float *inverse = coarse->mass_inverse + (ptrdiff_t)J * coarse->stride;
      INDEPENDENT
      for (int k = -FG__LANES; k < (int)coarse->stride - FG__LANES; ++k)
        to[k] *= inverse[k];
    }
  }
}

INLINE void swap_lines(line *a, line *b)
{
  line kept = *a;
  *a = *b;
  *b = kept;
}

/* Coarse row J from fine rows 2J - 1 (kept from the row before), 2J and 2J + 1. */
INLINE void restrict_row(restriction *r, int J, float *const out[], bool linear,
                         bool masked)
{
  const fg__level *fine = r->fine;
  if (J == 0)
    gather_row(r, fine->ghost_row_source[0], &r->gathered[0], linear, masked);
  gather_row(r, 2 * J, &r->gathered[1], linear, masked);
  int above = 2 * J + 1 < fine->rows ? 2 * J + 1 : fine->ghost_row_source[1];
  gather_row(r, above, &r->gathered[2], linear, masked);
  combine_rows(r, J, out, masked);
  swap_lines(&r->gathered[0], &r->gathered[2]);
}

/* Lines cut from the fine level's scratch space. */
INLINE restriction restriction_of(const fg__level *fine, const fg__level *coarse,
                                  float tau, int quantities)
{
  restriction r = {.fine = fine,
                   .coarse = coarse,
                   .l = laplacian_times(fine, tau),
                   .quantities = quantities};
  float *space = fine->scratch;
  for (int n = 0; n < quantities; ++n) {
    r.fine_line.value[n] = space + FG__LANES;
    space += fine->stride;
    for (int m = 0; m < 3; ++m) {
      r.gathered[m].value[n] = space + FG__LANES;
      space += fine->stride;
    }
  }
  return r;
}

INLINE void clear(const fg__level *level, float *array)
{
  memset(array - level->first, 0, level->array_size * sizeof *array);
}

/* Once rows up to j = 2J + 2 are smoothed, those up to 2J + 1 have their final residuals,
 * while they are still near. Not so across a periodic border, where row 0 needs the last.
 */
INLINE void descend(const fg__level *fine, const fg__level *coarse, float tau,
                    bool linear, bool masked)
{
  laplacian l = laplacian_times(fine, tau);
  restriction r = restriction_of(fine, coarse, tau, 3);
  float *out[] = {coarse->p, coarse->q, coarse->curvature};
  bool together = !fine->periodic[1];
  for (int j = 0; j < fine->rows + 2; j += 2) {
    sweep_rows(fine, j, &l, linear, masked);
    if (together && j >= 2)
      restrict_row(&r, j / 2 - 1, out, linear, masked);
  }
  for (int J = 0; !together && J < coarse->rows; ++J)
    restrict_row(&r, J, out, linear, masked);
  clear(coarse, coarse->u);
  clear(coarse, coarse->w);
}

static void smooth_restrict(const fg__level *fine, const fg__level *coarse, float tau)
{
  if (fine->mass)
    descend(fine, coarse, tau, false, true);
  else
    descend(fine, coarse, tau, false, false);
}

static void smooth_restrict_linear(const fg__level *fine, const fg__level *coarse,
                                   float tau)
{
  if (fine->mass)
    descend(fine, coarse, tau, true, true);
  else
    descend(fine, coarse, tau, true, false);
}

static void restrict_defect(const fg__level *fine, const float *w,
                            const fg__level *coarse, float *out, float tau)
{
  restriction r = restriction_of(fine, coarse, tau, 1);
  r.w = w;
  float *outs[] = {out};
  for (int J = 0; J < coarse->rows; ++J)
    if (fine->mass)
      restrict_row(&r, J, outs, true, true);
    else
      restrict_row(&r, J, outs, true, false);
  fg__fill_ghosts(coarse, out);
}

/* ---- prolongation --------------------------------------------------------------------
 */

/* A coarse row, or the mean of two, in natural order with one ghost at its end. */
INLINE void merge(const fg__level *coarse, const float *a, const float *b, float *natural)
{
  int even_nodes = (coarse->columns + 1) / 2, odd_nodes = coarse->columns / 2;
  INDEPENDENT
  for (int k = 0; k < even_nodes; ++k)
    natural[2 * k] = 0.5F * (a[k] + b[k]);
  const float *a_odd = a + coarse->odd_offset, *b_odd = b + coarse->odd_offset;
  INDEPENDENT
  for (int k = 0; k < odd_nodes; ++k)
    natural[2 * k + 1] = 0.5F * (a_odd[k] + b_odd[k]);
  ptrdiff_t ghost = coarse->ghost_column[1];
  natural[coarse->columns] = 0.5F * (a[ghost] + b[ghost]);
}

/* Row j of base + the interpolation of a coarse array. */
INLINE void prolong_row(const fg__level *coarse, const float *from, const fg__level *fine,
                        const float *base, float *to, int j)
{
  float *natural = fine->scratch;
  const float *low = from + (ptrdiff_t)(j / 2) * coarse->stride;
  const float *high = j % 2 == 0 ? low : low + coarse->stride;
  merge(coarse, low, high, natural);
  const float *base_even = base + (ptrdiff_t)j * fine->stride;
  const float *base_odd = base_even + fine->odd_offset;
  float *even = fg__row(fine, to, j), *odd = even + fine->odd_offset;
  INDEPENDENT
  for (int k = 0; k < fine->even_count; ++k)
    even[k] = base_even[k] + natural[k];
  INDEPENDENT
  for (int k = 0; k < fine->odd_count; ++k)
    odd[k] = base_odd[k] + 0.5F * (natural[k] + natural[k + 1]);
  fg__fill_ghost_columns(fine, even);
  for (int side = 0; side < 2; ++side)
    if (fine->ghost_row_source[side] == j)
      fg__fill_ghost_row(fine, to, side);
}

static void prolong_array(const fg__level *coarse, const float *from,
                          const fg__level *fine, const float *base, float *to)
{
  for (int j = 0; j < fine->rows; ++j)
    prolong_row(coarse, from, fine, base, to, j);
}

INLINE void prolong_rows(const fg__level *coarse, const fg__level *fine, int first,
                         int last)
{
  for (int j = first; j <= last && j < fine->rows; ++j) {
    prolong_row(coarse, coarse->u, fine, fine->u, fine->u, j);
    prolong_row(coarse, coarse->w, fine, fine->w, fine->w, j);
  }
}

/* Row j is smoothed when rows up to j + 1 are corrected; across a periodic border row 0
 * needs the last one too. */
INLINE void ascend(const fg__level *coarse, const fg__level *fine, float tau, bool linear,
                   bool masked)
{
  laplacian l = laplacian_times(fine, tau);
  int done = fine->periodic[1] ? fine->rows - 1 : 0;
  prolong_rows(coarse, fine, 0, done);
  for (int j = 0; j < fine->rows + 2; j += 2) {
    if (done < j + 1) {
      prolong_rows(coarse, fine, done + 1, j + 1);
      done = j + 1;
    }
    sweep_rows(fine, j, &l, linear, masked);
  }
}

static void prolong_smooth(const fg__level *coarse, const fg__level *fine, float tau)
{
  if (fine->mass)
    ascend(coarse, fine, tau, false, true);
  else
    ascend(coarse, fine, tau, false, false);
}

static void prolong_smooth_linear(const fg__level *coarse, const fg__level *fine,
                                  float tau)
{
  if (fine->mass)
    ascend(coarse, fine, tau, true, true);
  else
    ascend(coarse, fine, tau, true, false);
}

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
      u[n] += mass[n] > 0.0F ? amount : 0.0F;
  } else {
    INDEPENDENT
    for (ptrdiff_t n = -level->first; n < size; ++n)
      u[n] += amount;
  }
}

const fg__kernel FG__KERNEL = {.name = FG__KERNEL_NAME,
                               .smooth = smooth,
                               .smooth_linear = smooth_linear,
                               .smooth_restrict = smooth_restrict,
                               .smooth_restrict_linear = smooth_restrict_linear,
                               .prolong_smooth = prolong_smooth,
                               .prolong_smooth_linear = prolong_smooth_linear,
                               .prolong_array = prolong_array,
                               .restrict_defect = restrict_defect,
                               .evaluate = evaluate,
                               .changes = changes,
                               .extrapolate = extrapolate,
                               .shift = shift};
