/* A weak anisotropy costs little more than the default one: interfaces along the stream
 * are as thin as those across it are by default, and cycles once needed four times as
 * many. */
#include "base/context_test.h"

enum { SEEDS = 3, CLUSTERS = 12 };

/* Of all seeds, from noise on. */
static int cycles_at(fg_context *context, const fg_field *field, double anisotropy)
{
  int cycles = 0;
  for (uint64_t seed = 1; seed <= SEEDS; ++seed) {
    fg_evolution_options options = {
        .nodes = 193, .anisotropy = anisotropy, .seed = seed, .threads = 1};
    fg_evolution *evolution;
    assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                     FG_STATUS_OK);
    fg_step step;
    do {
      assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
      cycles += step.cycles;
    } while ((step.clusters == 0 || step.clusters > CLUSTERS) && !step.stationary);
    fg_evolution_destroy(evolution);
  }
  print_message("# a = %g: %d cycles\n", anisotropy, cycles);
  return cycles;
}

static void weak_anisotropy_costs_little_more(void **state)
{
  (void)state;
  fg_context *context;
  fg_field *field;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, "vortex3", 193),
                   FG_STATUS_OK);
  int usual = cycles_at(context, field, 0.15);
  assert_true(2 * cycles_at(context, field, 0.3) < 3 * usual);
  assert_true(2 * cycles_at(context, field, 0.5) < 3 * usual);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weak_anisotropy_costs_little_more),
  };
  return cmocka_run_group_tests_name("evolution/weak_anisotropy", tests, NULL, NULL);
}
