#include "solver/multigrid.h"

#include <string.h>

static const fg__level *level_at(const fg__multigrid *multigrid, int depth)
{
  return multigrid->distributed_count > 0 ? &multigrid->distributed[depth].block
                                          : &multigrid->level[depth];
}

static fg__level *finest_of(fg__multigrid *multigrid)
{
  return multigrid->distributed_count > 0 ? &multigrid->distributed[0].block
                                          : multigrid->level;
}

const fg__level *fg__multigrid_finest(const fg__multigrid *multigrid)
{
  return level_at(multigrid, 0);
}

fg__array_shape fg__multigrid_shape(const fg__multigrid *multigrid, int depth)
{
  const fg__layout *layout = &level_at(multigrid, depth)->layout;
  return (fg__array_shape){layout->array_size, layout->first};
}

float *fg__multigrid_u(const fg__multigrid *multigrid)
{
  return level_at(multigrid, 0)->u;
}

float *fg__multigrid_w(const fg__multigrid *multigrid)
{
  return level_at(multigrid, 0)->w;
}

float *fg__multigrid_p(const fg__multigrid *multigrid)
{
  return level_at(multigrid, 0)->p;
}

void fg__multigrid_use(fg__multigrid *multigrid, float *u)
{
  finest_of(multigrid)->u = u;
}

void fg__multigrid_linearise(fg__multigrid *multigrid, const fg__linear_terms *instead)
{
  fg__level *level = finest_of(multigrid);
  multigrid->linear = instead;
  float *zero = instead ? instead->zeros : NULL, *one = instead ? instead->ones : NULL;
  level->q = level->curvature = level->shape_curvature = zero;
  level->coupling = level->scale = level->scale_inverse = one;
  level->relaxation = instead ? instead->relaxation : NULL;
}

void fg__multigrid_weigh_gradient(fg__multigrid *multigrid, double weight)
{
  finest_of(multigrid)->gradient_weight = weight;
}

fg__energies fg__multigrid_no_energies(float *zeros)
{
  fg__energies none = {.level = {{.center = zeros}}};
  for (int k = 0; k < FG__MOST_COUPLINGS; ++k)
    none.level[0].to[k] = zeros;
  for (int n = 0; n < FG__MOST_LEVELS; ++n)
    none.distributed[n] = none.level[n] = none.level[0];
  return none;
}

static void exchange_energy(fg__level *level, fg__stencil *other)
{
  fg__stencil own = level->energy;
  level->energy = *other;
  *other = own;
}

void fg__multigrid_exchange_energies(fg__multigrid *multigrid, fg__energies *other)
{
  for (int n = 0; n < multigrid->distributed_count; ++n)
    exchange_energy(&multigrid->distributed[n].block, &other->distributed[n]);
  for (int n = 0; n < multigrid->level_count; ++n)
    exchange_energy(&multigrid->level[n], &other->level[n]);
}

/* Whether replicated level n is the finest, with its double well. */
static bool nonlinear(const fg__multigrid *multigrid, int n)
{
  return n == 0 && multigrid->distributed_count == 0 && !multigrid->linear;
}

/* State of a cycle among several. */
typedef struct cycle_state {
  float tau;
  bool restricted; /* the last cycle has restricted the finest level's residuals */
  bool more;       /* a cycle follows, for which this one restricts them */
} cycle_state;

/* Makes a coarse level's system from the restricted quantities. */
static void find_space(const fg__multigrid *multigrid, const fg__level *level, float tau,
                       const fg__thread *thread)
{
  multigrid->kernel->find_scale(level, thread);
  multigrid->kernel->find_curvature(level, tau, thread);
}

/* Restricts to the coarse level; its u and w become 0. A linear level is swept first. */
static void descend(const fg__multigrid *multigrid, const fg__level *fine,
                    const fg__level *coarse, bool linear, const cycle_state *now,
                    const fg__thread *thread)
{
  const fg__kernel *kernel = multigrid->kernel;
  if (linear)
    kernel->smooth_restrict_linear(fine, coarse, now->tau, thread);
  else if (!now->restricted)
    kernel->restrict_residuals(fine, coarse, now->tau, thread);
}

