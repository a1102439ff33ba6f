#include "schemes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

/* Single steps of any length, each solved. */

typedef struct engine {
  fg__multigrid multigrid;
  scheme by;
  fg__theta theta;
  float *start, *older, *before, *memory;
  bool history; /* older is of one such step ago */
} engine;

static void create_engine(engine *s, const domain *d, scheme by, double alpha)
{
  *s = (engine){.by = by};
  create_multigrid(&s->multigrid, d, alpha);
  if (alpha > 0.0)
    check(!fg__theta_create(&s->theta, NULL, &s->multigrid, splitting_of(alpha)),
          "the theta scheme");
  fg__array_shape shape = fg__multigrid_shape(&s->multigrid, 0);
  s->memory = fg__allocate_aligned(3 * (shape.size + FG__LANES), sizeof(float));
  check(s->memory != NULL, "memory");
  s->start = s->memory + shape.first;
  s->older = s->start + shape.size + FG__LANES;
  s->before = s->older + shape.size + FG__LANES;
}

static void clear_engine(engine *s)
{
  fg__multigrid_clear(&s->multigrid);
  fg__theta_clear(&s->theta);
  free(s->memory);
}

/* Solved: the last cycle's correction is this share of the change. */
static const double solved = 1e-3;
enum { MOST_CYCLES = 100 };

static bool solve(engine *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  for (int n = 0; n < MOST_CYCLES; ++n) {
    fg__pass_solve(m, tau, 1, s->before);
    fg__changes c =
        fg__pass_changes(m, fg__multigrid_u(m), s->start, s->before, s->start);
    if (!(c.change < 1e30))
      return false;
    if (n > 0 && c.correction <= solved * solved * c.change)
      return true;
  }
  return false;
}

static void begin(engine *s, const float *u)
{
  fg__level_import(&s->multigrid.level[0], s->start, u);
  fg__fill_ghosts(&s->multigrid.level[0], s->start);
  s->history = false;
}

/* The multigrid's u, in which the step ends, becomes the start of the next. */
static void go_on(engine *s)
{
  fg__pass_copy(&s->multigrid, s->start, s->older);
  fg__pass_copy(&s->multigrid, fg__multigrid_u(&s->multigrid), s->start);
  s->history = true;
}

/* From start to the multigrid's u; false when the cycles do not converge. The first step
 * of BDF2 is Euler's. */
static bool step(engine *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  fg__pass_copy(m, s->start, fg__multigrid_u(m));
  if (s->by != THETA) {
    bool two = s->by == BDF2 && s->history;
    fg__pass_extrapolate(m, s->start, two ? s->older : s->start, 1.0 / 3.0,
                         fg__multigrid_p(m));
    fg__pass_evaluate(m, s->start, fg__multigrid_w(m));
    return solve(s, two ? 2.0 / 3.0 * tau : tau);
  }
  bool good = true;
  for (int n = 0; n < FG__THETA_SUBSTEPS && good; ++n)
    good = solve(s, fg__theta_prepare(&s->theta, m, n, tau, s->start));
  return good;
}

typedef struct question {
  engine *engine;
  const float *u;
  bool unsolved; /* the cycles, not the answer, have ended the search */
} question;

typedef bool answer(question *q, double tau);

static bool converges(question *q, double tau)
{
  begin(q->engine, q->u);
  if (!step(q->engine, tau))
    return false;
  go_on(q->engine);
  return step(q->engine, tau);
}

/* Over many steps, so that what grows slowly shows. */
enum { ENERGY_STEPS = 40 };

static bool energy_falls(question *q, double tau)
{
  engine *s = q->engine;
  fg__multigrid *m = &s->multigrid;
  begin(s, q->u);
  double energy = fg__pass_evaluate(m, s->start, s->before).energy;
  for (int n = 0; n < ENERGY_STEPS; ++n) {
    if (!step(s, tau)) {
      q->unsolved = true;
      return false;
    }
    double now = fg__pass_evaluate(m, fg__multigrid_u(m), s->before).energy;
    if (!(now <= energy)) {
      q->unsolved = false;
      return false;
    }
    energy = now;
    go_on(s);
  }
  return true;
}

