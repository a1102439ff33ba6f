/* Every allocation of one of several ranks fails once, while they evolve, save, halve
 * their mesh and go on: all are told of it alike, none waits for the others, nothing is
 * left behind. */
#include "base/refusal_test.h"
#include "evolution/checkpoint/place_test.h"
#include "evolution/evolution.h"
#include "grid/slabs_test.h"

#include <math.h>

enum { COLUMNS = 22, ROWS = 26, LAYERS = 3 };

typedef struct example {
  const fg_field *field;
  int nodes;
  bool masked;
} example;

static int failures;  /* in what was just lived through */
static long created;  /* what was asked for by the time an evolution was there */
static long again[2]; /* by the time another like it was begun, and was there */

/* False: there was no memory for it, once. */
static bool done(fg_status status)
{
  if (status == FG_STATUS_OK)
    return true;
  expect(status == FG_STATUS_MEMORY);
  ++failures;
  fg_context_clear(us.context);
  return false;
}

#define again_if_need_be(call)                                                           \
  do {                                                                                   \
    if (!done(call))                                                                     \
      expect((call) == FG_STATUS_OK);                                                    \
  } while (0)

/* Blobs, which are counted as clusters. */
static float *initial_density(const fg_evolution *evolution)
{
  const int *cells = fg_evolution_mesh(evolution)->cells;
  size_t row = (size_t)cells[0] + 1, count = row;
  for (int k = 1; k < fg_evolution_mesh(evolution)->dimension; ++k)
    count *= (size_t)cells[k] + 1;
  float *u = allocate_or_end(count, sizeof *u);
  for (size_t n = 0; n < count; ++n)
    u[n] =
        sin(0.7 * (double)(n % row)) * cos(0.6 * (double)(n / row)) > 0.1 ? 0.9F : -0.9F;
  return u;
}

/* A checkpoint goes on; its mesh is coarsened as often. */
static void resume(const example *x, const fg_evolution_options *options)
{
  fg_checkpoint *checkpoint = NULL;
  fg_evolution *later = NULL;
  fg_step step;
  again_if_need_be(fg_checkpoint_open(&checkpoint, us.context, path));
  again[0] = asked;
  bool ready = done(fg_evolution_create(&later, us.context, x->field, options));
  again[1] = asked;
  if (ready && done(fg_evolution_resume(later, &step, checkpoint)))
    again_if_need_be(fg_evolution_step(later, &step));
  fg_evolution_destroy(later);
  fg_checkpoint_destroy(checkpoint);
}

static void grow_and_show(const example *x, const fg_evolution_options *options)
{
  fg_evolution *evolution = NULL;
  fg_density *density = NULL, *whole = NULL;
  fg_step step = {0};
  if (done(fg_evolution_create(&evolution, us.context, x->field, options))) {
    created = asked;
    evolution->counting = true; /* there are clusters to begin with */
    again_if_need_be(fg_evolution_step(evolution, &step));
    again_if_need_be(fg_evolution_step(evolution, &step));
    expect(step.clusters > 0);
    again_if_need_be(fg_density_create(&density, evolution));
    if (fg_density_is_distributed(density))
      again_if_need_be(fg_density_gather(&whole, us.context, density));
  }
  fg_density_destroy(density);
  fg_density_destroy(whole);
  fg_evolution_destroy(evolution);
}

static void halve_and_resume(const example *x, const fg_evolution_options *options)
{
  fg_evolution *evolution = NULL;
  fg_step step;
  bool good = done(fg_evolution_create(&evolution, us.context, x->field, options));
  created = asked;
  if (good && !x->masked)
    good = done(fg_evolution_coarsen(evolution, &step));
  if (good) {
    again_if_need_be(fg_evolution_save(evolution, path, "half"));
    resume(x, options);
    again_if_need_be(fg_evolution_step(evolution, &step));
  }
  fg_evolution_destroy(evolution);
}

typedef void life(const example *x, const fg_evolution_options *options);

/* What was asked for on a rank, for all to know. */
static long known(long number, int rank)
{
  double value = us.ranks->rank == rank ? (double)number : 0.0;
  fg__ranks_greatest(us.ranks, &value, 1);
  return (long)value;
}

