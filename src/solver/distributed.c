#include "solver/distributed.h"

#include <stdint.h>
#include <string.h>

void fg__distributed_exchange(const fg__distributed *level, int count,
                              float *const array[], unsigned colours)
{
  fg__exchange_fill(level->exchange, count, array, colours);
}

/* The end slices of so many arrays, for the neighbours named by the set of slices. */
static void pass_slices(const fg__distributed *level, int count, float *const array[],
                        unsigned slices)
{
  const fg__level *block = &level->block;
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
    run[runs++] = (fg__run){level->sent, level->received,
                            FG__RESTRICTED * (size_t)fg__gathered_floats(block), true};
  fg__slabs_exchange(&level->slabs, run, runs);
}

void fg__distributed_exchange_ends(const fg__distributed *level, int count,
                                   float *const array[])
{
  if (level->in_slabs)
    pass_slices(level, count, array, FG__FIRST_SLICE | FG__LAST_SLICE);
  else
    fg__distributed_exchange(level, count, array, FG__ALL_COLOURS);
}

/* What a single thread, whose neighbours are other ranks, sends them. */
static void exchange_slices(void *argument, unsigned slices)
{
  const fg__distributed *level = argument;
  float *const both[] = {level->block.u, level->block.w};
  bool solution = slices & (FG__FIRST_SLICE | FG__LAST_SLICE);
  pass_slices(level, solution ? 2 : 0, both, slices);
}

fg__thread fg__distributed_share(const fg__distributed *level)
{
  return (fg__thread){
      .count = 1, .exchange = exchange_slices, .argument = (void *)(uintptr_t)level};
}

static void smooth(const fg__distributed *level, const fg__kernel *kernel, float tau,
                   bool linear)
{
  float *const both[] = {level->block.u, level->block.w};
  for (int rows = 0; rows < 1 << (kernel->dimension - 1); ++rows) {
    const unsigned colours = 3U << (2 * rows); /* even and odd columns */
    kernel->smooth_rows_of(&level->block, tau, linear, rows);
    fg__distributed_exchange(level, 2, both, colours);
  }
}

static void clear_solution(const fg__level *level)
{
  float *const both[] = {level->u, level->w};
  for (int n = 0; n < 2; ++n)
    memset(both[n] - level->layout.first, 0, level->layout.array_size * sizeof **both);
}

void fg__distributed_descend(const fg__distributed *fine, const fg__distributed *coarse,
                             const fg__kernel *kernel, float tau, bool linear)
{
  if (linear)
    smooth(fine, kernel, tau, true);
  kernel->find_residuals(&fine->block, tau, linear, fine->residual);
  fg__distributed_exchange(fine, FG__RESTRICTED, fine->residual, FG__ALL_COLOURS);
  const float *from[FG__RESTRICTED];
  for (int n = 0; n < FG__RESTRICTED; ++n)
    from[n] = fine->residual[n];
  kernel->restrict_arrays(&fine->block, from, &coarse->block);
  clear_solution(&coarse->block);
}

void fg__distributed_ascend(const fg__distributed *coarse, const fg__distributed *fine,
                            const fg__kernel *kernel, float tau, bool linear)
{
  float *const both[] = {fine->block.u, fine->block.w};
  kernel->correct(&coarse->block, &fine->block, linear);
  fg__distributed_exchange(fine, 2, both, FG__ALL_COLOURS);
  smooth(fine, kernel, tau, linear);
}
