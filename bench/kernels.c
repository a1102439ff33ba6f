/* Times the evolution's inner loops, a row of a table each, and sets the time beside what
 * the machine needs for moving their bytes and doing their arithmetic (floor.h).
 * Usage: bench_kernels [CELLS[x3] ...], x3 for a cube; least of 30 repetitions, one
 * thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "floor.h"
#include "solver/multigrid_test.h"
#include "solver/passes.h"

enum { REPETITIONS = 30, CALLS = 5 };

static const fg__thread ALONE = {.count = 1};

typedef struct subject {
  fg__multigrid multigrid;
  float *previous, *potential;
  float tau;
} subject;

typedef void operation(const subject *s);

static void smooth(const subject *s)
{
  s->multigrid.kernel->smooth(&s->multigrid.level[0], s->tau, &ALONE);
}

static void descend(const subject *s)
{
  const fg__kernel *kernel = s->multigrid.kernel;
  const fg__level *level = s->multigrid.level;
  kernel->restrict_residuals(&level[0], &level[1], s->tau, &ALONE);
  kernel->find_scale(&level[1], &ALONE);
  kernel->find_curvature(&level[1], s->tau, &ALONE);
}

static void ascend(const subject *s)
{
  const fg__level *level = s->multigrid.level;
  s->multigrid.kernel->correct_smooth(&level[1], &level[0], s->tau, &ALONE);
}

static void ascend_and_descend(const subject *s)
{
  const fg__level *level = s->multigrid.level;
  s->multigrid.kernel->correct_smooth_restrict(&level[1], &level[0], s->tau, &ALONE);
}

static void step(const subject *s)
{
  fg__pass_solve(&s->multigrid, (double)s->tau, 3, s->potential);
}

static void evaluate(const subject *s)
{
  const fg__level *level = &s->multigrid.level[0];
  s->multigrid.kernel->evaluate(level, level->u, s->potential, &ALONE);
}

static void changes(const subject *s)
{
  const fg__level *level = &s->multigrid.level[0];
  s->multigrid.kernel->changes(level, level->u, s->previous, s->potential, level->p,
                               &ALONE);
}

static double least_seconds(operation *run, const subject *s)
{
  double least = (double)INFINITY;
  for (int n = 0; n < REPETITIONS; ++n) {
    double start = floor_clock();
    for (int call = 0; call < CALLS; ++call)
      run(s);
    least = fmin(least, (floor_clock() - start) / CALLS);
  }
  return least;
}

/* A turning field with the default anisotropy and interface width. */
static void fill_tensor(const fg__tensor *tensor, size_t count, int cells, double a)
{
  for (size_t n = 0; n < count; ++n) {
    double angle =
        3.0 * (double)(n % (size_t)cells) / cells + 2.0 * (double)n / (double)count;
    double x = cos(angle), y = sin(angle);
    tensor->xx[n] = (float)(x * x + a * y * y);
    tensor->xy[n] = (float)((1.0 - a) * x * y);
    tensor->yy[n] = (float)(y * y + a * x * x);
    tensor->active[n] = 1;
    if (tensor->zz)
      tensor->zz[n] = (float)a;
  }
}

static fg_status create_multigrid(subject *s, fg_context *context, int cells,
                                  int dimension)
{
  const double anisotropy = 0.15, interface_cells = 1.1;
  size_t count = (size_t)pow(cells, dimension);
  fg__tensor tensor = {.active = fg__allocate(count, 1)};
  float **components[6] = {&tensor.xx, &tensor.xy, &tensor.yy,
                           &tensor.zz, &tensor.xz, &tensor.yz};
  bool whole = tensor.active;
  for (int n = 0; n < (dimension == 3 ? 6 : 3); ++n) {
    *components[n] = fg__allocate(count, sizeof(float));
    whole = whole && *components[n];
  }
  fg_status status = FG_STATUS_MEMORY;
  double h = 1.0 / cells, width = interface_cells * h, gamma = width * width / anisotropy;
  if (whole) {
    fill_tensor(&tensor, count, cells, anisotropy);
    fg__mesh mesh = {.dimension = dimension,
                     .cells = {cells, cells, dimension == 3 ? cells : 1},
                     .spacing = {h, h, h}};
    status = multigrid_of_tensor(&s->multigrid, context, &mesh, &tensor, gamma, NULL);
  }
  for (int n = 0; n < 6; ++n)
    free(*components[n]);
  free(tensor.active);
  s->tau = (float)(100.0 * pow(h, 4.0) / gamma);
  return status;
}