/* The coarse level's correction; then a sweep, and perhaps the next restriction. */
static void ascend(const fg__multigrid *multigrid, const fg__level *coarse,
                   const fg__level *fine, bool linear, const cycle_state *now,
                   const fg__thread *thread)
{
  const fg__kernel *kernel = multigrid->kernel;
  if (linear)
    kernel->correct_smooth_linear(coarse, fine, now->tau, thread);
  else if (now->more)
    kernel->correct_smooth_restrict(coarse, fine, now->tau, thread);
  else
    kernel->correct_smooth(coarse, fine, now->tau, thread);
}

/* The same for level n of the replicated ones. */
static void go_down(const fg__multigrid *multigrid, int n, const cycle_state *now,
                    const fg__thread *thread)
{
  const fg__level *level = &multigrid->level[n];
  descend(multigrid, level, level + 1, !nonlinear(multigrid, n), now, thread);
  find_space(multigrid, level + 1, now->tau, thread);
}

static void go_up(const fg__multigrid *multigrid, int n, const cycle_state *now,
                  const fg__thread *thread)
{
  const fg__level *level = &multigrid->level[n];
  multigrid->kernel->unscale(level + 1, thread);
  ascend(multigrid, level + 1, level, !nonlinear(multigrid, n), now, thread);
}

/* Levels n and coarser, by one thread. */
static void cycle_alone(const fg__multigrid *multigrid, int n, const cycle_state *now)
{
  const fg__kernel *kernel = multigrid->kernel;
  int last = multigrid->level_count - 1;
  fg__thread alone = fg__single_thread();
  for (int m = n; m < last; ++m)
    go_down(multigrid, m, now, &alone);
  for (int sweep = 0; sweep < multigrid->coarsest_sweeps; ++sweep)
    if (nonlinear(multigrid, last)) /* too small a mesh to coarsen */
      kernel->smooth(&multigrid->level[0], now->tau, &alone);
    else
      kernel->smooth_linear(&multigrid->level[last], now->tau, &alone);
  for (int m = last - 1; m >= n; --m)
    go_up(multigrid, m, now, &alone);
}

/* The replicated levels, alike on all ranks: of a process alone all of them. */
static void cycle_replicated(const fg__multigrid *multigrid, const cycle_state *now,
                             const fg__thread *thread)
{
  int last = multigrid->level_count - 1;
  int shared = multigrid->threaded_levels < last ? multigrid->threaded_levels : last;
  for (int n = 0; n < shared; ++n)
    go_down(multigrid, n, now, thread);
  if (thread->index == 0)
    cycle_alone(multigrid, shared, now);
  fg__threads_barrier(thread);
  for (int n = shared - 1; n >= 0; --n)
    go_up(multigrid, n, now, thread);
}

/* From the blocks to level[0] and back. */
static void cycle_gathered(const fg__multigrid *multigrid, const cycle_state *now)
{
  const fg__level *block = &multigrid->distributed[multigrid->distributed_count].block;
  const fg__level *replicated = &multigrid->level[0];
  fg__thread alone = fg__single_thread();
  float *const sent[] = {block->p, block->q, block->coupling, block->shape_curvature};
  float *const received[] = {replicated->p, replicated->q, replicated->coupling,
                             replicated->shape_curvature};
  fg__gather_fill(multigrid->gather, FG__RESTRICTED, sent, received);
  float *const solution[] = {replicated->u, replicated->w};
  for (int n = 0; n < 2; ++n)
    memset(solution[n] - replicated->layout.first, 0,
           replicated->layout.array_size * sizeof(float));
  find_space(multigrid, replicated, now->tau, &alone);
  cycle_replicated(multigrid, now, &alone);
  multigrid->kernel->unscale(replicated, &alone);
  float *const own[] = {block->u, block->w};
  fg__gather_return(multigrid->gather, 2, solution, own);
}

