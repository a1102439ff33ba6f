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

static void keeps_promises(const char *name, int nodes, int steps)
{
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, name, 33), FG_STATUS_OK);
  fg_evolution_options options = {
      .nodes = nodes, .scheme = FG_SCHEME_THETA, .coverage = 0.35};
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  double energy = HUGE_VAL, mean = 2.0 * 0.35 - 1.0;
  for (int n = 0; n < steps; ++n) {
    fg_step step;
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    assert_true(step.energy < energy);
    assert_true(fabs(step.mass - mean) < 1e-7);
    assert_int_equal(step.cycles, 9 * (1 + step.rejected));
    energy = step.energy;
  }
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void mass_stays_and_energy_falls(void **state)
{
  (void)state;
  keeps_promises("vortex3", NODES, 300);
  keeps_promises("abc", 33, 60);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clusters_and_energy_are_those_of_a_tight_run),
      cmocka_unit_test(mass_stays_and_energy_falls),
  };
  return cmocka_run_group_tests_name("evolution/schemes", tests, NULL, NULL);
}
