/* Refusals, and domains at the edge of sense: they run, or end with a clear line. */
#include "evolution/fixture_test.h"

static void options_out_of_range_are_refused(void **state)
{
  fixture *f = *state;
  refuses(f, &(fg_evolution_options){.nodes = 8}, "8 nodes");
  refuses(f, &(fg_evolution_options){.nodes = -257}, "-257 nodes");
  refuses(f, &(fg_evolution_options){.nodes = 16386}, "16386 nodes");
  refuses(f, &(fg_evolution_options){.anisotropy = -0.125}, "anisotropy -0.125 ");
  refuses(f, &(fg_evolution_options){.anisotropy = 1.25}, "anisotropy 1.25 ");
  refuses(f, &(fg_evolution_options){.anisotropy = (double)NAN}, "anisotropy");
  refuses(f, &(fg_evolution_options){.coverage = -0.25}, "coverage -0.25 ");
  refuses(f, &(fg_evolution_options){.coverage = 1.0}, "coverage 1 ");
  refuses(f, &(fg_evolution_options){.coverage = (double)NAN}, "coverage");
  refuses(f, &(fg_evolution_options){.gamma = -0.5}, "gamma -0.5 ");
  refuses(f, &(fg_evolution_options){.gamma = 1.5}, "gamma 1.5 ");
  refuses(f, &(fg_evolution_options){.gamma = (double)NAN}, "gamma");
  refuses(f, &(fg_evolution_options){.gamma = (double)INFINITY}, "gamma");
  refuses(f, &(fg_evolution_options){.accuracy = -0.05}, "accuracy -0.05 ");
  refuses(f, &(fg_evolution_options){.accuracy = 1.125}, "accuracy 1.125 ");
  refuses(f, &(fg_evolution_options){.accuracy = (double)NAN}, "accuracy");
  refuses(f, &(fg_evolution_options){.isotropic_below = -2.0}, "speed -2");
  refuses(f, &(fg_evolution_options){.isotropic_below = (double)NAN}, "speed");
  refuses(f,
          &(fg_evolution_options){.isotropic_below = 2.0, .energy = FG_ENERGY_GRADIENT},
          "speed 2: only with the energy flow");
  refuses(f, &(fg_evolution_options){.noise = -0.5}, "noise -0.5 ");
  refuses(f, &(fg_evolution_options){.noise = 5.5}, "noise 5.5 ");
  refuses(f, &(fg_evolution_options){.noise = (double)NAN}, "noise");
  refuses(f, &(fg_evolution_options){.cycles = -1}, "cycles -1 ");
  refuses(f, &(fg_evolution_options){.cycles = 1001}, "cycles 1001 ");
  refuses(f, &(fg_evolution_options){.energy = (fg_energy)7}, "energy");
  refuses(f, &(fg_evolution_options){.scheme = (fg_scheme)3}, "scheme 3 ");
}

static void splittings_and_residuals_out_of_range_are_refused(void **state)
{
  static const struct {
    double theta, alpha, residual;
    const char *message;
  } of[] = {{-0.1, 0.0, 0.0, "theta -0.1 is not in (0, 0.5)"},
            {0.5, 0.0, 0.0, "theta 0.5 is not in (0, 0.5)"},
            {(double)NAN, 0.0, 0.0, "theta nan "},
            {0.0, 0.5, 0.0, "alpha 0.5 is not in (0.5, 1]"},
            {0.0, 1.125, 0.0, "alpha 1.125 is not in (0.5, 1]"},
            {0.0, (double)NAN, 0.0, "alpha nan "},
            {0.0, 0.0, -0.5, "residual -0.5 is not in (0, inf)"},
            {0.0, 0.0, (double)INFINITY, "residual inf is not in (0, inf)"},
            {0.0, 0.0, (double)NAN, "residual nan "}};
  for (size_t n = 0; n < sizeof of / sizeof *of; ++n)
    refuses(*state,
            &(fg_evolution_options){.scheme = FG_SCHEME_THETA,
                                    .theta = of[n].theta,
                                    .alpha = of[n].alpha,
                                    .residual = of[n].residual},
            of[n].message);
  refuses(*state, &(fg_evolution_options){.theta = 0.25},
          "theta 0.25: only with the scheme theta");
  refuses(*state, &(fg_evolution_options){.scheme = FG_SCHEME_EULER, .alpha = 0.75},
          "alpha 0.75: only with the scheme theta");
}

