#include "solver/spread.h"

#include <string.h>

void fg__spread_exchange(const fg__spread *spread, int count, float *const array[],
                         unsigned colours)
{
  fg__exchange_fill(spread->exchange, count, array, colours);
}

/* The end slices of so many arrays, for the neighbours named by the set of slices. */
static void pass_slices(const fg__spread *spread, int count, float *const array[],
                        unsigned slices)
{
  const fg__level *block = &spread->block;
  ptrdiff_t floats = fg__slice_floats(block), end = floats * fg__slices(block);
  fg__run run[2 * FG__MOST_EXCHANGED + 1];
  int runs = 0;
  for (int a = 0; a < count; ++a) {
    /* where slice 0 begins with its ghosts */
    float *first = array[a] - block->layout.first + floats;
    if (slices & FG__FIRST_SLICE)
      run[runs++] = (fg__run){first, first + end, (size_t)floats, false};
    if (slices & FG__LAST_SLICE)
      run[runs++] = (fg__run){first + end - floats, first - floats, (size_t)floats, true};
  }
  if (slices & FG__GATHERED_SLICE)
    run[runs++] = (fg__run){spread->handed, spread->taken,
                            FG__RESTRICTED * (size_t)fg__gathered_floats(block), true};
  fg__slabs_exchange(&spread->slabs, run, runs);
}

void fg__spread_exchange_ends(const fg__spread *spread, int count, float *const array[])
{
  if (spread->in_slabs)
    pass_slices(spread, count, array, FG__FIRST_SLICE | FG__LAST_SLICE);
  else
    fg__spread_exchange(spread, count, array, FG__ALL_COLOURS);
}

/* What a member on its own, whose neighbours are other ranks, has to tell them. */
typedef struct meeting {
  const fg__spread *spread;
} meeting;

static void meet(void *argument, unsigned slices)
{
  const meeting *m = argument;
  float *const both[] = {m->spread->block.u, m->spread->block.w};
  bool solution = slices & (FG__FIRST_SLICE | FG__LAST_SLICE);
  pass_slices(m->spread, solution ? 2 : 0, both, slices);
}

static fg__share share_of(meeting *m)
{
  return (fg__share){.members = 1, .meet = meet, .argument = m};
}

static void smooth(const fg__spread *spread, const fg__kernel *kernel, float tau,
                   bool linear)
{
  float *const both[] = {spread->block.u, spread->block.w};
  for (int rows = 0; rows < 1 << (kernel->dimension - 1); ++rows) {
    const unsigned colours = 3U << (2 * rows); /* even and odd columns */
    kernel->smooth_rows_of(&spread->block, tau, linear, rows);
    fg__spread_exchange(spread, 2, both, colours);
  }
}

static void clear_solution(const fg__level *level)
{
  float *const both[] = {level->u, level->w};
  for (int n = 0; n < 2; ++n)
    memset(both[n] - level->layout.first, 0, level->layout.array_size * sizeof **both);
}

void fg__spread_descend(const fg__spread *fine, const fg__spread *coarse,
                        const fg__kernel *kernel, float tau, bool linear)
{
  if (fine->in_slabs) {
    fg__share share = share_of(&(meeting){fine});
    (linear ? kernel->smooth_restrict_linear
            : kernel->restrict_residuals)(&fine->block, &coarse->block, tau, &share);
    return;
  }
  if (linear)
    smooth(fine, kernel, tau, true);
  kernel->find_residuals(&fine->block, tau, linear, fine->residual);
  fg__spread_exchange(fine, FG__RESTRICTED, fine->residual, FG__ALL_COLOURS);
  const float *from[FG__RESTRICTED];
  for (int n = 0; n < FG__RESTRICTED; ++n)
    from[n] = fine->residual[n];
  kernel->restrict_arrays(&fine->block, from, &coarse->block);
  clear_solution(&coarse->block);
}

void fg__spread_find_space(const fg__spread *coarse, const fg__kernel *kernel, float tau)
{
  float *const both[] = {coarse->block.scale, coarse->block.scale_inverse};
  fg__share alone = fg__alone();
  kernel->find_scale(&coarse->block, &alone);
  fg__spread_exchange_ends(coarse, 2, both);
  kernel->find_curvature(&coarse->block, tau, &alone);
}

void fg__spread_unscale(const fg__spread *coarse, const fg__kernel *kernel)
{
  fg__share alone = fg__alone();
  kernel->unscale(&coarse->block, &alone);
}

bool fg__spread_ascend(const fg__spread *coarse, const fg__spread *fine,
                       const fg__kernel *kernel, float tau, bool linear, bool more)
{
  if (fine->in_slabs) {
    fg__share share = share_of(&(meeting){fine});
    more = more && !linear;
    (more     ? kernel->correct_smooth_restrict
     : linear ? kernel->correct_smooth_linear
              : kernel->correct_smooth)(&coarse->block, &fine->block, tau, &share);
    return more;
  }
  float *const both[] = {fine->block.u, fine->block.w};
  kernel->correct(&coarse->block, &fine->block, linear);
  fg__spread_exchange(fine, 2, both, FG__ALL_COLOURS);
  smooth(fine, kernel, tau, linear);
  return false;
}
