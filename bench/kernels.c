/* Times the evolution's inner loops, one line each: microseconds and nanoseconds a node.
 * Usage: bench_kernels [CELLS ...]; least of 30 repetitions, one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/memory.h"
#include "evolve/multigrid.h"

enum { REPETITIONS = 30, CALLS = 5 };

typedef struct subject {
  fg__multigrid multigrid;
  float *previous, *potential;
  float tau;
} subject;

typedef void operation(const subject *s);

static void smooth(const subject *s)
{
  s->multigrid.kernel->smooth(&s->multigrid.level[0], s->tau);
}

static void descend(const subject *s)
{
  s->multigrid.kernel->smooth_restrict(&s->multigrid.level[0], &s->multigrid.level[1],
                                       s->tau);
}

static void ascend(const subject *s)
{
  s->multigrid.kernel->prolong_smooth(&s->multigrid.level[1], &s->multigrid.level[0],
                                      s->tau);
}

static void cycle(const subject *s)
{
  fg__multigrid_cycle(&s->multigrid, (double)s->tau);
}

static void evaluate(const subject *s)
{
  const fg__level *level = &s->multigrid.level[0];
  s->multigrid.kernel->evaluate(level, level->u, s->potential);
}

static void changes(const subject *s)
{
  const fg__level *level = &s->multigrid.level[0];
  s->multigrid.kernel->changes(level, level->u, s->previous, s->potential, level->p);
}

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double least_seconds(operation *run, const subject *s)
{
  double least = INFINITY;
  for (int n = 0; n < REPETITIONS; ++n) {
    double start = now();
    for (int call = 0; call < CALLS; ++call)
      run(s);
    least = fmin(least, (now() - start) / CALLS);
  }
  return least;
}

/* A turning field with the default anisotropy and interface width. */
static fg_status prepare(subject *s, fg_context *context, int cells)
{
  const double anisotropy = 0.15, interface_cells = 1.1;
  size_t count = (size_t)cells * (size_t)cells;
  fg__tensor tensor = {fg__allocate(count, sizeof(float)),
                       fg__allocate(count, sizeof(float)),
                       fg__allocate(count, sizeof(float)), fg__allocate(count, 1)};
  if (!tensor.xx || !tensor.xy || !tensor.yy || !tensor.active)
    return FG_STATUS_MEMORY;
  for (size_t n = 0; n < count; ++n) {
    double angle =
        3.0 * (double)(n % (size_t)cells) / cells + 2.0 * (double)n / (double)count;
    double x = cos(angle), y = sin(angle);
    tensor.xx[n] = (float)(x * x + anisotropy * y * y);
    tensor.xy[n] = (float)((1.0 - anisotropy) * x * y);
    tensor.yy[n] = (float)(y * y + anisotropy * x * x);
    tensor.active[n] = 1;
  }
  double h = 1.0 / cells, width = interface_cells * h;
  fg__mesh mesh = {.cells = {cells, cells}, .spacing = {h, h}};
  fg__tile tile = {.cells = {cells, cells}};
  fg_status status = fg__multigrid_create(&s->multigrid, context, &mesh, &tile, &tensor,
                                          width * width / anisotropy);
  free(tensor.xx);
  free(tensor.xy);
  free(tensor.yy);
  free(tensor.active);
  if (status)
    return status;
  fg__level *level = &s->multigrid.level[0];
  s->previous = fg__allocate_aligned(2 * level->array_size, sizeof(float));
  if (!s->previous)
    return FG_STATUS_MEMORY;
  s->previous += level->first;
  s->potential = s->previous + level->array_size;
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i) {
      *fg__node(level, level->u, i, j) = (float)(sin(0.11 * i) * cos(0.07 * j));
      *fg__node(level, level->p, i, j) = *fg__node(level, level->u, i, j);
    }
  fg__fill_ghosts(level, level->u);
  s->multigrid.kernel->evaluate(level, level->u, level->w);
  s->tau = (float)(100.0 * pow(h, 4.0) / (width * width / anisotropy));
  return FG_STATUS_OK;
}

static const struct {
  const char *name;
  operation *run;
} table[] = {{"smoothing sweep", smooth},        {"sweep and restriction", descend},
             {"prolongation and sweep", ascend}, {"V(1,1) cycle", cycle},
             {"energy and potential", evaluate}, {"norms of changes", changes}};

int main(int argc, char **argv)
{
  int sizes[] = {128, 256, 512, 1024};
  int count = argc > 1 ? argc - 1 : 4;
  for (int n = 0; n < count; ++n) {
    int cells = argc > 1 ? atoi(argv[n + 1]) : sizes[n];
    fg_context *context;
    subject s = {0};
    if (cells < 16 || cells % 8 || fg_context_create(&context) ||
        prepare(&s, context, cells)) {
      fprintf(stderr, "bench_kernels: %d cells a side: not possible\n", cells);
      return 1;
    }
    const fg__level *level = &s.multigrid.level[0];
    double nodes = (double)level->columns * (double)level->rows;
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
      double seconds = least_seconds(table[k].run, &s);
      printf("%-8s %5d^2  %-24s %10.1f us %8.3f ns/node\n", s.multigrid.kernel->name,
             cells + 1, table[k].name, 1e6 * seconds, 1e9 * seconds / nodes);
    }
    free(s.previous - level->first);
    fg__multigrid_clear(&s.multigrid);
    fg_context_destroy(context);
  }
  return 0;
}
