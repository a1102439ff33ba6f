#include "evolve/passes.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* What a pass works on; each uses what it needs. */
typedef struct pass {
  const fg__multigrid *multigrid;
  const float *from, *a, *b, *c;
  float *to;
  double number;
  int cycles;
  fg__sums sums[FG__MOST_MEMBERS];
  fg__changes changes[FG__MOST_MEMBERS];
} pass;

static const fg__level *finest(const pass *p)
{
  return &p->multigrid->level[0];
}

static void run(pass *p, fg__team_work *work)
{
  fg__team_run(p->multigrid->shared_levels > 0 ? p->multigrid->team : NULL, work, p);
}

/* What several boxes share is worked on box by box, and sums are added up over ranks. */
static bool is_spread(const fg__multigrid *multigrid)
{
  return multigrid->spread_count > 0;
}

static void add_over_ranks(const fg__multigrid *multigrid, double *const sums[],
                           const double rounding[], int count)
{
  enum { MOST_SUMS = 4 };
  uint64_t units[MOST_SUMS];
  for (int n = 0; n < count; ++n)
    units[n] = fg__level_units(*sums[n], rounding[n], multigrid->ranks->count);
  fg__ranks_add(multigrid->ranks, units, count);
  for (int n = 0; n < count; ++n)
    *sums[n] = fg__level_sum(units[n], rounding[n]);
}

static double node_count(const fg__spread *spread)
{
  const int *nodes = spread->partition.nodes;
  return (double)nodes[0] * nodes[1] * nodes[2];
}

static void copy(void *argument, const fg__share *share)
{
  const pass *p = argument;
  fg__multigrid_copy(p->multigrid, p->from, p->to, share);
}

void fg__pass_fill_ghosts(const fg__multigrid *multigrid, float *u)
{
  if (is_spread(multigrid))
    fg__spread_exchange(&multigrid->spread[0], 1, &u, FG__ALL_COLOURS);
  else
    fg__fill_ghosts(&multigrid->level[0], u);
}

void fg__pass_copy(const fg__multigrid *multigrid, const float *from, float *to)
{
  pass p = {.multigrid = multigrid, .from = from, .to = to};
  run(&p, copy);
}

static void solve(void *argument, const fg__share *share)
{
  const pass *p = argument;
  fg__multigrid_solve(p->multigrid, p->number, p->cycles, p->to, share);
}

void fg__pass_solve(const fg__multigrid *multigrid, double tau, int cycles, float *before)
{
  pass p = {.multigrid = multigrid, .to = before, .number = tau, .cycles = cycles};
  run(&p, solve);
}

static void evaluate(void *argument, const fg__share *share)
{
  pass *p = argument;
  p->sums[share->member] =
      p->multigrid->kernel->evaluate(finest(p), p->from, p->to, share);
}

static fg__sums evaluate_spread(const fg__multigrid *multigrid, const float *u, float *w)
{
  const fg__spread *spread = &multigrid->spread[0];
  fg__share alone = fg__alone();
  fg__sums total = {0.0, 0.0};
  double rounding = fg__level_rounding(node_count(spread));
  for (int b = 0; b < spread->count; ++b) {
    ptrdiff_t at = spread->offset[b];
    fg__sums sums = multigrid->kernel->evaluate(&spread->box[b], u + at, w + at, &alone);
    total.energy += sums.energy;
    total.u += sums.u;
  }
  fg__spread_exchange(spread, 1, &w, FG__ALL_COLOURS);
  /* halves of exact sums */
  add_over_ranks(multigrid, (double *const[]){&total.energy, &total.u},
                 (const double[]){0.5 * rounding, rounding}, 2);
  return total;
}

fg__sums fg__pass_evaluate(const fg__multigrid *multigrid, const float *u, float *w)
{
  if (is_spread(multigrid))
    return evaluate_spread(multigrid, u, w);
  pass p = {.multigrid = multigrid, .from = u, .to = w};
  run(&p, evaluate);
  fg__sums total = {0.0, 0.0};
  for (int n = 0; n < FG__MOST_MEMBERS; ++n) {
    total.energy += p.sums[n].energy;
    total.u += p.sums[n].u;
  }
  return total;
}

static void explicit_part(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->explicit_part(finest(p), p->from, p->a, (float)p->number,
                                      finest(p)->p, share);
}

void fg__pass_explicit_part(const fg__multigrid *multigrid, const float *u,
                            const float *w, double tau)
{
  if (is_spread(multigrid)) {
    const fg__spread *spread = &multigrid->spread[0];
    fg__share alone = fg__alone();
    for (int b = 0; b < spread->count; ++b) {
      ptrdiff_t at = spread->offset[b];
      multigrid->kernel->explicit_part(&spread->box[b], u + at, w + at, (float)tau,
                                       spread->p + at, &alone);
    }
    return;
  }
  pass p = {.multigrid = multigrid, .from = u, .a = w, .number = tau};
  run(&p, explicit_part);
}