static fg_status prepare(subject *s, fg_context *context, int cells, int dimension)
{
  fg_status status = create_multigrid(s, context, cells, dimension);
  if (status)
    return status;
  fg__level *level = &s->multigrid.level[0];
  const fg__layout *at = &level->layout;
  s->previous = fg__allocate_aligned(2 * at->array_size, sizeof(float));
  if (!s->previous)
    return FG_STATUS_MEMORY;
  s->previous += at->first;
  s->potential = s->previous + at->array_size;
  for (int k = 0; k < at->nodes[2]; ++k)
    for (int j = 0; j < at->nodes[1]; ++j)
      for (int i = 0; i < at->nodes[0]; ++i) {
        float value = (float)(sin(0.11 * i) * cos(0.07 * j + 0.13 * k));
        *fg__node(level, level->u, i, j, k) = value;
        *fg__node(level, level->p, i, j, k) = value;
      }
  fg__fill_ghosts(level, level->u);
  s->multigrid.kernel->evaluate(level, level->u, level->w, &ALONE);
  return FG_STATUS_OK;
}

/* Of a node, without a mask: floats read or written, in full or in part by the coarse
 * level that belongs to it, and operations, a division counted as one. Counted in the
 * source: in 2D there are 5 couplings a node, and a coarse level has a quarter of the
 * nodes; in 3D 14 and an eighth. */
typedef struct work {
  double floats, operations;
} work;

static const struct {
  const char *name;
  operation *run;
  work of_node[2]; /* 2D, 3D */
} table[] = {{"sweep", smooth, {{10, 53}, {19, 107}}},
             {"restriction", descend, {{8 + 33 / 4.0, 86}, {17 + 42 / 8.0, 161}}},
             {"correction, sweep", ascend, {{10 + 2 / 4.0, 64}, {19 + 2 / 8.0, 119}}},
             {"correction, sweep, restriction",
              ascend_and_descend,
              {{10 + 14 / 4.0, 140}, {19 + 14 / 8.0, 268}}},
             {"three cycles", step, {{0, 0}, {0, 0}}},
             {"energy and potential", evaluate, {{7, 62}, {16, 146}}},
             {"norms of changes", changes, {{4, 36}, {4, 36}}}};

/* Arrays that a whole cycle goes through, its coarse levels' included. */
static size_t floats_at_work(const fg__level *level)
{
  double arrays = level->layout.dimension == 3 ? 17.0 + 26.0 / 7.0 : 8.0 + 17.0 / 3.0;
  return (size_t)(arrays * level->nodes);
}

static void print_row(const subject *s, size_t n, double traffic, double arithmetic)
{
  const fg__level *level = &s->multigrid.level[0];
  int dimension = level->layout.dimension;
  double seconds = least_seconds(table[n].run, s);
  work w = table[n].of_node[dimension - 2];
  double bytes = sizeof(float) * w.floats;
  printf("| %s | %d^%d | %s | %.0f | %.2f |", s->multigrid.kernel->name,
         level->layout.nodes[0], dimension, table[n].name, 1e6 * seconds,
         1e9 * seconds / level->nodes);
  if (w.operations > 0.0) {
    double by_traffic = 1e9 * bytes / traffic, by_sums = 1e9 * w.operations / arithmetic;
    printf(" %.0f | %.0f | %.2f | %.2f | %.1f |\n", bytes, w.operations, by_traffic,
           by_sums, 1e9 * seconds / level->nodes / fmax(by_traffic, by_sums));
  } else
    printf(" | | | | |\n");
}

int main(int argc, char **argv)
{
  const char *standard[] = {"128", "256", "512", "1024", "64x3", "128x3"};
  int count = argc > 1 ? argc - 1 : 6;
  printf(
      "| kernel | nodes | loop | us | ns a node | bytes | operations | ns, bytes | "
      "ns, operations | times the larger |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (int n = 0; n < count; ++n) {
    const char *size = argc > 1 ? argv[n + 1] : standard[n];
    int cells = atoi(size), dimension = strstr(size, "x3") ? 3 : 2;
    fg_context *context;
    subject s = {0};
    if (cells < 16 || cells % 8 || fg_context_create(&context) ||
        prepare(&s, context, cells, dimension)) {
      fprintf(stderr, "bench_kernels: %s cells a side: not possible\n", size);
      return 1;
    }
    const fg__level *level = &s.multigrid.level[0];
    double arithmetic = floor_arithmetic(s.multigrid.kernel->name);
    double traffic = floor_traffic(s.multigrid.kernel->name, floats_at_work(level));
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k)
      print_row(&s, k, traffic, arithmetic);
    fprintf(stderr, "%s: %.1f GB/s, %.1f Gflop/s\n", size, 1e-9 * traffic,
            1e-9 * arithmetic);
    free(s.previous - level->layout.first);
    fg__multigrid_clear(&s.multigrid);
    fg_context_destroy(context);
  }
  return 0;
}
