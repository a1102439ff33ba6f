/* Steps of one evolution, timed, on as many ranks and threads as it is started with:
 * bench/scaling makes tables of strong and weak scaling of it.
 *
 *     bench_scaling DIMENSION NODES COPIES STEPS THREADS
 *
 * The domain is COPIES unit squares (cubes) of NODES nodes a side in a row along the last
 * axis, with vortex3 (vortex3d) and its mirror images in turn: so many ranks can have a
 * whole one each. Prints the seconds of the set-up with the first step, the least and the
 * median of the steps that follow in ms, and the energy at last, which must not depend on
 * ranks and threads. */
#include <stdio.h>
#include <stdlib.h>

#include "flowgrain/flowgrain.h"
#include "flowgrain/mpi.h"

enum { MOST_STEPS = 1000 };

static void check(bool good, const char *what)
{
  if (good)
    return;
  fprintf(stderr, "bench_scaling: %s failed\n", what);
  exit(1);
}

typedef struct chain {
  fg_field_arrays arrays;
  double *axis; /* the last one's */
  float *velocity;
} chain;

/* Copies of a field, every second one turned round along the last axis. */
static chain chain_of(const fg_field_arrays *unit, int copies)
{
  int last = unit->dimension - 1, size = unit->size[last];
  size_t layer =
      last == 2 ? (size_t)unit->size[0] * (size_t)unit->size[1] : (size_t)unit->size[0];
  size_t layers = (size_t)(size - 1) * (size_t)copies + 1;
  chain c = {.arrays = *unit};
  c.axis = calloc(layers, sizeof *c.axis);
  c.velocity = calloc(layers * layer * (size_t)unit->dimension, sizeof *c.velocity);
  check(c.axis && c.velocity, "memory");
  c.arrays.size[last] = (int)layers;
  c.arrays.axis[last] = c.axis;
  for (int k = 0; k < unit->dimension; ++k)
    c.arrays.velocity[k] = c.velocity + (size_t)k * layers * layer;
  for (size_t l = 0; l < layers; ++l) {
    size_t copy = l / (size_t)(size - 1), at = l % (size_t)(size - 1);
    size_t from = copy % 2 == 0 ? at : (size_t)(size - 1) - at;
    c.axis[l] = (double)l / (size - 1);
    for (int k = 0; k < unit->dimension; ++k) {
      float sign = copy % 2 != 0 && k == last ? -1.0F : 1.0F;
      for (size_t n = 0; n < layer; ++n)
        c.velocity[((size_t)k * layers + l) * layer + n] =
            sign * unit->velocity[k][from * layer + n];
    }
  }
  return c;
}

static fg_field *make_field(int dimension, int copies)
{
  fg_field *unit, *field;
  const char *name = dimension == 3 ? "vortex3d" : "vortex3";
  check(!fg_field_create_analytic(&unit, NULL, name, 0), "the field");
  chain c = chain_of(fg_field_contents(unit), copies);
  check(!fg_field_create(&field, NULL, &c.arrays), "the field");
  fg_field_destroy(unit);
  free(c.axis);
  free(c.velocity);
  return field;
}

static int compare(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
  int given[5] = {0};
  for (int n = 0; n < 5 && n + 1 < argc; ++n)
    given[n] = atoi(argv[n + 1]);
  int dimension = given[0], nodes = given[1], copies = given[2], steps = given[3];
  if (argc != 6 || (dimension != 2 && dimension != 3) || nodes < 9 || copies < 1 ||
      steps < 2 || steps > MOST_STEPS || given[4] < 1) {
    fprintf(stderr, "usage: bench_scaling DIMENSION NODES COPIES STEPS THREADS\n");
    return 2;
  }
  fg_context *context;
  check(!MPI_Init(&argc, &argv), "MPI");
  check(!fg_context_create(&context), "a context");
  check(!fg_context_set_communicator(context, MPI_COMM_WORLD), "a communicator");
  fg_field *field = make_field(dimension, copies);
  fg_evolution *evolution;
  fg_evolution_options options = {.nodes = (nodes - 1) * copies + 1, .threads = given[4]};
  check(!fg_evolution_create(&evolution, context, field, &options), "the evolution");
  static double seconds[MOST_STEPS];
  fg_step step;
  double before = 0.0;
  for (int n = 0; n < steps; ++n) {
    check(!fg_evolution_step(evolution, &step), "a step");
    seconds[n] = step.seconds - before;
    before = step.seconds;
  }
  double setup = seconds[0];
  qsort(seconds + 1, (size_t)steps - 1, sizeof *seconds, compare);
  int rank, count;
  fg_ranks(context, &rank, &count);
  if (rank == 0)
    printf("%.3f %.3f %.3f %.9e\n", setup, 1e3 * seconds[1],
           1e3 * seconds[1 + (steps - 1) / 2], step.energy);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  MPI_Finalize();
  return 0;
}