static void subtract_wells(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->subtract_wells(finest(p), p->from, p->to, share);
}

void fg__pass_subtract_wells(const fg__multigrid *multigrid, const float *u, float *w)
{
  if (is_spread(multigrid)) {
    const fg__spread *spread = &multigrid->spread[0];
    fg__share alone = fg__alone();
    for (int b = 0; b < spread->count; ++b)
      multigrid->kernel->subtract_wells(&spread->box[b], u + spread->offset[b],
                                        w + spread->offset[b], &alone);
    return;
  }
  pass p = {.multigrid = multigrid, .from = u, .to = w};
  run(&p, subtract_wells);
}

static void changes(void *argument, const fg__share *share)
{
  pass *p = argument;
  p->changes[share->member] =
      p->multigrid->kernel->changes(finest(p), p->from, p->a, p->b, p->c, share);
}

static fg__changes changes_spread(const fg__multigrid *multigrid, const float *u,
                                  const float *a, const float *b, const float *c)
{
  const fg__spread *spread = &multigrid->spread[0];
  fg__share alone = fg__alone();
  fg__changes total = {0.0, 0.0, 0.0, 0.0};
  double rounding = fg__level_rounding(node_count(spread));
  double fine = fg__level_change_rounding(node_count(spread));
  for (int n = 0; n < spread->count; ++n) {
    ptrdiff_t at = spread->offset[n];
    fg__changes part = multigrid->kernel->changes(&spread->box[n], u + at, a + at, b + at,
                                                  c + at, &alone);
    total.u += part.u;
    total.from_a += part.from_a;
    total.from_b += part.from_b;
    total.along += part.along;
  }
  add_over_ranks(multigrid,
                 (double *const[]){&total.u, &total.from_a, &total.from_b, &total.along},
                 (const double[]){rounding, fine, fine, fine}, 4);
  return total;
}

fg__changes fg__pass_changes(const fg__multigrid *multigrid, const float *u,
                             const float *a, const float *b, const float *c)
{
  if (is_spread(multigrid))
    return changes_spread(multigrid, u, a, b, c);
  pass p = {.multigrid = multigrid, .from = u, .a = a, .b = b, .c = c};
  run(&p, changes);
  fg__changes total = {0.0, 0.0, 0.0, 0.0};
  for (int n = 0; n < FG__MOST_MEMBERS; ++n) {
    total.u += p.changes[n].u;
    total.from_a += p.changes[n].from_a;
    total.from_b += p.changes[n].from_b;
    total.along += p.changes[n].along;
  }
  return total;
}

static void shift(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->shift(finest(p), p->to, (float)p->number, share);
}

void fg__pass_shift(const fg__multigrid *multigrid, float *u, double amount)
{
  if (is_spread(multigrid)) {
    const fg__spread *spread = &multigrid->spread[0];
    fg__share alone = fg__alone();
    for (int b = 0; b < spread->count; ++b)
      multigrid->kernel->shift(&spread->box[b], u + spread->offset[b], (float)amount,
                               &alone);
    return;
  }
  pass p = {.multigrid = multigrid, .to = u, .number = amount};
  run(&p, shift);
}

static void extrapolate(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->extrapolate(finest(p), p->from, p->a, (float)p->number, p->to,
                                    share);
}

void fg__pass_extrapolate(const fg__multigrid *multigrid, const float *now,
                          const float *before, double omega, float *out)
{
  if (is_spread(multigrid)) {
    const fg__spread *spread = &multigrid->spread[0];
    fg__share alone = fg__alone();
    for (int b = 0; b < spread->count; ++b) {
      ptrdiff_t at = spread->offset[b];
      multigrid->kernel->extrapolate(&spread->box[b], now + at, before + at, (float)omega,
                                     out + at, &alone);
    }
    return;
  }
  pass p = {.multigrid = multigrid, .from = now, .a = before, .number = omega, .to = out};
  run(&p, extrapolate);
}

static void predict(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->predict(finest(p), p->from, p->a, (float)p->number, p->to, share);
}

void fg__pass_predict(const fg__multigrid *multigrid, const float *now,
                      const float *before, double omega, float *out)
{
  if (is_spread(multigrid)) {
    const fg__spread *spread = &multigrid->spread[0];
    fg__share alone = fg__alone();
    for (int b = 0; b < spread->count; ++b) {
      ptrdiff_t at = spread->offset[b];
      multigrid->kernel->predict(&spread->box[b], now + at, before + at, (float)omega,
                                 out + at, &alone);
    }
    return;
  }
  pass p = {.multigrid = multigrid, .from = now, .a = before, .number = omega, .to = out};
  run(&p, predict);
}
