/* The stencils on both colours of a row at once, block by block of vectors, so that each
 * neighbour and each coupling is loaded once for both. Part of solver/kernel/body.h.
 *
 * Even column k lies between the odd columns k - 1 and k, odd column k between the even
 * columns k and k + 1. What the rows round a row give to its block of even columns is
 * known once the block's own columns are, but for what the odd columns of the block
 * before give to the first one (kept from there); odd columns also need the even ones of
 * the block after. So a row is gone through with the odd columns one block behind. */
#ifndef FG__KERNEL_ROW_H
#define FG__KERNEL_ROW_H

#include "solver/kernel/stencil.h"

/* An array's values on a row and those round it: where their even columns begin. */
typedef struct neighbours {
  const float *own, *upper[UPPER_ROWS], *lower[UPPER_ROWS];
} neighbours;

INLINE neighbours neighbours_round(const fg__level *level, const float *array,
                                   ptrdiff_t at)
{
  neighbours x = {.own = array + at};
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    x.upper[r] = x.own + upper_row(level, r);
    x.lower[r] = x.own - upper_row(level, r);
  }
  return x;
}

/* The same where the slices before, at and after the row's are apart. */
INLINE neighbours neighbours_of_slices(const fg__level *level,
                                       const float *const slice[3], ptrdiff_t row)
{
  neighbours x = {.own = slice[1] + row};
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    bool within = FG__DIMENSION == 3 && r == 0;
    ptrdiff_t up = FG__DIMENSION == 3 ? (r == 0 ? 1 : r - 2) * level->layout.stride : 0;
    x.upper[r] = slice[within ? 1 : 2] + row + up;
    x.lower[r] = slice[within ? 1 : 0] + row - up;
  }
  return x;
}

/* The couplings that a row's nodes hold, and those that rows below hold to them, by
 * column of the other node: 0 west, 1 middle, 2 east. */
typedef struct holders {
  const float *center, *east, *upper[UPPER_ROWS][3], *lower[UPPER_ROWS][3];
} holders;

INLINE holders holders_round(const fg__level *level, const fg__stencil *stencil,
                             ptrdiff_t at)
{
  holders c = {.center = stencil->center + at, .east = stencil->to[0] + at};
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    UNROLLED
    for (int side = 0; side < 3; ++side) {
      c.upper[r][side] = stencil->to[1 + 3 * r + side] + at;
      c.lower[r][side] = c.upper[r][side] - upper_row(level, r);
    }
  }
  return c;
}

/* Sums over the rows round a row, at a block of even and of odd columns; apart from them
 * what the odd columns give to the even ones to their east, and the even columns to the
 * odd ones to their west. */
typedef struct sums_round {
  vector even, odd, to_even, to_odd;
} sums_round;

INLINE vector over_rows(const vector x[UPPER_ROWS])
{
#if FG__DIMENSION == 3
  return x[0] + ((x[1] + x[3]) + x[2]);
#else
  return x[0];
#endif
}

/* even, odd: where the block begins in the arrays. */
INLINE sums_round couple(const holders *c, const neighbours *x, ptrdiff_t even,
                         ptrdiff_t odd)
{
  vector at_even[UPPER_ROWS], at_odd[UPPER_ROWS], to_even[UPPER_ROWS], to_odd[UPPER_ROWS];
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    const float *const *up = c->upper[r], *const *low = c->lower[r];
    const float *above = x->upper[r], *below = x->lower[r];
    vector above_even = load(above + even), above_odd = load(above + odd);
    vector below_even = load(below + even), below_odd = load(below + odd);
    at_even[r] = (load(up[1] + even) * above_even + load(low[1] + even) * below_even) +
                 ((load(up[2] + even) * above_odd + load(low[0] + odd) * below_odd) +
                  load(up[0] + even) * load(above + odd - 1));
    at_odd[r] = (load(up[1] + odd) * above_odd + load(low[1] + odd) * below_odd) +
                ((load(up[0] + odd) * above_even + load(low[2] + even) * below_even) +
                 load(up[2] + odd) * load(above + even + 1));
    to_even[r] = load(low[2] + odd) * below_odd;
    to_odd[r] = load(low[0] + even) * below_even;
  }
  return (sums_round){over_rows(at_even), over_rows(at_odd), over_rows(to_even),
                      over_rows(to_odd)};
}

/* Of the constant Laplacian, whose couplings are equal on both sides of each axis. */
INLINE vector weighted_pairs(const float weight[UPPER_ROWS],
                             const vector pair[UPPER_ROWS])
{
#if FG__DIMENSION == 3
  return weight[0] * pair[0] + (weight[1] * (pair[1] + pair[3]) + weight[2] * pair[2]);
#else
  return weight[0] * pair[0];
#endif
}

INLINE sums_round couple_constant(const laplacian *l, const neighbours *x, ptrdiff_t even,
                                  ptrdiff_t odd)
{
  vector e[UPPER_ROWS], o[UPPER_ROWS];
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r) {
    e[r] = load(x->upper[r] + even) + load(x->lower[r] + even);
    o[r] = load(x->upper[r] + odd) + load(x->lower[r] + odd);
  }
  return (sums_round){weighted_pairs(l->middle, e), weighted_pairs(l->middle, o),
                      weighted_pairs(l->side, o), weighted_pairs(l->side, e)};
}

