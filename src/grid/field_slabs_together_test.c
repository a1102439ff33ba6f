/* A field that ranks share tells each of them what the whole one would. */
#include "grid/slabs_test.h"

#include <math.h>

#include "field/fingerprint.h"
#include "field/mask.h"
#include "grid/grids_test.h"

enum { SEEDS = 24, WINDOWS = 9, TRIES = 60, MOST_SIDE = 40 };

/* Random samples on random axes, some missing; every rank makes the same. */
typedef struct example {
  fg_field_arrays arrays;
  double axis[3][MOST_SIDE];
  float *velocity[3];
  unsigned char *valid;
  size_t count;
} example;

static double random_between(uint64_t *seed, double low, double high)
{
  return low + (high - low) * (random_below(seed, 1 << 20) + 0.5) / (1 << 20);
}

static example example_at_random(uint64_t *seed, int dimension)
{
  example e = {.arrays = {.dimension = dimension}, .count = 1};
  for (int k = 0; k < dimension; ++k) {
    int n = e.arrays.size[k] = 5 + (int)random_below(seed, dimension == 3 ? 8 : 30);
    bool even = random_below(seed, 2);
    e.axis[k][0] = random_between(seed, -3.0, 3.0);
    for (int i = 1; i < n; ++i)
      e.axis[k][i] = e.axis[k][i - 1] + (even ? 0.25 : random_between(seed, 0.01, 1.0));
    if (random_below(seed, 2))
      e.arrays.period[k] = e.axis[k][n - 1] - e.axis[k][0] + 0.25;
    e.count *= (size_t)n;
  }
  e.valid = allocate_or_end(e.count, 1);
  for (int k = 0; k < dimension; ++k) {
    e.velocity[k] = allocate_or_end(e.count, sizeof(float));
    for (size_t n = 0; n < e.count; ++n)
      e.velocity[k][n] = (float)random_between(seed, -9.0, 9.0);
  }
  unsigned some_missing = random_below(seed, 3);
  for (size_t n = 0; n < e.count; ++n)
    e.valid[n] = !some_missing || random_below(seed, 12);
  return e;
}

static void example_clear(example *e)
{
  for (int k = 0; k < 3; ++k)
    free(e->velocity[k]);
  free(e->valid);
}

static void set_pointers(example *e)
{
  for (int k = 0; k < e->arrays.dimension; ++k) {
    e->arrays.axis[k] = e->axis[k];
    e->arrays.velocity[k] = e->velocity[k];
  }
  e->arrays.valid = e->valid;
}

static fg_status part_of(fg_field **out, const example *e)
{
  return slab_of_arrays(out, &e->arrays);
}

/* Points of a grid as wide as the domain, some of them, beyond the ends where it is
 * periodic. */
static fg__field_points points_at_random(const fg_field *field, int k, uint64_t *seed)
{
  const fg_field_arrays *a = fg_field_contents(field);
  bool periodic = a->period[k] > 0.0;
  double side = periodic ? a->period[k] : a->axis[k][a->size[k] - 1] - a->axis[k][0];
  fg__field_points out = {.all = 4 + (int)random_below(seed, 40)};
  bool cells = periodic || random_below(seed, 2);
  out.spacing = side / (cells ? out.all : out.all - 1);
  out.origin = a->axis[k][0] + (cells ? 0.5 * out.spacing : 0.0);
  out.count = 1 + (int)random_below(seed, (unsigned)out.all);
  out.first = (int)random_below(seed, (unsigned)(out.all - out.count + 1));
  if (periodic)
    out.first += (int)random_below(seed, (unsigned)out.all) - out.all / 2;
  return out;
}

static double point_between(const fg__field_points *points, uint64_t *seed)
{
  double n = points->first + random_between(seed, 0.0, 1.0) * (points->count - 1);
  if (random_below(seed, 2))
    n = floor(n + 0.5);
  return points->origin + n * points->spacing;
}

/* Returns how many points had a velocity. */
static int compare_window(const fg_field *window, const fg_field *whole,
                          const fg__field_points points[3], uint64_t *seed)
{
  int inside = 0;
  for (int n = 0; n < TRIES; ++n) {
    double position[3], got[3] = {0}, want[3] = {0};
    for (int k = 0; k < fg_field_contents(whole)->dimension; ++k)
      position[k] = point_between(&points[k], seed);
    bool has = fg_field_velocity(window, position, got);
    expect(has == fg_field_velocity(whole, position, want));
    expect(memcmp(got, want, sizeof got) == 0);
    inside += has;
  }
  return inside;
}

