/* Whole runs by the theta scheme: the promises of every run, and the clusters that
 * a tight run by BDF2 finds. docs/method/schemes.md compares the schemes at length. */
#include "evolution/curve_test.h"

enum { NODES = 129 };

/* From the first count to half as many clusters, in a few hundred steps of theta. */
static const double FIRST = 1.2e-3, LAST = 1.2e-2;

static void clusters_and_energy_are_those_of_a_tight_run(void **state)
{
  (void)state;
  double times[TIMES];
  spread_times(FIRST, LAST, times);
  fg_evolution_options options = {.nodes = NODES, .accuracy = 0.01, .cycles = 6};
  curve *tight = run_curve("vortex3", &options, 0, LAST, NULL);
  options = (fg_evolution_options){.nodes = NODES, .scheme = FG_SCHEME_THETA};
  curve *theta = run_curve("vortex3", &options, 0, LAST, NULL);
  double clusters = 0.0, energy = 0.0;
  for (int k = 0; k < TIMES; ++k) {
    double t = times[k], expected = energy_at(tight, t);
    int wanted = clusters_at(tight, t), found = clusters_at(theta, t);
    print_message("# t = %.3g: N = %d, tight %d; E = %.5g, tight %.5g\n", t, found,
                  wanted, energy_at(theta, t), expected);
    assert_true(wanted > 0);
    clusters += fabs((double)(found - wanted)) / wanted / TIMES;
    energy += fabs(energy_at(theta, t) - expected) / expected / TIMES;
  }
  print_message("# on the average N differs by %.1f %%, E by %.2f %%\n", 100.0 * clusters,
                100.0 * energy);
  /* less than half, and a sixth, of what seeds scatter by (fast_stepping_test) */
  assert_true(clusters < 0.03);
  assert_true(energy < 0.005);
  destroy_curve(tight);
  destroy_curve(theta);
}

/* Returns the number of rejected attempts. */
static int keeps_promises(const char *name, int nodes, int steps, double theta,
                          double alpha)
{
  int rejected = 0;
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, name, 33), FG_STATUS_OK);
  fg_evolution_options options = {.nodes = nodes,
                                  .scheme = FG_SCHEME_THETA,
                                  .theta = theta,
                                  .alpha = alpha,
                                  .coverage = 0.35};
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  double energy = HUGE_VAL, mean = 2.0 * 0.35 - 1.0, last_time = 0.0;
  for (int n = 0; n < steps; ++n) {
    fg_step step;
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    assert_true(step.energy < energy);
    assert_true(fabs(step.mass - mean) < 1e-7);
    assert_int_equal(step.cycles, 9 * (1 + step.rejected));
    energy = step.energy;
    rejected += step.rejected;
    last_time = step.time;
  }
  print_message("# %s, theta %g, alpha %g: t = %g, E = %g, %d rejected\n", name, theta,
                alpha, last_time, energy, rejected);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return rejected;
}

static void mass_stays_and_energy_falls(void **state)
{
  (void)state;
  assert_int_equal(keeps_promises("vortex3", NODES, 300, 0.0, 0.0), 0);
  assert_int_equal(keeps_promises("abc", 33, 60, 0.0, 0.0), 0);
}

/* In steps up to linear theory's longest, which follows theta and alpha. At the ends of
 * the range, where interfaces are nearly without the implicit half of K, some of these
 * steps raise the energy and are rejected. */
static void so_they_do_in_the_range_of_theta_and_alpha(void **state)
{
  (void)state;
  static const struct {
    double theta, alpha;
    bool rejects;
  } of[] = {{0.0, 0.5001, false}, {0.0, 0.7, false},  {0.0, 1.0, true},
            {0.01, 0.6, true},    {0.15, 0.6, false}, {0.4, 0.6, false},
            {0.49, 0.6, false},   {0.2, 0.8, false}};
  for (size_t n = 0; n < sizeof of / sizeof *of; ++n) {
    int rejected = keeps_promises("vortex3", 65, 120, of[n].theta, of[n].alpha);
    assert_int_equal(rejected > 0, of[n].rejects);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clusters_and_energy_are_those_of_a_tight_run),
      cmocka_unit_test(mass_stays_and_energy_falls),
      cmocka_unit_test(so_they_do_in_the_range_of_theta_and_alpha),
  };
  return cmocka_run_group_tests_name("evolution/schemes", tests, NULL, NULL);
}
