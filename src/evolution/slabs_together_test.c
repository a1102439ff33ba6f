/* An evolution of a field that ranks share is that of the whole, to the bit. */
#include "grid/slabs_test.h"

#include <math.h>

enum { WIDE = 57, HIGH = 97, DEEP = 9, MOST = WIDE * HIGH * DEEP };

/* Rougher than the mesh in one half, uneven along y. */
static fg_field *field_of(int dimension, const bool periodic[3], bool masked)
{
  static float sample[3][MOST];
  static const int size[3] = {WIDE, HIGH, DEEP};
  double axis[3][HIGH];
  fg_field_arrays arrays = {.dimension = dimension};
  int count = 1;
  for (int k = 0; k < dimension; ++k) {
    for (int n = 0; n < size[k]; ++n)
      axis[k][n] = 0.1 * n + (k == 1 ? 0.03 * (n % 2) : 0.0);
    arrays.size[k] = size[k];
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = sample[k];
    arrays.period[k] = periodic[k] ? 0.1 * size[k] + 0.01 : 0.0;
    count *= size[k];
  }
  for (int n = 0; n < count; ++n) {
    int x = n % WIDE, y = n / WIDE % HIGH, z = n / WIDE / HIGH;
    sample[0][n] = (float)(1.0 + 0.7 * sin(0.5 * y + 0.2 * z + x * x * 0.02));
    sample[1][n] = (float)(0.8 * cos(0.6 * x + 0.3 * z));
    sample[2][n] = (float)(0.3 + 0.6 * sin(0.5 * x - y));
    bool hole = (x > 40 && y > 9 && y < 31) || (x < 4 && y > HIGH - 3);
    if (masked && hole && z % 5 < 3)
      sample[1][n] = NAN;
  }
  fg_field *out = NULL;
  expect(fg_field_create(&out, us.context, &arrays) == FG_STATUS_OK);
  return out;
}

/* Three steps; *u is gathered on rank 0. */
static fg_step evolve(fg_density **u, const fg_field *field,
                      const fg_evolution_options *options)
{
  fg_step step = {0};
  fg_evolution *evolution;
  fg_density *shared = NULL;
  *u = NULL;
  fg_status status = fg_evolution_create(&evolution, us.context, field, options);
  for (int n = 0; n < 3 && !status; ++n)
    status = fg_evolution_step(evolution, &step);
  if (!status)
    status = fg_density_create(&shared, evolution);
  if (!status)
    status = fg_density_gather(u, us.context, shared);
  expect(status == FG_STATUS_OK);
  fg_density_destroy(shared);
  fg_evolution_destroy(evolution);
  return step;
}

static void compare(const fg_field *whole, const fg_evolution_options *options)
{
  fg_field *part = joined_slab_of(whole);
  fg_density *got, *want;
  fg_step a = evolve(&got, part, options), b = evolve(&want, whole, options);
  expect(a.energy == b.energy && a.mass == b.mass && a.cells == b.cells);
  expect(a.tau == b.tau && a.area_fraction == b.area_fraction);
  if (us.ranks->rank == 0 && got && want) {
    const fg_density_arrays *g = fg_density_contents(got);
    size_t count = (size_t)g->nodes[0] * (size_t)g->nodes[1] * (size_t)g->nodes[2];
    expect(memcmp(g->u, fg_density_contents(want)->u, count * sizeof(float)) == 0);
  }
  fg_density_destroy(got);
  fg_density_destroy(want);
  fg_field_destroy(part);
}

static void slabs_evolve_as_the_whole(void **state)
{
  (void)state;
  static const fg_energy energies[] = {FG_ENERGY_FLOW, FG_ENERGY_GRADIENT,
                                       FG_ENERGY_ISOTROPIC};
  for (int n = 0; n < 12 && us.ranks->count > 1; ++n) {
    const bool periodic[3] = {n & 1, n & 2, n & 4};
    int dimension = n % 3 == 2 ? 3 : 2;
    fg_field *whole = field_of(dimension, periodic, n % 2);
    fg_evolution_options options = {.nodes = dimension == 3 ? 33 : 65,
                                    .energy = energies[n / 2 % 3]};
    if (dimension == 2 || n < 6)
      compare(whole, &options);
    options.nodes = 17; /* six samples a cell along y */
    compare(whole, &options);
    fg_field_destroy(whole);
  }
  end_together();
}

static void a_part_must_be_joined(void **state)
{
  (void)state;
  const bool periodic[3] = {false};
  fg_field *whole = field_of(2, periodic, false), *part = NULL;
  fg_evolution *evolution = NULL;
  if (us.ranks->count > 1) {
    expect(slab_of_arrays(&part, fg_field_contents(whole)) == FG_STATUS_OK);
    expect(fg_evolution_create(&evolution, us.context, part, NULL) == FG_STATUS_ARGUMENT);
    expect(!evolution && strstr(fg_context_message(us.context), "not joined"));
  }
  fg_field_destroy(part);
  fg_field_destroy(whole);
  end_together();
}

static void is_refused(const fg_field *field, const fg_evolution_options *options,
                       const char *words)
{
  fg_evolution *evolution = NULL;
  fg_status status = fg_evolution_create(&evolution, us.context, field, options);
  if (us.ranks->count == 1) {
    expect(status == FG_STATUS_OK);
  } else {
    expect(status == FG_STATUS_ARGUMENT && !evolution);
    expect(strstr(fg_context_message(us.context), words) != NULL);
  }
  fg_context_clear(us.context);
  fg_evolution_destroy(evolution);
}

/* One rank alone wants something else, and be it one value of all. */
static void ranks_that_disagree_are_told(void **state)
{
  (void)state;
  enum { NODES = 33 };
  fg_field *field;
  expect(fg_field_create_analytic(&field, us.context, "vortex3", NODES) == FG_STATUS_OK);
  bool odd = us.ranks->rank == us.ranks->count - 1;
  fg_evolution_options options = {.nodes = NODES, .seed = odd ? 2 : 1};
  is_refused(field, &options, "different fields or options");
  options = (fg_evolution_options){.nodes = NODES, .anisotropy = odd ? 0.25 : 0.125};
  is_refused(field, &options, "different fields or options");
  float initial[NODES * NODES];
  for (int n = 0; n < NODES * NODES; ++n)
    initial[n] = n % 7 < 3 ? 0.875F : -0.75F;
  initial[40] = odd ? 0.5F : -0.5F;
  options = (fg_evolution_options){.nodes = NODES, .initial = initial};
  is_refused(field, &options, "different initial densities");
  fg_field_destroy(field);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(slabs_evolve_as_the_whole),
      TOGETHER(a_part_must_be_joined),
      TOGETHER(ranks_that_disagree_are_told),
  };
  return cmocka_run_group_tests_name("evolution/slabs", tests, NULL, NULL);
}
