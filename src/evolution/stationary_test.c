/* A pattern comes to rest, parts keep their own mass, and nonsense is refused. */
#include "evolution/fixture_test.h"

/* Runs to its end: the pattern no longer changes, and that is no failure. */
static void comes_to_rest(fixture *f, const fg_evolution_options *options)
{
  fg_field *field = make(f);
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_evolution_create(&evolution, f->context, field, options),
                   FG_STATUS_OK);
  fg_step step;
  do
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
  while (!step.stationary && step.step < 3000);
  assert_true(step.stationary);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
}

static void patterns_come_to_rest(void **state)
{
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    comes_to_rest(*state, &(fg_evolution_options){.nodes = 33, .seed = seed});
    comes_to_rest(*state, &(fg_evolution_options){
                              .nodes = 33, .seed = seed, .energy = FG_ENERGY_ISOTROPIC});
  }
}

/* Too little coverage for any cluster: the density just levels out. */
static void an_even_density_is_at_rest(void **state)
{
  comes_to_rest(*state, &(fg_evolution_options){.nodes = 33, .coverage = 0.05});
}

/* A wall of two columns; `parts` get the means of both sides, `dead` the largest value at
 * nodes without an active cell. */
static void look(const fg_evolution *evolution, double parts[2], double *dead)
{
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  double area[2] = {0.0, 0.0};
  parts[0] = parts[1] = *dead = 0.0;
  for (int j = 0; j + 1 < d->nodes[1]; ++j)
    for (int i = 0; i + 1 < d->nodes[0]; ++i) {
      if (!d->active[j * (d->nodes[0] - 1) + i])
        continue;
      int side = 5 * i > 2 * d->nodes[0];
      for (int a = 0; a < 4; ++a)
        parts[side] += (double)d->u[(j + a / 2) * d->nodes[0] + i + a % 2];
      area[side] += 4.0;
    }
  for (int j = 0; j < d->nodes[1]; ++j)
    for (int i = 0; i < d->nodes[0]; ++i)
      if (!alive(d, i, j))
        *dead = fmax(*dead, fabs((double)d->u[j * d->nodes[0] + i]));
  parts[0] /= area[0];
  parts[1] /= area[1];
  fg_density_destroy(density);
}

static void parts_keep_their_mass_and_land_its_zero(void **state)
{
  fixture *f = *state;
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i)
      f->valid[j * SIDE + i] = i != 25 && i != 26;
  fg_field *field = make(f);
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_evolution_create(&evolution, f->context, field,
                                       &(fg_evolution_options){.nodes = 129}),
                   FG_STATUS_OK);
  double first[2], last[2], dead;
  look(evolution, first, &dead);
  fg_step step;
  do
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
  while ((step.clusters == 0 || step.clusters > 3) && !step.stationary);
  look(evolution, last, &dead);
  print_message("# means change by %+.2e and %+.2e, dead nodes reach %g\n",
                last[0] - first[0], last[1] - first[1], dead);
  assert_true(dead < 3.5);
  assert_true(fabs(last[0] - first[0]) < 2e-5 && fabs(last[1] - first[1]) < 2e-5);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
}

static void an_initial_density_must_be_finite(void **state)
{
  float *initial = calloc(SIDE * SIDE, sizeof *initial);
  assert_non_null(initial);
  initial[70] = NAN;
  refuses(*state, &(fg_evolution_options){.nodes = SIDE, .initial = initial}, "initial");
  initial[70] = INFINITY;
  refuses(*state, &(fg_evolution_options){.nodes = SIDE, .initial = initial}, "initial");
  free(initial);
}

/* Eight cells across a box a million times as long as wide would take four million along
 * it. */
static void needles_are_refused(void **state)
{
  fixture *f = *state;
  for (int i = 0; i < SIDE; ++i)
    f->y[i] = 7.0 + 3e-6 * i / (SIDE - 1);
  refuses(f, &(fg_evolution_options){.nodes = 129}, "times as long as wide");
}

/* An interface a hundredth of a cell wide could not move. */
static void unresolved_interfaces_are_refused(void **state)
{
  refuses(*state, &(fg_evolution_options){.nodes = 65, .gamma = 1e-7}, "interfaces");
}

static void threads_are_not_negative(void **state)
{
  refuses(*state, &(fg_evolution_options){.nodes = 65, .threads = -3}, "threads");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(patterns_come_to_rest),
      CASE(an_even_density_is_at_rest),
      CASE(parts_keep_their_mass_and_land_its_zero),
      CASE(an_initial_density_must_be_finite),
      CASE(needles_are_refused),
      CASE(unresolved_interfaces_are_refused),
      CASE(threads_are_not_negative),
  };
  return cmocka_run_group_tests_name("evolution/stationary", tests, NULL, NULL);
}
