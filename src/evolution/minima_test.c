/* The density stays near the minima at -1 and 1, also where a droplet has just vanished
 * and in parts of a few nodes. */
#include "evolution/fixture_test.h"

/* Beyond it lies no resting interface but in the corners of a mask. */
static const double far_off = 1.1;

static double greatest(const fg_evolution *evolution, fg_context *context)
{
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  size_t count = (size_t)d->nodes[0] * (size_t)d->nodes[1];
  double most = 0.0;
  for (size_t n = 0; n < count * (d->dimension == 3 ? (size_t)d->nodes[2] : 1); ++n)
    most = fmax(most, fabs((double)d->u[n]));
  fg_density_destroy(density);
  assert_string_equal(fg_context_message(context), "");
  return most;
}

typedef struct course {
  const char *name;
  int nodes, clusters;
  uint64_t first_seed, last_seed;
} course;

/* The greatest |u| of all steps from the first clusters on to so many. */
static double greatest_of_run(const course *flow, uint64_t seed)
{
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_evolution_options options = {.nodes = flow->nodes, .seed = seed};
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, flow->name, 0),
                   FG_STATUS_OK);
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  fg_step step;
  double most = 0.0, energy = (double)INFINITY;
  do {
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    assert_true(step.energy <= energy);
    energy = step.energy;
    if (step.clusters > 0)
      most = fmax(most, greatest(evolution, context));
  } while (step.clusters == 0 || step.clusters > flow->clusters);
  print_message("# %s, %d nodes, seed %d: |u| <= %.3f in %ld steps\n", flow->name,
                flow->nodes, (int)seed, most, step.step);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return most;
}

static void no_droplet_leaves_a_pit(void **state)
{
  (void)state;
  const course flows[] = {{"vortex3", 257, 12, 1, 2},
                          {"vortex3", 129, 5, 1, 5},
                          {"saddle", 129, 5, 1, 3},
                          {"uniform", 129, 5, 1, 3},
                          {"vortex3d", 41, 6, 3, 3}};
  for (size_t n = 0; n < sizeof flows / sizeof *flows; ++n)
    for (uint64_t seed = flows[n].first_seed; seed <= flows[n].last_seed; ++seed)
      assert_true(greatest_of_run(&flows[n], seed) <= far_off);
}

/* Single cells, whose means the noise sets and nothing changes. */
static void small_subdomains_begin_between_the_minima(void **state)
{
  fixture *f = *state;
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i) {
      f->y[j] = 7.0 + 3.0 * j / (SIDE - 1);
      f->valid[j * SIDE + i] = i > 40 || (i % 4 < 2 && j % 4 < 2);
    }
  fg_field *field = make(f);
  fg_evolution *evolution = NULL;
  fg_evolution_options options = {.nodes = SIDE};
  assert_int_equal(fg_evolution_create(&evolution, f->context, field, &options),
                   FG_STATUS_OK);
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  assert_int_equal(d->nodes[0], SIDE);
  assert_int_equal(d->nodes[1], SIDE);
  double least = 1.0, most = -1.0;
  for (int j = 0; j < SIDE; j += 4)
    for (int i = 0; i < 40; i += 4) {
      const float *u = d->u + j * SIDE + i;
      if (j + 1 == SIDE)
        continue;
      double mean =
          0.25 * ((double)u[0] + (double)u[1] + (double)u[SIDE] + (double)u[SIDE + 1]);
      least = fmin(least, mean);
      most = fmax(most, mean);
    }
  print_message("# means of single cells from %.4f to %.4f\n", least, most);
  assert_true(least >= -1.01 && most <= 1.01);
  assert_true(least < -0.9 && most > 0.5); /* noise all the same */
  fg_step step;
  assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
  const fg_mesh_info *mesh = fg_evolution_mesh(evolution);
  double area = mesh->domain_measure / (mesh->length * mesh->length);
  assert_true(fabs(step.mass + 0.4 * area) < 1e-7 * area);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_droplet_leaves_a_pit),
      cmocka_unit_test_setup_teardown(small_subdomains_begin_between_the_minima, set_up,
                                      tear_down),
  };
  return cmocka_run_group_tests_name("evolution/minima", tests, NULL, NULL);
}
