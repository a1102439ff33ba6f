#include "schemes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Takes a density along for a few tight steps: what the run's own errors have left then
 * no longer counts as change. */
static void settle(const domain *d, snapshot *m)
{
  fg__stepper s;
  double time = 40.0 * exact_step(d);
  create_exact(&s, d, m->u);
  advance(&s, time, exact_step(d));
  export_current(&s, m->u);
  m->time += time;
  fg__stepper_clear(&s);
}

/* A step, or a substep of the theta scheme; as the program has it. */
enum { CYCLES = 3 };

static error run_steps(const domain *d, const snapshot *m, scheme by, double time,
                       int steps, const float *exact, long *cycles)
{
  fg__stepper s;
  float *u = plain_array();
  create_stepper(&s, d, m->u, by, CYCLES, time / steps);
  advance(&s, time, time / steps);
  export_current(&s, u);
  *cycles = s.cycles_spent;
  error e = error_of(u, exact, m->u);
  fg__stepper_clear(&s);
  free(u);
  return e;
}

/* Equal steps over an eighth of the time so far;
 * late in the run, where that is a thousand stable steps, over this many. */
static const double most_stable_steps = 150.0;

static void compare_accuracy(const domain *d, const snapshot snapshots[SNAPSHOTS])
{
  puts("\n## Accuracy at equal cost\n");
  puts("| state, time | scheme | steps | cycles | error of u % | of the change % "
       "|\n|---|---|---|---|---|---|");
  float *exact = plain_array(), *coarser = plain_array();
  for (int n = 0; n < SNAPSHOTS; ++n) {
    const snapshot *m = &snapshots[n];
    double longest = stable_step(d, fg__theta_default.alpha);
    double time = fmin(m->time / 8.0, most_stable_steps * longest);
    for (int half = 0; half < 2; ++half) {
      fg__stepper s;
      create_exact(&s, d, m->u);
      advance(&s, time, (half ? 0.5 : 1.0) * exact_step(d));
      export_current(&s, half ? exact : coarser);
      fg__stepper_clear(&s);
    }
    error left = error_of(coarser, exact, m->u);
    int least = (int)ceil(time / longest * (1.0 - 1e-9));
    const struct {
      scheme by;
      int steps;
    } runs[] = {{THETA, least},     {EULER, 3 * least},  {BDF2, 3 * least},
                {THETA, 2 * least}, {EULER, 6 * least},  {BDF2, 6 * least},
                {THETA, 4 * least}, {EULER, 12 * least}, {BDF2, 12 * least},
                {EULER, least / 2}, {BDF2, least / 2},   {EULER, least / 10},
                {BDF2, least / 10}, {EULER, least / 50}, {BDF2, least / 50}};
    for (size_t k = 0; k < sizeof runs / sizeof runs[0]; ++k) {
      if (runs[k].steps < 1)
        continue;
      long cycles;
      error e = run_steps(d, m, runs[k].by, time, runs[k].steps, exact, &cycles);
      printf("| %s, %.3g | %s | %d | %ld | %.3f | %.2f |\n", m->name, time,
             scheme_names[runs[k].by], runs[k].steps, cycles, 100.0 * e.of_u,
             100.0 * e.of_change);
      fflush(stdout);
    }
    printf("| %s, %.3g | what is taken as exact, in steps twice as long | | | %.4f | "
           "%.3f |\n",
           m->name, time, 100.0 * left.of_u, 100.0 * left.of_change);
  }
  free(exact);
  free(coarser);
}

/* From the early to the middle state with the step chosen by the control: what the limit
 * of linear theory spares. */
static void compare_limits(const domain *d, const snapshot snapshots[SNAPSHOTS])
{
  puts("\n## The control, from early to middle\n");
  puts("| scheme | most τ, h² | steps | rejected | cycles |\n|---|---|---|---|---|");
  static const struct {
    scheme by;
    bool limited;
    double accuracy;
  } runs[] = {{EULER, false, 0.05},
              {BDF2, false, 0.07},
              {THETA, true, 0.05},
              {THETA, false, 0.05}};
  for (size_t k = 0; k < sizeof runs / sizeof runs[0]; ++k) {
    fg__multigrid multigrid;
    double alpha = runs[k].by == THETA ? fg__theta_default.alpha : 0.0;
    double limit = runs[k].limited ? stable_step(d, alpha) : 1.0;
    create_multigrid(&multigrid, d, alpha);
    fg__level_import(&multigrid.level[0], multigrid.level[0].u, snapshots[0].u);
    fg__fill_ghosts(&multigrid.level[0], multigrid.level[0].u);
    fg__stepper_description description = {.cell_volume = d->volume,
                                           .first_tau = 1e-6,
                                           .most_tau = limit,
                                           .accuracy = runs[k].accuracy,
                                           .cycles = CYCLES,
                                           .second_order = runs[k].by == BDF2,
                                           .splitting = splitting_of(alpha)};
    fg__stepper s;
    check(!fg__stepper_create(&s, NULL, &multigrid, &description), "a stepper");
    while (s.time < snapshots[1].time - snapshots[0].time)
      check(!fg__stepper_advance(&s, NULL), "a step");
    printf("| %s | ", scheme_names[runs[k].by]);
    if (runs[k].limited)
      printf("%.3g", limit / (d->h * d->h));
    else
      printf("none");
    printf(" | %ld | %ld | %ld |\n", s.accepted, s.rejected, s.cycles_spent);
    fg__stepper_clear(&s);
  }
}

int main(void)
{
  fg_field *field;
  check(!fg_field_create_analytic(&field, NULL, "vortex3", NODES), "the field");
  snapshot snapshots[SNAPSHOTS];
  take_snapshots(snapshots, field);
  domain d;
  domain_create(&d, field);
  for (int n = 0; n < SNAPSHOTS; ++n)
    settle(&d, &snapshots[n]);
  printf("h² = %.4g, γ = %.3g h², %s\n", d.h * d.h, d.gamma / (d.h * d.h),
         fg__kernel_choose(2, FG_VECTORS_WIDEST)->name);
  compare_lengths(&d, snapshots);
  compare_limits(&d, snapshots);
  compare_accuracy(&d, snapshots);
  for (int n = 0; n < SNAPSHOTS; ++n)
    free(snapshots[n].u);
  domain_clear(&d);
  fg_field_destroy(field);
  return 0;
}