static void fail_in_turn(life *live, const example *x,
                         const fg_evolution_options *options, int rank,
                         bool from_the_beginning)
{
  asked = unfreed = failures = 0;
  again[0] = again[1] = 0;
  live(x, options);
  expect(unfreed == 0 && failures == 0);
  long all = known(asked, rank), first = from_the_beginning ? 0 : known(created, rank);
  /* what is made alike again does not fail, of what resumes it one in four does */
  long leave = known(again[0], rank), go_on = known(again[1], rank);
  double faults = 0.0;
  bool repeated = from_the_beginning && go_on > leave;
  for (long n = first; n < all && faults == 0.0; n += repeated && n >= go_on ? 4 : 1) {
    if (repeated && n == leave)
      n = go_on;
    asked = unfreed = failures = 0;
    failing = us.ranks->rank == rank ? n : -1;
    live(x, options);
    failing = -1;
    expect(unfreed == 0 && failures == 1);
    if (us.faults)
      fprintf(stderr, "rank %d, allocation %ld of %ld: %d failures, %ld left\n", rank, n,
              all, failures, unfreed);
    faults = us.faults;
    fg__ranks_greatest(us.ranks, &faults, 1);
  }
}

/* Of rank 0 until clusters are there, of the last while the mesh is coarsened. */
static void fail_all(const example *x, bool growing)
{
  fg_evolution_options options = {.nodes = x->nodes, .threads = 1, .coverage = 0.2};
  fg_evolution *probe = NULL;
  expect(fg_evolution_create(&probe, us.context, x->field, &options) == FG_STATUS_OK);
  float *u = initial_density(probe);
  fg_evolution_destroy(probe);
  options.initial = u;
  if (growing)
    fail_in_turn(grow_and_show, x, &options, 0, true);
  fail_in_turn(halve_and_resume, x, &options, us.ranks->count - 1, !growing);
  free(u);
}

/* Walls divide it, when it is masked, into a small subdomain too. */
static fg_field *field_of(int dimension, bool masked)
{
  static float sample[3][COLUMNS * ROWS * LAYERS];
  static const int size[3] = {COLUMNS, ROWS, LAYERS};
  double axis[3][ROWS];
  fg_field_arrays arrays = {.dimension = dimension};
  int count = 1;
  for (int k = 0; k < dimension; ++k) {
    for (int n = 0; n < size[k]; ++n)
      axis[k][n] = (k + 1 == dimension ? 2.0 : 1.0) * n / (size[k] - 1);
    arrays.size[k] = size[k];
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = sample[k];
    count *= size[k];
  }
  for (int n = 0; n < count; ++n) {
    int x = n % COLUMNS, y = n / COLUMNS % ROWS;
    bool wall = x == 12 || (y == 5 && x < 6) || (x == 5 && y < 6);
    sample[0][n] = masked && wall ? (float)NAN : (float)cos(0.3 * x + 0.4 * y);
    sample[1][n] = (float)sin(0.2 * y - 0.1 * x);
    sample[2][n] = 0.3F;
  }
  fg_field *out = NULL;
  expect(fg_field_create(&out, us.context, &arrays) == FG_STATUS_OK);
  return out;
}

static void in_2d(void **state)
{
  (void)state;
  fg_field *field = field_of(2, false);
  fail_all(&(example){field, 33, false}, true);
  fg_field_destroy(field);
  end_together();
}

static void with_a_mask(void **state)
{
  (void)state;
  fg_field *field = field_of(2, true);
  fail_all(&(example){field, 33, true}, true);
  fg_field_destroy(field);
  end_together();
}

static void of_parts_in_3d(void **state)
{
  (void)state;
  fg_field *whole = field_of(3, false), *part = joined_slab_of(whole);
  fail_all(&(example){part ? part : whole, 33, false}, false);
  fg_field_destroy(part);
  fg_field_destroy(whole);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {TOGETHER(in_2d), TOGETHER(with_a_mask),
                                     TOGETHER(of_parts_in_3d)};
  return cmocka_run_group_tests_name("evolution/exhaustion_together", tests,
                                     name_checkpoint, remove_checkpoint);
}