static void compare_windows(const fg_field *part, const fg_field *whole, uint64_t *seed,
                            uint64_t sums[2])
{
  fg__region region[WINDOWS];
  fg__field_points points[WINDOWS][3];
  fg_field *window[WINDOWS];
  for (int n = 0; n < WINDOWS; ++n) {
    region[n] = (fg__region){.nodes = {{0, 0, 0}, {1, 1, 1}}};
    region[n].rank = (int)random_below(seed, (unsigned)us.ranks->count);
    for (int k = 0; k < fg_field_contents(whole)->dimension; ++k) {
      points[n][k] = points_at_random(whole, k, seed);
      fg__field_span(&region[n].nodes.first[k], &region[n].nodes.nodes[k], part, k,
                     &points[n][k]);
    }
  }
  expect(fg__field_windows(window, us.context, us.ranks, part, region, WINDOWS) ==
         FG_STATUS_OK);
  for (int n = 0; n < WINDOWS; ++n) {
    expect(!window[n] == (region[n].rank != us.ranks->rank));
    if (window[n]) {
      uint64_t own_seed = *seed + (uint64_t)n;
      sums[0] += (uint64_t)compare_window(window[n], whole, points[n], &own_seed);
      sums[1] += fg__field_held(window[n]) < fg__field_held(whole);
    }
    fg_field_destroy(window[n]);
  }
}

static void compare_mask(const fg_field *part, const fg_field *whole)
{
  const fg_field_arrays *a = fg_field_contents(whole);
  for (int j = 0; j < a->size[1] && a->dimension == 2; ++j)
    for (int i = 0; i < a->size[0] && us.ranks->rank == 0; ++i)
      expect(fg__field_sample_is_valid(part, i, j) ==
             fg__field_sample_is_valid(whole, i, j));
}

static void slabs_tell_what_the_whole_does(void **state)
{
  (void)state;
  uint64_t seed = 5, sums[2] = {0};
  for (int n = 0; n < SEEDS && us.ranks->count > 1; ++n) {
    example e = example_at_random(&seed, 2 + n % 2);
    set_pointers(&e);
    fg_field *whole, *part;
    expect(fg_field_create(&whole, us.context, &e.arrays) == FG_STATUS_OK);
    expect(part_of(&part, &e) == FG_STATUS_OK);
    expect(fg__field_check_shared(us.context, us.ranks, part) == FG_STATUS_ARGUMENT);
    fg_context_clear(us.context);
    expect(fg__field_join(us.context, us.ranks, part) == FG_STATUS_OK);
    expect(fg__field_check_shared(us.context, us.ranks, part) == FG_STATUS_OK);
    expect(fg__field_fingerprint(part) == fg__field_fingerprint(whole));
    expect(fg__field_join(us.context, us.ranks, part) == FG_STATUS_OK); /* once more */
    expect(fg__field_fingerprint(part) == fg__field_fingerprint(whole));
    compare_mask(part, whole);
    compare_windows(part, whole, &seed, sums);
    fg_field_destroy(part);
    fg_field_destroy(whole);
    example_clear(&e);
  }
  fg__ranks_add(us.ranks, sums, 2);
  if (us.ranks->count > 1) /* the examples are what they are meant to be */
    expect(sums[0] > SEEDS * WINDOWS * TRIES / 4 && sums[1] > SEEDS * WINDOWS / 3);
  end_together();
}

/* What is to be said of the samples of all ranks together. */
static void check_refusal(example *e)
{
  fg_context *alone;
  if (fg_context_create(&alone) != FG_STATUS_OK)
    abort();
  fg_field *whole = NULL, *part = NULL;
  set_pointers(e);
  fg_status status = fg_field_create(&whole, alone, &e->arrays);
  expect(status == FG_STATUS_ARGUMENT);
  expect(part_of(&part, e) == FG_STATUS_OK);
  expect(fg__field_join(us.context, us.ranks, part) == status);
  expect(strcmp(fg_context_message(us.context), fg_context_message(alone)) == 0);
  fg_context_clear(us.context);
  fg_field_destroy(part);
  fg_field_destroy(whole);
  fg_context_destroy(alone);
}

static void the_samples_of_all_are_judged_together(void **state)
{
  (void)state;
  uint64_t seed = 77;
  for (int n = 0; n < 3 && us.ranks->count > 1; ++n) {
    example e = example_at_random(&seed, 2 + n % 2);
    for (size_t i = 0; i < e.count && n < 2; ++i)
      e.valid[i] = n == 1 && i % 7 == 3 && i / (size_t)e.arrays.size[0] % 2;
    for (size_t i = 0; i < e.count && n == 2; ++i) {
      e.velocity[0][i] = e.velocity[1][i] = 0.0f;
      e.valid[i] = i % 11 != 0;
    }
    check_refusal(&e);
    example_clear(&e);
  }
  end_together();
}

static void slabs_of_different_fields_are_refused(void **state)
{
  (void)state;
  uint64_t seed = 12;
  example e = example_at_random(&seed, 2);
  set_pointers(&e);
  fg_field *part = NULL;
  if (us.ranks->rank == us.ranks->count - 1)
    e.axis[0][0] -= 0.125;
  e.arrays.period[0] = 0.0;
  if (us.ranks->count > 1) {
    expect(part_of(&part, &e) == FG_STATUS_OK);
    expect(fg__field_join(us.context, us.ranks, part) == FG_STATUS_ARGUMENT);
    expect(strstr(fg_context_message(us.context), "different fields") != NULL);
  }
  fg_field_destroy(part);
  example_clear(&e);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(slabs_tell_what_the_whole_does),
      TOGETHER(the_samples_of_all_are_judged_together),
      TOGETHER(slabs_of_different_fields_are_refused),
  };
  return cmocka_run_group_tests_name("grid/field_slabs", tests, NULL, NULL);
}