/* The same as find_space for a block, whose neighbours' scales are needed between. */
static void find_space_of_block(const fg__multigrid *multigrid,
                                const fg__distributed *level, float tau)
{
  float *const both[] = {level->block.scale, level->block.scale_inverse};
  fg__thread alone = fg__single_thread();
  multigrid->kernel->find_scale(&level->block, &alone);
  fg__distributed_exchange_ends(level, 2, both);
  multigrid->kernel->find_curvature(&level->block, tau, &alone);
}

/* An idle rank only shares the work on replicated levels, which all do alike. */
static void cycle_distributed(const fg__multigrid *multigrid, cycle_state *now)
{
  if (fg__is_idle(&multigrid->partition)) {
    cycle_gathered(multigrid, now);
    return;
  }
  const fg__kernel *kernel = multigrid->kernel;
  const fg__distributed *level = multigrid->distributed;
  int count = multigrid->distributed_count;
  fg__thread alone = fg__single_thread();
  for (int n = 0; n < count; ++n) {
    bool linear = n > 0 || multigrid->linear;
    fg__thread thread = fg__distributed_share(&level[n]);
    if (level[n].in_slabs)
      descend(multigrid, &level[n].block, &level[n + 1].block, linear, now, &thread);
    else
      fg__distributed_descend(&level[n], &level[n + 1], kernel, now->tau, linear);
    if (n + 1 < count)
      find_space_of_block(multigrid, &level[n + 1], now->tau);
  }
  cycle_gathered(multigrid, now);
  for (int n = count - 1; n >= 0; --n) {
    bool linear = n > 0 || multigrid->linear;
    fg__thread thread = fg__distributed_share(&level[n]);
    if (n + 1 < count)
      kernel->unscale(&level[n + 1].block, &alone);
    if (level[n].in_slabs)
      ascend(multigrid, &level[n + 1].block, &level[n].block, linear, now, &thread);
    else
      fg__distributed_ascend(&level[n + 1], &level[n], kernel, now->tau, linear);
  }
  now->restricted = now->more && level[0].in_slabs && !multigrid->linear;
}

/* A thread's share of an array's rows. */
static void copy_rows(const fg__level *level, const float *from, float *to,
                      const fg__thread *thread)
{
  int rows = (int)((ptrdiff_t)level->layout.array_size / level->layout.stride);
  int begin, end;
  fg__threads_range(thread, rows, 1, &begin, &end);
  ptrdiff_t at = begin * level->layout.stride - level->layout.first;
  memcpy(to + at, from + at,
         (size_t)(end - begin) * (size_t)level->layout.stride * sizeof *to);
}

void fg__multigrid_copy(const fg__multigrid *multigrid, const float *from, float *to,
                        const fg__thread *thread)
{
  copy_rows(fg__multigrid_finest(multigrid), from, to, thread);
  fg__threads_barrier(thread);
}

void fg__multigrid_solve(const fg__multigrid *multigrid, double tau, int cycles,
                         float *before, const fg__thread *thread)
{
  cycle_state now = {.tau = (float)tau};
  if (multigrid->linear && !fg__is_idle(&multigrid->partition))
    multigrid->kernel->find_relaxation(fg__multigrid_finest(multigrid), now.tau, thread);
  for (int n = 1; n <= cycles; ++n) {
    now.more = n < cycles;
    if (before && n == cycles)
      fg__multigrid_copy(multigrid, fg__multigrid_u(multigrid), before, thread);
    if (multigrid->distributed_count > 0) {
      fg__counters *counters = multigrid->ranks->counters;
      fg_phase phase = fg__phase_begin(counters, FG_PHASE_CYCLES);
      cycle_distributed(multigrid, &now);
      fg__phase_return(counters, phase);
    } else {
      cycle_replicated(multigrid, &now, thread);
      now.restricted = now.more;
    }
  }
}
