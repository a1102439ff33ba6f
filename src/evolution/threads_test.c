/* Any number of threads gives the same density, from the tensor to the count of clusters:
 * meshes just large enough for several threads. */
#include "evolution/fixture_test.h"

typedef struct outcome {
  fg_density *density;
  fg_step step;
} outcome;

static outcome evolve(fixture *f, const fg_field *field, int nodes, int threads)
{
  enum { STEPS = 2 };
  outcome out = {.density = NULL};
  fg_evolution *evolution;
  const fg_evolution_options options = {.nodes = nodes, .threads = threads};
  assert_int_equal(fg_evolution_create(&evolution, f->context, field, &options),
                   FG_STATUS_OK);
  for (int n = 0; n < STEPS; ++n)
    assert_int_equal(fg_evolution_step(evolution, &out.step), FG_STATUS_OK);
  assert_int_equal(fg_density_create(&out.density, evolution), FG_STATUS_OK);
  fg_evolution_destroy(evolution);
  return out;
}

static void compare(fixture *f, const fg_field *field, int nodes)
{
  outcome one = evolve(f, field, nodes, 1);
  const fg_density_arrays *a = fg_density_contents(one.density);
  size_t count = (size_t)a->nodes[0] * (size_t)a->nodes[1] * (size_t)a->nodes[2];
  assert_true(count >= 200000); /* as many as threads are used for */
  for (int threads = 2; threads <= 3; ++threads) {
    outcome several = evolve(f, field, nodes, threads);
    const fg_density_arrays *b = fg_density_contents(several.density);
    assert_memory_equal(a->u, b->u, count * sizeof *a->u);
    assert_memory_equal(&one.step.energy, &several.step.energy, sizeof(double));
    assert_memory_equal(&one.step.area_fraction, &several.step.area_fraction,
                        sizeof(double));
    fg_density_destroy(several.density);
  }
  fg_density_destroy(one.density);
}

static void compare_analytic(fixture *f, const char *name, int nodes)
{
  fg_field *field;
  assert_int_equal(fg_field_create_analytic(&field, f->context, name, 33), FG_STATUS_OK);
  compare(f, field, nodes);
  fg_field_destroy(field);
}

static void threads_agree_in_2d(void **state)
{
  compare_analytic(*state, "vortex3", 449);
}

static void threads_agree_in_3d(void **state)
{
  compare_analytic(*state, "vortex3d", 65);
}

static void threads_agree_with_missing_parts(void **state)
{
  fixture *f = *state;
  for (int j = 20; j < 30; ++j)
    for (int i = 10; i < 50; ++i)
      f->valid[j * SIDE + i] = 0;
  fg_field *field = make(f);
  compare(f, field, 529);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(threads_agree_in_2d, set_up, tear_down),
      cmocka_unit_test_setup_teardown(threads_agree_in_3d, set_up, tear_down),
      cmocka_unit_test_setup_teardown(threads_agree_with_missing_parts, set_up,
                                      tear_down),
  };
  return cmocka_run_group_tests_name("evolution/threads", tests, NULL, NULL);
}
