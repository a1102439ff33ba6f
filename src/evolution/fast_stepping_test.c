/* Fast stepping against a tight reference: the default accuracy and cycles a step
 * against six cycles and 0.01. What separates them must be far less than what separates
 * runs of different noise. docs/design quotes the table printed here. */
#include "evolution/curve_test.h"

enum { SEEDS = 5, CLUSTERS = 20 };

typedef struct comparison {
  curve *reference, *fast, *other[SEEDS - 1];
  double times[TIMES];
} comparison;

static int set_up(void **state)
{
  static comparison c;
  fg_evolution_options options = {.nodes = 257, .accuracy = 0.01, .cycles = 6, .seed = 1};
  /* the times to look at follow from the fast run: from the first counts on */
  curve *scout = run_curve("vortex3", &(fg_evolution_options){.nodes = 257, .seed = 1},
                           CLUSTERS, 0.0, NULL);
  spread_times(1.3 * first_count_time(scout), end_of(scout), c.times);
  destroy_curve(scout);
  double end = c.times[TIMES - 1];
  c.reference = run_curve("vortex3", &options, 0, end, c.times);
  options = (fg_evolution_options){.nodes = 257, .seed = 1};
  c.fast = run_curve("vortex3", &options, 0, end, c.times);
  for (int k = 0; k < SEEDS - 1; ++k) {
    options.seed = (uint64_t)k + 2;
    c.other[k] = run_curve("vortex3", &options, 0, end, c.times);
  }
  *state = &c;
  return 0;
}

static int tear_down(void **state)
{
  comparison *c = *state;
  destroy_curve(c->reference);
  destroy_curve(c->fast);
  for (int k = 0; k < SEEDS - 1; ++k)
    destroy_curve(c->other[k]);
  return 0;
}

/* Means over all times of |fast - reference| and of the scatter of seeds, both relative.
 */
static void compare(const comparison *c, double (*value)(const curve *, double),
                    double *difference, double *scatter)
{
  *difference = *scatter = 0.0;
  for (int k = 0; k < TIMES; ++k) {
    double seeds[SEEDS], reference = value(c->reference, c->times[k]);
    seeds[0] = value(c->fast, c->times[k]);
    for (int s = 1; s < SEEDS; ++s)
      seeds[s] = value(c->other[s - 1], c->times[k]);
    *difference += fabs(seeds[0] - reference) / reference / TIMES;
    *scatter += scatter_of(seeds, SEEDS) / reference / TIMES;
  }
}

static double clusters_of(const curve *c, double time)
{
  return clusters_at(c, time);
}

static void the_number_of_clusters_follows_the_reference(void **state)
{
  const comparison *c = *state;
  for (int k = 0; k < TIMES; ++k)
    print_message(
        "# t = %.3g: N = %d, reference %d, other seeds %d %d %d %d\n", c->times[k],
        clusters_at(c->fast, c->times[k]), clusters_at(c->reference, c->times[k]),
        clusters_at(c->other[0], c->times[k]), clusters_at(c->other[1], c->times[k]),
        clusters_at(c->other[2], c->times[k]), clusters_at(c->other[3], c->times[k]));
  double difference, scatter;
  compare(c, clusters_of, &difference, &scatter);
  print_message("# N: %.1f %% from the reference, seeds scatter by %.1f %%\n",
                100.0 * difference, 100.0 * scatter);
  assert_true(difference < 0.5 * scatter);
}

static void the_energy_follows_the_reference(void **state)
{
  double difference, scatter;
  compare(*state, energy_at, &difference, &scatter);
  print_message("# E: %.2f %% from the reference, seeds scatter by %.2f %%\n",
                100.0 * difference, 100.0 * scatter);
  assert_true(difference < 0.5 * scatter);
}

/* Area of both sets {u > 0} over the area of either. */
static double overlap(const curve *a, const curve *b, int k)
{
  size_t both = 0, either = 0;
  for (size_t n = 0; n < a->nodes; ++n) {
    bool in_a = a->density[k][n] > 0.0F, in_b = b->density[k][n] > 0.0F;
    both += in_a && in_b;
    either += in_a || in_b;
  }
  return (double)both / (double)either;
}

static void the_clusters_are_those_of_the_reference(void **state)
{
  const comparison *c = *state;
  for (int k = 0; k < TIMES; ++k) {
    double same = overlap(c->reference, c->fast, k), other = 0.0;
    for (int s = 0; s < SEEDS - 1; ++s)
      other = fmax(other, overlap(c->reference, c->other[s], k));
    print_message("# t = %.3g: overlap %.3f, other seeds at most %.3f\n", c->times[k],
                  same, other);
    assert_true(1.0 - same < 0.2 * (1.0 - other));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_number_of_clusters_follows_the_reference),
      cmocka_unit_test(the_energy_follows_the_reference),
      cmocka_unit_test(the_clusters_are_those_of_the_reference),
  };
  return cmocka_run_group_tests_name("evolution/fast_stepping", tests, set_up, tear_down);
}
