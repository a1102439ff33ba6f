/* The energy where the mesh is coarsened, of winds that are rough beside an interface's
 * width, with and without land. */
#include "base/context_test.h"

#include <math.h>

/* A wind with eddies of all sizes down to a sixtieth of the domain, everywhere or right
 * of a coast with a bay, an island and a lake. */
static fg_field *rough(fg_context *context, bool masked)
{
  enum { SIDE = 129, WAVES = 60 };
  static float u[SIDE * SIDE], v[SIDE * SIDE];
  static unsigned char valid[SIDE * SIDE];
  static double axis[SIDE];
  for (int n = 0; n < SIDE * SIDE; ++n) {
    double x = (double)(n % SIDE) / (SIDE - 1), y = (double)(n / SIDE) / (SIDE - 1);
    double along = 1.0, across = 0.2;
    for (int k = 1; k <= WAVES; ++k) {
      double a = 2.4 * k, size = acos(-1.0) * k, s = cos(a), c = sin(a);
      double slope = 1.5 / sqrt(k) * cos(size * (s * x + c * y) + 7.0 * a);
      along += c * slope;
      across -= s * slope;
    }
    u[n] = (float)along;
    v[n] = (float)across;
    bool land = x < 0.2 + 0.1 * cos(9.0 * y) || hypot(x - 0.6, y - 0.4) < 0.08;
    valid[n] = !masked || !land || hypot(x - 0.05, y - 0.3) < 0.04;
    axis[n % SIDE] = x;
  }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {SIDE, SIDE, 1},
                                  .axis = {axis, axis},
                                  .velocity = {u, v},
                                  .valid = valid};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* Nor where directions change within an interface's width, or seas narrow. Of what is
 * missing nothing is covered, and the mean stays though the domain's measure changes. */
static void the_energy_never_grows(fg_context *context, bool masked)
{
  const double mean = -0.4;
  fg_field *field = rough(context, masked);
  fg_evolution *e = NULL;
  const fg_evolution_options options = {.nodes = 513};
  assert_int_equal(fg_evolution_create(&e, context, field, &options), FG_STATUS_OK);
  fg_step step;
  double last = (double)INFINITY;
  int coarsenings = 0;
  do {
    assert_int_equal(fg_evolution_step(e, &step), FG_STATUS_OK);
    if (step.coarsenings > coarsenings) {
      const fg_coarsening *c = fg_evolution_coarsening(e);
      assert_true(c->energy_before == last && c->energy_after <= last);
      last = c->energy_after;
      coarsenings = step.coarsenings;
    }
    assert_true(step.energy <= last);
    last = step.energy;
    const fg_mesh_info *mesh = fg_evolution_mesh(e);
    assert_true(fabs(step.mass - mean * mesh->domain_measure) < 1e-6);
  } while (step.clusters == 0 || step.clusters > 25);
  assert_int_equal(coarsenings, 1);
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, e), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  bool land = false;
  for (int n = 0; n < d->nodes[0] * d->nodes[1]; ++n) {
    double x = d->spacing[0] * (n % d->nodes[0]), y = d->spacing[1] * (n / d->nodes[0]);
    if (hypot(x - 0.6, y - 0.4) < 0.06) {
      land = true;
      assert_true(!masked || !(d->u[n] > 0.0F));
    }
  }
  assert_true(land);
  fg_density_destroy(density);
  fg_evolution_destroy(e);
  fg_field_destroy(field);
}

static void the_energy_never_grows_at_coarsenings(void **state)
{
  the_energy_never_grows(*state, false);
  the_energy_never_grows(*state, true);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(the_energy_never_grows_at_coarsenings,
                                      context_set_up, context_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
