#include "evolve/passes.h"

#include <string.h>

/* What a pass works on; each uses what it needs. */
typedef struct pass {
  const fg__multigrid *multigrid;
  const float *from, *a, *b, *c;
  float *to;
  double number;
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

static void copy_part(const fg__level *level, const float *from, float *to,
                      const fg__share *share)
{
  int rows = (int)((ptrdiff_t)level->layout.array_size / level->layout.stride);
  int begin, end;
  fg__team_part(share, rows, 1, &begin, &end);
  ptrdiff_t at = begin * level->layout.stride - level->layout.first;
  memcpy(to + at, from + at,
         (size_t)(end - begin) * (size_t)level->layout.stride * sizeof *to);
}

static void copy(void *argument, const fg__share *share)
{
  const pass *p = argument;
  copy_part(finest(p), p->from, p->to, share);
}

void fg__pass_copy(const fg__multigrid *multigrid, const float *from, float *to)
{
  pass p = {.multigrid = multigrid, .from = from, .to = to};
  run(&p, copy);
}

static void cycle(void *argument, const fg__share *share)
{
  const pass *p = argument;
  if (p->to) {
    copy_part(finest(p), finest(p)->u, p->to, share);
    fg__team_barrier(share);
  }
  fg__multigrid_cycle(p->multigrid, p->number, share);
}

void fg__pass_cycle(const fg__multigrid *multigrid, double tau, float *before)
{
  pass p = {.multigrid = multigrid, .to = before, .number = tau};
  run(&p, cycle);
}

static void evaluate(void *argument, const fg__share *share)
{
  pass *p = argument;
  p->sums[share->member] =
      p->multigrid->kernel->evaluate(finest(p), p->from, p->to, share);
}

fg__sums fg__pass_evaluate(const fg__multigrid *multigrid, const float *u, float *w)
{
  pass p = {.multigrid = multigrid, .from = u, .to = w};
  run(&p, evaluate);
  fg__sums total = {0.0, 0.0};
  for (int n = 0; n < FG__MOST_MEMBERS; ++n) {
    total.energy += p.sums[n].energy;
    total.u += p.sums[n].u;
  }
  return total;
}

static void changes(void *argument, const fg__share *share)
{
  pass *p = argument;
  p->changes[share->member] =
      p->multigrid->kernel->changes(finest(p), p->from, p->a, p->b, p->c, share);
}

fg__changes fg__pass_changes(const fg__multigrid *multigrid, const float *u,
                             const float *a, const float *b, const float *c)
{
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
  pass p = {.multigrid = multigrid, .from = now, .a = before, .number = omega, .to = out};
  run(&p, extrapolate);
}

static void prolong(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->prolong_array(finest(p) + 1, p->from, finest(p), p->a, p->to,
                                      share);
}

void fg__pass_prolong(const fg__multigrid *multigrid, const float *coarse,
                      const float *base, float *to)
{
  pass p = {.multigrid = multigrid, .from = coarse, .a = base, .to = to};
  run(&p, prolong);
}

static void restrict_defect(void *argument, const fg__share *share)
{
  const pass *p = argument;
  p->multigrid->kernel->restrict_defect(finest(p), p->from, finest(p) + 1, p->to,
                                        (float)p->number, share);
}

void fg__pass_restrict_defect(const fg__multigrid *multigrid, const float *w,
                              float *coarse, double tau)
{
  pass p = {.multigrid = multigrid, .from = w, .to = coarse, .number = tau};
  run(&p, restrict_defect);
}
