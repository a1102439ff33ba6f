#include "evolve/multigrid.h"

#include <string.h>

fg__array_shape fg__multigrid_shape(const fg__multigrid *multigrid, int depth)
{
  if (multigrid->spread_count > 0)
    return (fg__array_shape){.size = multigrid->spread[depth].size};
  const fg__layout *layout = &multigrid->level[depth].layout;
  return (fg__array_shape){layout->array_size, layout->first};
}

float *fg__multigrid_u(const fg__multigrid *multigrid)
{
  return multigrid->spread_count > 0 ? multigrid->spread[0].u : multigrid->level[0].u;
}

float *fg__multigrid_w(const fg__multigrid *multigrid)
{
  return multigrid->spread_count > 0 ? multigrid->spread[0].w : multigrid->level[0].w;
}

float *fg__multigrid_p(const fg__multigrid *multigrid)
{
  return multigrid->spread_count > 0 ? multigrid->spread[0].p : multigrid->level[0].p;
}

void fg__multigrid_use(fg__multigrid *multigrid, float *u)
{
  fg__spread *finest = &multigrid->spread[0];
  if (multigrid->spread_count > 0)
    fg__spread_use(finest, u, finest->w, finest->p);
  else
    multigrid->level[0].u = u;
}

const fg__level *fg__multigrid_boxes(const fg__multigrid *multigrid, int *count,
                                     const ptrdiff_t **offset)
{
  static const ptrdiff_t none = 0;
  bool spread = multigrid->spread_count > 0;
  *count = spread ? multigrid->spread[0].count : 1;
  *offset = spread ? multigrid->spread[0].offset : &none;
  return spread ? multigrid->spread[0].box : multigrid->level;
}

static fg__level *boxes_of(fg__multigrid *multigrid, int *count)
{
  bool spread = multigrid->spread_count > 0;
  *count = spread ? multigrid->spread[0].count : 1;
  return spread ? multigrid->spread[0].box : multigrid->level;
}

void fg__multigrid_leave_wells(fg__multigrid *multigrid, const fg__no_wells *instead)
{
  int count;
  fg__level *box = boxes_of(multigrid, &count);
  multigrid->linear = instead;
  for (int b = 0; b < count; ++b) {
    ptrdiff_t offset = multigrid->spread_count > 0 ? multigrid->spread[0].offset[b] : 0;
    float *zero = instead ? instead->zeros + offset : NULL;
    float *one = instead ? instead->ones + offset : NULL;
    box[b].q = box[b].curvature = box[b].shape_curvature = zero;
    box[b].coupling = box[b].scale = box[b].scale_inverse = one;
    box[b].relaxation = instead ? instead->relaxation + offset : NULL;
  }
}

void fg__multigrid_weigh_gradient(fg__multigrid *multigrid, double weight)
{
  int count;
  fg__level *box = boxes_of(multigrid, &count);
  for (int b = 0; b < count; ++b)
    box[b].gradient_weight = weight;
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
  const fg__spread *image = &multigrid->spread[multigrid->spread_count];
  const fg__level *whole = &multigrid->level[0];
  fg__share alone = fg__alone();
  float *const sent[] = {image->p, image->q, image->coupling, image->shape_curvature};
  float *const received[] = {whole->p, whole->q, whole->coupling, whole->shape_curvature};
  float *const *boxes[FG__MOST_EXCHANGED];
  fg__spread_pointers(image, FG__RESTRICTED, sent, boxes);
  fg__gather_fill(multigrid->gather, FG__RESTRICTED, boxes, received);
  float *const solution[] = {whole->u, whole->w};
  for (int n = 0; n < 2; ++n)
    memset(solution[n] - whole->layout.first, 0,
           whole->layout.array_size * sizeof(float));
  find_space(multigrid, 0, now->tau, &alone);
  cycle_whole(multigrid, now, &alone);
  multigrid->kernel->unscale(whole, &alone);
  float *const places[] = {image->u, image->w};
  fg__spread_pointers(image, 2, places, boxes);
  fg__gather_return(multigrid->gather, 2, solution, boxes);
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
  if (multigrid->spread_count > 0)
    memcpy(to, from, multigrid->spread[0].size * sizeof *to);
  else
    copy_rows(&multigrid->level[0], from, to, share);
  fg__team_barrier(share);
}

/* Of a linear finest level. */
static void find_relaxation(const fg__multigrid *multigrid, float tau,
                            const fg__share *share)
{
  const fg__kernel *kernel = multigrid->kernel;
  if (multigrid->spread_count == 0)
    kernel->find_relaxation(&multigrid->level[0], tau, share);
  for (int b = 0; multigrid->spread_count > 0 && b < multigrid->spread[0].count; ++b)
    kernel->find_relaxation(&multigrid->spread[0].box[b], tau, share);
}

void fg__multigrid_solve(const fg__multigrid *multigrid, double tau, int cycles,
                         float *before, const fg__share *share)
{
  turn now = {.tau = (float)tau};
  if (multigrid->linear)
    find_relaxation(multigrid, now.tau, share);
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
