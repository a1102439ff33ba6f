/* Whole runs on a domain of small subdomains, passages and dead ends a few cells wide
 * come to their end, which is often a pattern at rest, about as soon as runs on an open
 * one; where interfaces stand across passages for good, cycles do not make steps fail. */
#include <limits.h>
#include <math.h>

#include "base/context_test.h"

enum { SIDE = 129, SEEDS = 3, CLUSTERS = 12 };

static fg_field *create_field(fg_context *context, bool with_subdomains)
{
  static double axis[SIDE];
  static float u[SIDE * SIDE], v[SIDE * SIDE];
  static unsigned char valid[SIDE * SIDE];
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i) {
      int n = j * SIDE + i;
      double x = i / (SIDE - 1.0), y = j / (SIDE - 1.0);
      u[n] = (float)(sin(7.0 * y + 2.0 * x) + 0.3);
      v[n] = (float)cos(5.0 * x - 1.5 * y);
      double height = sin(31.0 * x + 3.0 * y) * sin(23.0 * y - 7.0 * x) +
                      0.7 * sin(67.0 * x - 41.0 * y) * sin(59.0 * y + 29.0 * x);
      valid[n] = height > -0.22;
    }
  for (int i = 0; i < SIDE; ++i)
    axis[i] = i;
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {SIDE, SIDE, 1},
                            .axis = {axis, axis},
                            .velocity = {u, v},
                            .valid = with_subdomains ? valid : NULL};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* What a run took. */
typedef struct effort {
  int cycles, rejected, steps;
} effort;

static effort effort_of_run(fg_context *context, const fg_field *field, uint64_t seed,
                            int most)
{
  fg_evolution_options options = {.nodes = SIDE, .seed = seed, .threads = 1};
  fg_evolution *evolution;
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  fg_step step;
  int cycles = 0, rejected = 0;
  do {
    assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    cycles += step.cycles;
    rejected += step.rejected;
  } while ((step.clusters == 0 || step.clusters > CLUSTERS) && !step.stationary &&
           cycles <= most);
  print_message(
      "# seed %d: %ld of %ld cells, %d clusters after %ld steps, %d rejected, %d "
      "cycles\n",
      (int)seed, fg_evolution_mesh(evolution)->active_cells,
      (long)(SIDE - 1) * (SIDE - 1), step.clusters, step.step, rejected, cycles);
  fg_evolution_destroy(evolution);
  return (effort){cycles, rejected, (int)step.step};
}

static void small_subdomains_cost_little_more_than_an_open_domain(void **state)
{
  (void)state;
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *open = create_field(context, false),
           *subdomains = create_field(context, true);
  int most = 4 * effort_of_run(context, open, 1, INT_MAX).cycles;
  int rejected = 0, steps = 0;
  for (uint64_t seed = 1; seed <= SEEDS; ++seed) {
    effort run = effort_of_run(context, subdomains, seed, most);
    assert_true(run.cycles <= most);
    rejected += run.rejected;
    steps += run.steps;
  }
  assert_true(25 * rejected <= steps);
  fg_field_destroy(open);
  fg_field_destroy(subdomains);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(small_subdomains_cost_little_more_than_an_open_domain),
  };
  return cmocka_run_group_tests_name("evolution/subdomains", tests, NULL, NULL);
}