/* The largest tau with that answer, within 5 %, if the answer changes once. */
static double largest(answer *holds, question *q, double low)
{
  if (!holds(q, low))
    return 0.0;
  double high = 2.0 * low;
  while (high < 1.0 && holds(q, high)) {
    low = high;
    high *= 2.0;
  }
  while (high > 1.05 * low) {
    double middle = sqrt(low * high);
    if (holds(q, middle))
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* The largest steps two of which have an error against the tight solution of at most 1 %
 * of u, and 10 % of the change: found by going up with that solution. Very short steps
 * say nothing: what they change is near the rounding of floats. */
static void find_accurate_steps(const domain *d, const snapshot *m,
                                engine engines[SCHEMES], double found[SCHEMES][2])
{
  static const double allowed[2] = {0.01, 0.1}, factor = 1.1, first = 1e-6;
  float *exact = plain_array(), *u = plain_array();
  fg__stepper tight;
  create_exact(&tight, d, m->u);
  bool open[SCHEMES][2], any = true;
  for (int k = 0; k < SCHEMES; ++k)
    for (int n = 0; n < 2; ++n) {
      open[k][n] = true;
      found[k][n] = 0.0;
    }
  for (double tau = first; any; tau *= factor) {
    advance(&tight, 2.0 * tau - tight.time, exact_step(d));
    export_current(&tight, exact);
    any = false;
    for (int k = 0; k < SCHEMES; ++k) {
      if (!open[k][0] && !open[k][1])
        continue;
      question q = {&engines[k], m->u, false};
      bool good = converges(&q, tau);
      const fg__multigrid *grid = &engines[k].multigrid;
      fg__level_export(&grid->level[0], grid->level[0].u, u);
      error e = error_of(u, exact, m->u);
      const double shares[2] = {e.of_u, e.of_change};
      for (int n = 0; n < 2; ++n) {
        open[k][n] = open[k][n] && good && shares[n] <= allowed[n];
        if (open[k][n])
          found[k][n] = tau;
        any = any || open[k][n];
      }
    }
  }
  fg__stepper_clear(&tight);
  free(exact);
  free(u);
}

static void print_energy_limit(question *q, double unit)
{
  double limit = largest(energy_falls, q, 1e-7) / unit;
  printf(q->unsolved ? "> %.3g" : "%.3g", limit);
}

void compare_lengths(const domain *d, const snapshot snapshots[SNAPSHOTS])
{
  engine schemes[SCHEMES];
  double h2 = d->h * d->h;
  for (int k = 0; k < SCHEMES; ++k)
    create_engine(&schemes[k], d, (scheme)k, k == THETA ? fg__theta_default.alpha : 0.0);
  puts("\n## Largest steps, in h²\n");
  puts("| state | scheme | energy falls | two steps can be solved | error of u ≤ 1 % | "
       "error of "
       "the change ≤ 10 % |\n|---|---|---|---|---|---|");
  for (int n = 0; n < SNAPSHOTS; ++n) {
    double found[SCHEMES][2];
    find_accurate_steps(d, &snapshots[n], schemes, found);
    for (int k = 0; k < SCHEMES; ++k) {
      question q = {&schemes[k], snapshots[n].u, false};
      printf("| %s, N = %d, t = %.3g | %s | ", snapshots[n].name, snapshots[n].clusters,
             snapshots[n].time, scheme_names[k]);
      print_energy_limit(&q, h2);
      printf(" | %.3g | %.3g | %.3g |\n", largest(converges, &q, 1e-7) / h2,
             found[k][0] / h2, found[k][1] / h2);
      fflush(stdout);
    }
  }
  for (int k = 0; k < SCHEMES; ++k)
    clear_engine(&schemes[k]);
  puts("\n| α, middle | linear theory | energy falls | cycles converge "
       "|\n|---|---|---|---|");
  static const double alphas[] = {0.51, 0.5858, 0.65, 0.7, 0.8, 0.9};
  for (size_t n = 0; n < sizeof alphas / sizeof alphas[0]; ++n) {
    engine s;
    create_engine(&s, d, THETA, alphas[n]);
    question q = {&s, snapshots[1].u, false};
    printf("| %g | %.3g | ", alphas[n], stable_step(d, alphas[n]) / h2);
    print_energy_limit(&q, h2);
    printf(" | %.3g |\n", largest(converges, &q, 1e-7) / h2);
    fflush(stdout);
    clear_engine(&s);
  }
}
