/* One implicit Euler step of a problem by flowgrain's own multigrid cycles, at the least
 * cost that reaches a wanted accuracy.
 * Usage: bench_step PROBLEM TAU REFERENCE ERROR REPETITIONS
 * REFERENCE holds the converged step; ERROR is what is allowed, rms, as a share of the
 * step's own change. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "problem.h"
#include "solver/multigrid_test.h"
#include "solver/passes.h"

enum { MOST_CYCLES = 500 };

static fg_status create(fg__multigrid *out, fg_context *context, const problem *p)
{
  size_t count = problem_cell_count(p), entries = (size_t)problem_tensor_entries(p);
  float *memory = fg__allocate(entries * count, sizeof *memory);
  unsigned char *active = fg__allocate(count, 1);
  fg_status status = FG_STATUS_MEMORY;
  if (memory && active) {
    for (size_t n = 0; n < entries * count; ++n)
      memory[n % entries * count + n / entries] = p->tensor[n];
    memset(active, 1, count);
    fg__tensor tensor = {.xx = memory, .xy = memory + count, .active = active};
    if (p->dimension == 2) {
      tensor.yy = memory + 2 * count;
    } else {
      tensor.xz = memory + 2 * count;
      tensor.yy = memory + 3 * count;
      tensor.yz = memory + 4 * count;
      tensor.zz = memory + 5 * count;
    }
    fg__mesh mesh = {.dimension = p->dimension};
    for (int k = 0; k < 3; ++k) {
      mesh.cells[k] = p->cells[k];
      mesh.spacing[k] = p->spacing[k];
    }
    status = multigrid_of_tensor(out, context, &mesh, &tensor, p->gamma, NULL);
  }
  free(memory);
  free(active);
  return status;
}

/* The density before the step as first guess, with its own potential. */
static void start(const fg__multigrid *m, const float *u)
{
  const fg__level *level = &m->level[0];
  fg__level_import(level, level->p, u);
  fg__fill_ghosts(level, level->p);
  fg__level_import(level, level->u, u);
  fg__fill_ghosts(level, level->u);
  fg__pass_evaluate(m, level->u, level->w);
}

static double error_of(const fg__multigrid *m, const problem *p, const double *reference,
                       float *plain, double *values)
{
  fg__level_export(&m->level[0], m->level[0].u, plain);
  size_t count = problem_node_count(p);
  for (size_t n = 0; n < count; ++n)
    values[n] = (double)plain[n];
  return problem_distance(p, values, reference);
}

static int measure(const fg__multigrid *m, const problem *p, double tau,
                   const double *reference, double wanted, int repetitions)
{
  size_t count = problem_node_count(p);
  float *plain = malloc(count * sizeof *plain);
  double *values = malloc(count * sizeof *values);
  if (!plain || !values) {
    free(plain);
    free(values);
    return 1;
  }
  for (size_t n = 0; n < count; ++n)
    values[n] = (double)p->u[n];
  double change = problem_distance(p, values, reference), error = INFINITY;
  start(m, p->u);
  int cycles = 0;
  while (cycles < MOST_CYCLES && !(error <= wanted * change)) {
    fg__pass_solve(m, tau, 1, NULL);
    ++cycles;
    error = error_of(m, p, reference, plain, values);
  }
  double least = INFINITY, least_wall = INFINITY;
  for (int n = 0; n < repetitions; ++n) {
    double processor = processor_seconds(), wall = wall_seconds();
    start(m, p->u);
    fg__pass_solve(m, tau, cycles, NULL);
    least = fmin(least, processor_seconds() - processor);
    least_wall = fmin(least_wall, wall_seconds() - wall);
  }
  printf("cpu %.5f wall %.5f error %.2e change %.4f MB %.0f iterations %d %s\n", least,
         least_wall, error / change, change, most_megabytes(), cycles,
         error <= wanted * change ? "cycles" : "cycles (not reached)");
  free(plain);
  free(values);
  return 0;
}

int main(int argc, char **argv)
{
  problem p;
  fg_context *context;
  fg__multigrid multigrid = {0};
  if (argc != 6) {
    fprintf(stderr, "usage: bench_step PROBLEM TAU REFERENCE ERROR REPETITIONS\n");
    return 2;
  }
  if (!problem_read(&p, argv[1]) || fg_context_create(&context))
    return 1;
  double *reference = problem_read_density(&p, argv[3]);
  int result = 1;
  if (reference && !create(&multigrid, context, &p))
    result =
        measure(&multigrid, &p, atof(argv[2]), reference, atof(argv[4]), atoi(argv[5]));
  else
    fprintf(stderr, "bench_step: %s\n", fg_context_message(context));
  free(reference);
  fg__multigrid_clear(&multigrid);
  fg_context_destroy(context);
  problem_clear(&p);
  return result;
}
