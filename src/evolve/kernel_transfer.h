/* Between levels: restriction and prolongation, fused with sweeps. Part of kernel_body.h.
 */
#ifndef FG__KERNEL_TRANSFER_H
#define FG__KERNEL_TRANSFER_H

#include <string.h>

#include "evolve/kernel_sweep.h"

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

#endif
