#include "solver/passes.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef struct pass pass;

/* What is done to the finest level, or to this rank's block of it. */
typedef void level_work(pass *p, const fg__level *level, const fg__thread *thread);

/* What a pass works on; each uses what it needs. */
struct pass {
  const fg__multigrid *multigrid;
  const float *from, *a, *b, *c;
  float *to;
  double number;
  int cycles;
  level_work *work;
  fg__sums sums[FG__MOST_THREADS];
  fg__changes changes[FG__MOST_THREADS];
};

static void run(pass *p, fg__threads_work *work)
{
  fg__threads_run(p->multigrid->threaded_levels > 0 ? p->multigrid->threads : NULL, work,
                  p);
}

/* Each of several ranks works on its block with one thread; their sums are added. */
static bool is_distributed(const fg__multigrid *multigrid)
{
  return multigrid->distributed_count > 0;
}

static void work_on_finest(void *argument, const fg__thread *thread)
{
  pass *p = argument;
  if (!fg__is_idle(&p->multigrid->partition))
    p->work(p, fg__multigrid_finest(p->multigrid), thread);
}

static void run_on_finest(pass *p, level_work *work)
{
  p->work = work;
  run(p, work_on_finest);
}

static double node_count(const fg__multigrid *multigrid)
{
  const int *nodes = multigrid->partition.nodes;
  return (double)nodes[0] * nodes[1] * nodes[2];
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

static void copy(void *argument, const fg__thread *thread)
{
  const pass *p = argument;
  fg__multigrid_copy(p->multigrid, p->from, p->to, thread);
}

void fg__pass_copy(const fg__multigrid *multigrid, const float *from, float *to)
{
  pass p = {.multigrid = multigrid, .from = from, .to = to};
  run(&p, copy);
}

void fg__pass_fill_ghosts(const fg__multigrid *multigrid, float *u)
{
  if (is_distributed(multigrid))
    fg__distributed_exchange(&multigrid->distributed[0], 1, &u, FG__ALL_COLOURS);
  else
    fg__fill_ghosts(&multigrid->level[0], u);
}

static void solve(void *argument, const fg__thread *thread)
{
  const pass *p = argument;
  fg__multigrid_solve(p->multigrid, p->number, p->cycles, p->to, thread);
}

void fg__pass_solve(const fg__multigrid *multigrid, double tau, int cycles, float *before)
{
  pass p = {.multigrid = multigrid, .to = before, .number = tau, .cycles = cycles};
  run(&p, solve);
}

static void evaluate(pass *p, const fg__level *level, const fg__thread *thread)
{
  fg__sums part = p->multigrid->kernel->evaluate(level, p->from, p->to, thread);
  p->sums[thread->index].energy += part.energy;
  p->sums[thread->index].u += part.u;
  p->sums[thread->index].chemical += part.chemical;
}

fg__sums fg__pass_evaluate(const fg__multigrid *multigrid, const float *u, float *w)
{
  pass p = {.multigrid = multigrid, .from = u, .to = w};
  run_on_finest(&p, evaluate);
  fg__sums total = {0.0, 0.0, 0.0};
  for (int n = 0; n < FG__MOST_THREADS; ++n) {
    total.energy += p.sums[n].energy;
    total.u += p.sums[n].u;
    total.chemical += p.sums[n].chemical;
  }
  if (is_distributed(multigrid)) {
    const fg__distributed *finest = &multigrid->distributed[0];
    double rounding = fg__level_rounding(node_count(multigrid));
    fg__distributed_exchange_ends(finest, 1, &w);
    /* halves of exact sums */
    add_over_ranks(multigrid, (double *const[]){&total.energy, &total.u, &total.chemical},
                   (const double[]){0.5 * rounding, rounding, 0.5 * rounding}, 3);
  }
  return total;
}

static void explicit_part(pass *p, const fg__level *level, const fg__thread *thread)
{
  p->multigrid->kernel->explicit_part(level, p->from, p->a, (float)p->number, p->to,
                                      thread);
}

void fg__pass_explicit_part(const fg__multigrid *multigrid, const float *u,
                            const float *w, double tau, float *p)
{
  pass whole = {.multigrid = multigrid, .from = u, .a = w, .number = tau, .to = p};
  run_on_finest(&whole, explicit_part);
}

static void subtract_potential_derivative(pass *p, const fg__level *level,
                                          const fg__thread *thread)
{
  p->multigrid->kernel->subtract_potential_derivative(level, p->from, p->to, thread);
}

void fg__pass_subtract_potential_derivative(const fg__multigrid *multigrid,
                                            const float *u, float *w)
{
  pass p = {.multigrid = multigrid, .from = u, .to = w};
  run_on_finest(&p, subtract_potential_derivative);
}

static void changes(pass *p, const fg__level *level, const fg__thread *thread)
{
  fg__changes part =
      p->multigrid->kernel->changes(level, p->from, p->a, p->b, p->c, thread);
  fg__changes *sum = &p->changes[thread->index];
  sum->u += part.u;
  sum->change += part.change;
  sum->correction += part.correction;
  sum->product += part.product;
}

fg__changes fg__pass_changes(const fg__multigrid *multigrid, const float *u,
                             const float *a, const float *b, const float *c)
{
  pass p = {.multigrid = multigrid, .from = u, .a = a, .b = b, .c = c};
  run_on_finest(&p, changes);
  fg__changes total = {0.0, 0.0, 0.0, 0.0};
  for (int n = 0; n < FG__MOST_THREADS; ++n) {
    total.u += p.changes[n].u;
    total.change += p.changes[n].change;
    total.correction += p.changes[n].correction;
    total.product += p.changes[n].product;
  }
  if (is_distributed(multigrid)) {
    double nodes = node_count(multigrid);
    double rounding = fg__level_rounding(nodes), fine = fg__level_change_rounding(nodes);
    add_over_ranks(
        multigrid,
        (double *const[]){&total.u, &total.change, &total.correction, &total.product},
        (const double[]){rounding, fine, fine, fine}, 4);
  }
  return total;
}

static void shift(pass *p, const fg__level *level, const fg__thread *thread)
{
  p->multigrid->kernel->shift(level, p->to, (float)p->number, thread);
}

void fg__pass_shift(const fg__multigrid *multigrid, float *u, double amount)
{
  pass p = {.multigrid = multigrid, .to = u, .number = amount};
  run_on_finest(&p, shift);
}

static void extrapolate(pass *p, const fg__level *level, const fg__thread *thread)
{
  p->multigrid->kernel->extrapolate(level, p->from, p->a, (float)p->number, p->to,
                                    thread);
}

void fg__pass_extrapolate(const fg__multigrid *multigrid, const float *now,
                          const float *before, double omega, float *out)
{
  pass p = {.multigrid = multigrid, .from = now, .a = before, .number = omega, .to = out};
  run_on_finest(&p, extrapolate);
}

static void predict(pass *p, const fg__level *level, const fg__thread *thread)
{
  p->multigrid->kernel->predict(level, p->from, p->a, (float)p->number, p->to, thread);
}

void fg__pass_predict(const fg__multigrid *multigrid, const float *now,
                      const float *before, double omega, float *out)
{
  pass p = {.multigrid = multigrid, .from = now, .a = before, .number = omega, .to = out};
  run_on_finest(&p, predict);
}