/* What columns of rows below give to those beside them. */
INLINE vector lower_side(const holders *c, const neighbours *x, int side, ptrdiff_t at)
{
  vector of_row[UPPER_ROWS];
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r)
    of_row[r] = load(c->lower[r][side] + at) * load(x->lower[r] + at);
  return over_rows(of_row);
}

INLINE vector side_of(const laplacian *l, const neighbours *x, ptrdiff_t at)
{
  vector pair[UPPER_ROWS];
  UNROLLED
  for (int r = 0; r < UPPER_ROWS; ++r)
    pair[r] = load(x->upper[r] + at) + load(x->lower[r] + at);
  return weighted_pairs(l->side, pair);
}

/* A stencil on a row, on its way through the row's blocks. */
typedef struct strand {
  neighbours x;
  holders c;
  bool constant; /* the Laplacian, instead of couplings */
  const laplacian *l;
  sums_round now, before; /* of this block and of the one before */
} strand;

INLINE strand strand_of(const fg__level *level, const fg__stencil *stencil,
                        const laplacian *l, neighbours x, ptrdiff_t at)
{
  strand s = {.x = x, .constant = !stencil, .l = l};
  if (stencil)
    s.c = holders_round(level, stencil, at);
  return s;
}

INLINE vector east_coupling(const strand *s, ptrdiff_t at)
{
  vector constant = {0};
  return s->constant ? constant + s->l->east : load(s->c.east + at);
}

/* What the odd columns of the block that begins at `odd` give to the east. */
INLINE vector given_east(const strand *s, ptrdiff_t odd)
{
  vector sum = s->constant ? side_of(s->l, &s->x, odd) : lower_side(&s->c, &s->x, 2, odd);
  return sum + east_coupling(s, odd) * load(s->x.own + odd);
}

/* What the rows round a row give from even columns to the west. */
INLINE vector given_west(const strand *s, ptrdiff_t even)
{
  return s->constant ? side_of(s->l, &s->x, even) : lower_side(&s->c, &s->x, 0, even);
}

/* On to the block that begins at these columns. */
INLINE void advance(strand *s, ptrdiff_t even, ptrdiff_t odd)
{
  s->before = s->now;
  s->now = s->constant ? couple_constant(s->l, &s->x, even, odd)
                       : couple(&s->c, &s->x, even, odd);
  s->now.to_even += east_coupling(s, odd) * load(s->x.own + odd);
}

/* The stencil at a block's even columns, whose values are x. */
INLINE vector at_even(const strand *s, vector x, ptrdiff_t even, ptrdiff_t odd)
{
  vector sum = s->now.even + from_west(s->before.to_even, s->now.to_even);
  vector own = load(s->x.own + odd);
  if (s->constant)
    return (s->l->center * x + sum) + s->now.to_even;
  return (load(s->c.center + even) * x + load(s->c.east + even) * own) + sum;
}

/* The stencil at the odd columns, whose values are x, of the block whose sums are `from`
 * and even columns `west`; to_odd and `after` are those of the block after. */
INLINE vector at_odd(const strand *s, const sums_round *from, vector x, vector west,
                     vector to_odd, vector after, ptrdiff_t even, ptrdiff_t odd)
{
  vector sum = from->odd + from_east(from->to_odd, to_odd);
  vector east = from_east(west, after);
  if (s->constant)
    return (s->l->center * x + sum) + (from->to_odd + s->l->east * (west + east));
  return (load(s->c.center + odd) * x +
          (load(s->c.east + even) * west + load(s->c.east + odd) * east)) +
         sum;
}

/* Where a row's blocks of even and of odd columns begin. */
typedef struct block {
  ptrdiff_t even, odd;
  int evens, odds; /* of the row */
} block;

INLINE block first_block(const fg__level *level)
{
  int columns = level->layout.nodes[0];
  return (block){0, level->layout.odd_offset, (columns + 1) / 2, columns / 2};
}

INLINE void next_block(block *n)
{
  n->even += WIDTH;
  n->odd += WIDTH;
}

/* Before the first block. */
INLINE void begin(strand *s, const block *n)
{
  s->now.to_even = given_east(s, n->odd - WIDTH);
}

INLINE vector at_even_block(const strand *s, const block *n)
{
  return at_even(s, load(s->x.own + n->even), n->even, n->odd);
}

/* At the odd columns of the block before n, to which the strand has come. */
INLINE vector at_odd_before(const strand *s, const block *n)
{
  ptrdiff_t even = n->even - WIDTH, odd = n->odd - WIDTH;
  return at_odd(s, &s->before, load(s->x.own + odd), load(s->x.own + even), s->now.to_odd,
                load(s->x.own + n->even), even, odd);
}

/* The same where the block before n is the row's last: to the east of its odd columns may
 * be an even one that is a ghost. */
INLINE vector at_last_odd(const strand *s, const block *n)
{
  ptrdiff_t even = n->even - WIDTH, odd = n->odd - WIDTH;
  vector to_odd = {0}, after = {0};
  if (n->evens == n->odds && n->even == n->evens) {
    to_odd = given_west(s, n->even);
    after = load(s->x.own + n->even);
  }
  return at_odd(s, &s->now, load(s->x.own + odd), load(s->x.own + even), to_odd, after,
                even, odd);
}

#endif