static void null_arguments_are_refused(void **state)
{
  fixture *f = *state;
  fg_field *field = make(f);
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_evolution_create(&evolution, f->context, NULL, NULL),
                   FG_STATUS_ARGUMENT);
  fg_context_clear(f->context);
  assert_int_equal(fg_evolution_create(NULL, f->context, field, NULL),
                   FG_STATUS_ARGUMENT);
  fg_evolution_destroy(NULL);
  fg_density_destroy(NULL);
  fg_field_destroy(field);
}

static void a_domain_finer_than_the_mesh_is_refused(void **state)
{
  fixture *f = *state;
  memset(f->valid, 0, sizeof f->valid);
  for (int n = 0; n < 4; ++n)
    f->valid[(20 + n / 2) * SIDE + 20 + n % 2] = 1;
  refuses(f, &(fg_evolution_options){.nodes = 9}, "no cell");
}

/* Takes at most 80 steps. The values stay within reach of the minima and the initial
 * noise, the energy is a sum of squares and falls, the mass stays. */
static void runs(fixture *f, int nodes)
{
  fg_field *field = make(f);
  fg_evolution *evolution = NULL;
  fg_evolution_options options = {.nodes = nodes};
  assert_int_equal(fg_evolution_create(&evolution, f->context, field, &options),
                   FG_STATUS_OK);
  const fg_mesh_info *mesh = fg_evolution_mesh(evolution);
  double area = mesh->domain_measure / (mesh->length * mesh->length),
         energy = (double)INFINITY;
  fg_step step;
  do {
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    assert_true(step.energy >= 0.0 && step.energy <= energy);
    assert_true(fabs(step.mass + 0.4 * area) < 1e-7 * area);
    energy = step.energy;
  } while (step.step < 80 && !step.stationary && step.clusters != 1);
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  for (int j = 0; j < d->nodes[1]; ++j)
    for (int i = 0; i < d->nodes[0]; ++i)
      if (alive(d, i, j))
        assert_true(fabs((double)d->u[j * d->nodes[0] + i]) < 3.5);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
}

static void the_smallest_meshes_run(void **state)
{
  runs(*state, 9);
  runs(*state, 17);
  runs(*state, 33);
}

static void thin_boxes_run(void **state)
{
  fixture *f = *state;
  for (int i = 0; i < SIDE; ++i)
    f->y[i] = 7.0 + 0.09 * i / (SIDE - 1); /* 1 : 33 */
  runs(f, 129);
  f->arrays.period[0] = 3.1;
  runs(f, 129);
}

static void disconnected_domains_run(void **state)
{
  fixture *f = *state;
  for (int j = 0; j < SIDE; ++j) /* columns without a cell, a boundary without one */
    for (int i = 0; i < SIDE; ++i)
      f->valid[j * SIDE + i] = i != 30 && i != 31 && i < 50;
  runs(f, 65);
  for (int j = 0; j < SIDE; ++j) /* squares that touch at corners */
    for (int i = 0; i < SIDE; ++i)
      f->valid[j * SIDE + i] = (i / 16 + j / 16) % 2 == 0;
  runs(f, 65);
  for (int j = 0; j < SIDE; ++j) /* strips of two cells */
    for (int i = 0; i < SIDE; ++i)
      f->valid[j * SIDE + i] = i % 4 != 3;
  runs(f, 65);
  f->arrays.period[1] = 2.4;
  runs(f, 65);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(options_out_of_range_are_refused),
      CASE(splittings_and_residuals_out_of_range_are_refused),
      CASE(null_arguments_are_refused),
      CASE(a_domain_finer_than_the_mesh_is_refused),
      CASE(the_smallest_meshes_run),
      CASE(thin_boxes_run),
      CASE(disconnected_domains_run),
  };
  return cmocka_run_group_tests_name("evolution/limits", tests, NULL, NULL);
}
