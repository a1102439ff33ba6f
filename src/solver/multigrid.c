#include "solver/multigrid.h"

#include <string.h>

static const fg__level *level_at(const fg__multigrid *multigrid, int depth)
{
  return multigrid->spread_count > 0 ? &multigrid->spread[depth].block
                                     : &multigrid->level[depth];
}

static fg__level *finest_of(fg__multigrid *multigrid)
{
  return multigrid->spread_count > 0 ? &multigrid->spread[0].block : multigrid->level;
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

void fg__multigrid_leave_wells(fg__multigrid *multigrid, const fg__no_wells *instead)
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

/* Whether whole level n is the finest, with its wells. */
static bool nonlinear(const fg__multigrid *multigrid, int n)
{
  return n == 0 && multigrid->spread_count == 0 && !multigrid->linear;
}

/* One of several cycles: what the last one has done for it, and whether it shall do so
 * for a next. */
typedef struct turn {
  float tau;
  bool restricted, more;
} turn;

static void find_space(const fg__multigrid *multigrid, int n, float tau,
                       const fg__share *share)
{
  multigrid->kernel->find_scale(&multigrid->level[n], share);
  multigrid->kernel->find_curvature(&multigrid->level[n], tau, share);
}

static void descend(const fg__multigrid *multigrid, int n, const turn *now,
                    const fg__share *share)
{
  const fg__level *level = &multigrid->level[n];
  if (!nonlinear(multigrid, n))
    multigrid->kernel->smooth_restrict_linear(level, level + 1, now->tau, share);
  else if (!now->restricted)
    multigrid->kernel->restrict_residuals(level, level + 1, now->tau, share);
  find_space(multigrid, n + 1, now->tau, share);
}

static void ascend(const fg__multigrid *multigrid, int n, const turn *now,
                   const fg__share *share)
{
  const fg__kernel *kernel = multigrid->kernel;
  const fg__level *level = &multigrid->level[n];
  kernel->unscale(level + 1, share);
  if (!nonlinear(multigrid, n))
    kernel->correct_smooth_linear(level + 1, level, now->tau, share);
  else if (now->more)
    kernel->correct_smooth_restrict(level + 1, level, now->tau, share);
  else
    kernel->correct_smooth(level + 1, level, now->tau, share);
}

/* Levels n and coarser, by one thread. */
static void cycle_alone(const fg__multigrid *multigrid, int n, const turn *now)
{
  const fg__kernel *kernel = multigrid->kernel;
  int last = multigrid->level_count - 1;
  fg__share alone = fg__alone();
  for (int m = n; m < last; ++m)
    descend(multigrid, m, now, &alone);
  for (int sweep = 0; sweep < multigrid->coarsest_sweeps; ++sweep)
    if (nonlinear(multigrid, last)) /* too small a mesh to coarsen */
      kernel->smooth(&multigrid->level[0], now->tau, &alone);
    else
      kernel->smooth_linear(&multigrid->level[last], now->tau, &alone);
  for (int m = last - 1; m >= n; --m)
    ascend(multigrid, m, now, &alone);
}

/* The whole levels, alike on all ranks. */
static void cycle_whole(const fg__multigrid *multigrid, const turn *now,
                        const fg__share *share)
{
  int last = multigrid->level_count - 1;
  int shared = multigrid->shared_levels < last ? multigrid->shared_levels : last;
  for (int n = 0; n < shared; ++n)
    descend(multigrid, n, now, share);
  if (share->member == 0)
    cycle_alone(multigrid, shared, now);
  fg__team_barrier(share);
  for (int n = shared - 1; n >= 0; --n)
    ascend(multigrid, n, now, share);
}

/* From what the ranks share to level[0] and back. */
static void cycle_gathered(const fg__multigrid *multigrid, const turn *now)
{
  const fg__level *image = &multigrid->spread[multigrid->spread_count].block;
  const fg__level *whole = &multigrid->level[0];
  fg__share alone = fg__alone();
  float *const sent[] = {image->p, image->q, image->coupling, image->shape_curvature};
  float *const received[] = {whole->p, whole->q, whole->coupling, whole->shape_curvature};
  fg__gather_fill(multigrid->gather, FG__RESTRICTED, sent, received);
  float *const solution[] = {whole->u, whole->w};
  for (int n = 0; n < 2; ++n)
    memset(solution[n] - whole->layout.first, 0,
           whole->layout.array_size * sizeof(float));
  find_space(multigrid, 0, now->tau, &alone);
  cycle_whole(multigrid, now, &alone);
  multigrid->kernel->unscale(whole, &alone);
  float *const own[] = {image->u, image->w};
  fg__gather_return(multigrid->gather, 2, solution, own);
}

static void cycle_spread(const fg__multigrid *multigrid, turn *now)
{
  const fg__kernel *kernel = multigrid->kernel;
  const fg__spread *spread = multigrid->spread;
  int count = multigrid->spread_count;
  for (int n = 0; n < count; ++n) {
    if (n > 0 || !now->restricted)
      fg__spread_descend(&spread[n], &spread[n + 1], kernel, now->tau,
                         n > 0 || multigrid->linear);
    if (n + 1 < count)
      fg__spread_find_space(&spread[n + 1], kernel, now->tau);
  }
  cycle_gathered(multigrid, now);
  for (int n = count - 1; n >= 0; --n) {
    if (n + 1 < count)
      fg__spread_unscale(&spread[n + 1], kernel);
    now->restricted = fg__spread_ascend(&spread[n + 1], &spread[n], kernel, now->tau,
                                        n > 0 || multigrid->linear, n == 0 && now->more);
  }
}

/* A member's share of an array's rows. */
static void copy_rows(const fg__level *level, const float *from, float *to,
                      const fg__share *share)
{
  int rows = (int)((ptrdiff_t)level->layout.array_size / level->layout.stride);
  int begin, end;
  fg__team_part(share, rows, 1, &begin, &end);
  ptrdiff_t at = begin * level->layout.stride - level->layout.first;
  memcpy(to + at, from + at,
         (size_t)(end - begin) * (size_t)level->layout.stride * sizeof *to);
}

void fg__multigrid_copy(const fg__multigrid *multigrid, const float *from, float *to,
                        const fg__share *share)
{
  copy_rows(fg__multigrid_finest(multigrid), from, to, share);
  fg__team_barrier(share);
}

void fg__multigrid_solve(const fg__multigrid *multigrid, double tau, int cycles,
                         float *before, const fg__share *share)
{
  turn now = {.tau = (float)tau};
  if (multigrid->linear)
    multigrid->kernel->find_relaxation(fg__multigrid_finest(multigrid), now.tau, share);
  for (int n = 1; n <= cycles; ++n) {
    now.more = n < cycles;
    if (before && n == cycles)
      fg__multigrid_copy(multigrid, fg__multigrid_u(multigrid), before, share);
    if (multigrid->spread_count > 0) {
      fg__traffic_book *book = multigrid->ranks->book;
      fg_activity activity = fg__traffic_begin(book, FG_ACTIVITY_CYCLES);
      cycle_spread(multigrid, &now);
      fg__traffic_return(book, activity);
    } else {
      cycle_whole(multigrid, &now, share);
      now.restricted = now.more;
    }
  }
}
