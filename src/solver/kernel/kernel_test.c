/* Every vector width and number of threads gives the same bits. */
#include "solver/reference_test.h"

enum { MOST_KERNELS = 3, SUMS = 4, MEMBERS = MOST_THREADS };

static int kernels_of_this_machine(int dimension, const fg__kernel *kernels[MOST_KERNELS])
{
  bool solid = dimension == 3;
  int count = 0;
  kernels[count++] = solid ? &fg__kernel_3d_generic : &fg__kernel_2d_generic;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2"))
    kernels[count++] = solid ? &fg__kernel_3d_avx2 : &fg__kernel_2d_avx2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    kernels[count++] = solid ? &fg__kernel_3d_avx512 : &fg__kernel_2d_avx512;
#endif
  return count;
}

/* An entry of the table put to use on two levels, the finest or the two after it. */
typedef void operation(const fg__kernel *kernel, const fg__level *fine,
                       const fg__level *coarse, const fg__thread *thread,
                       double sums[SUMS]);

/* Of the order of the diffusion time of a cell. */
static float step_of(const fg__level *level)
{
  return (float)(0.7 * level->spacing[0] * level->spacing[1]);
}

static void smooth(const fg__kernel *kernel, const fg__level *fine,
                   const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->smooth(fine, step_of(fine), thread);
}

static void smooth_linear(const fg__kernel *kernel, const fg__level *fine,
                          const fg__level *coarse, const fg__thread *thread,
                          double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->smooth_linear(fine, step_of(fine), thread);
}

static void restrict_residuals(const fg__kernel *kernel, const fg__level *fine,
                               const fg__level *coarse, const fg__thread *thread,
                               double sums[SUMS])
{
  (void)sums;
  kernel->restrict_residuals(fine, coarse, step_of(fine), thread);
}

static void smooth_restrict_linear(const fg__kernel *kernel, const fg__level *fine,
                                   const fg__level *coarse, const fg__thread *thread,
                                   double sums[SUMS])
{
  (void)sums;
  kernel->smooth_restrict_linear(fine, coarse, step_of(fine), thread);
}

static void find_scale(const fg__kernel *kernel, const fg__level *fine,
                       const fg__level *coarse, const fg__thread *thread,
                       double sums[SUMS])
{
  (void)fine, (void)sums;
  kernel->find_scale(coarse, thread);
}

static void find_curvature(const fg__kernel *kernel, const fg__level *fine,
                           const fg__level *coarse, const fg__thread *thread,
                           double sums[SUMS])
{
  (void)fine, (void)sums;
  kernel->find_curvature(coarse, step_of(fine), thread);
}

static void find_relaxation(const fg__kernel *kernel, const fg__level *fine,
                            const fg__level *coarse, const fg__thread *thread,
                            double sums[SUMS])
{
  (void)sums;
  kernel->find_relaxation(coarse, step_of(fine), thread);
}

static void unscale(const fg__kernel *kernel, const fg__level *fine,
                    const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)fine, (void)sums;
  kernel->unscale(coarse, thread);
}

static void correct_smooth(const fg__kernel *kernel, const fg__level *fine,
                           const fg__level *coarse, const fg__thread *thread,
                           double sums[SUMS])
{
  (void)sums;
  kernel->correct_smooth(coarse, fine, step_of(fine), thread);
}

static void correct_smooth_linear(const fg__kernel *kernel, const fg__level *fine,
                                  const fg__level *coarse, const fg__thread *thread,
                                  double sums[SUMS])
{
  (void)sums;
  kernel->correct_smooth_linear(coarse, fine, step_of(fine), thread);
}

static void correct_smooth_restrict(const fg__kernel *kernel, const fg__level *fine,
                                    const fg__level *coarse, const fg__thread *thread,
                                    double sums[SUMS])
{
  (void)sums;
  kernel->correct_smooth_restrict(coarse, fine, step_of(fine), thread);
}

static void evaluate(const fg__kernel *kernel, const fg__level *fine,
                     const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)coarse;
  fg__sums result = kernel->evaluate(fine, fine->u, fine->w, thread);
  sums[0] = result.energy;
  sums[1] = result.u;
}

static void explicit_part(const fg__kernel *kernel, const fg__level *fine,
                          const fg__level *coarse, const fg__thread *thread,
                          double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->explicit_part(fine, fine->u, fine->w, step_of(fine), fine->p, thread);
}

static void subtract_potential_derivative(const fg__kernel *kernel, const fg__level *fine,
                                          const fg__level *coarse,
                                          const fg__thread *thread, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->subtract_potential_derivative(fine, fine->u, fine->w, thread);
}

static void changes(const fg__kernel *kernel, const fg__level *fine,
                    const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)coarse;
  /* changes of a tenth, as steps have them */
  kernel->extrapolate(fine, fine->u, fine->w, 0.1F, fine->p, thread);
  fg__changes result = kernel->changes(fine, fine->u, fine->p, fine->p, fine->u, thread);
  sums[0] = result.u;
  sums[1] = result.change;
  sums[2] = result.correction;
  sums[3] = result.product;
}

static void extrapolate(const fg__kernel *kernel, const fg__level *fine,
                        const fg__level *coarse, const fg__thread *thread,
                        double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->extrapolate(fine, fine->w, fine->p, 1.37F, fine->u, thread);
}

static void predict(const fg__kernel *kernel, const fg__level *fine,
                    const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->predict(fine, fine->w, fine->p, 1.37F, fine->u, thread);
}

static void shift(const fg__kernel *kernel, const fg__level *fine,
                  const fg__level *coarse, const fg__thread *thread, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->shift(fine, fine->u, -0.0321F, thread);
}

static const struct {
  const char *name;
  operation *run;
  bool coarse; /* two levels */
  bool linear; /* below the finest */
} OPERATIONS[] = {
    {"smooth", smooth, false, false},
    {"smooth_linear", smooth_linear, false, true},
    {"restrict_residuals", restrict_residuals, true, false},
    {"smooth_restrict_linear", smooth_restrict_linear, true, true},
    {"find_scale", find_scale, true, false},
    {"find_curvature", find_curvature, true, false},
    {"find_relaxation", find_relaxation, true, false},
    {"unscale", unscale, true, false},
    {"correct_smooth", correct_smooth, true, false},
    {"correct_smooth_linear", correct_smooth_linear, true, true},
    {"correct_smooth_restrict", correct_smooth_restrict, true, false},
    {"evaluate", evaluate, false, false},
    {"explicit_part", explicit_part, false, false},
    {"subtract_potential_derivative", subtract_potential_derivative, false, false},
    {"changes", changes, false, false},
    {"extrapolate", extrapolate, false, false},
    {"predict", predict, false, false},
    {"shift", shift, false, false},
};

static double turning(double x, double y, const void *data)
{
  (void)data;
  return 2.3 * x - 4.1 * y + 1.7 * sin(5.0 * x * y);
}

static bool outside_holes(double x, double y)
{
  return !(x > 0.3 && x < 0.55 && y > 0.12 && y < 0.33) && hypot(x - 0.8, y) > 0.1;
}

/* The arrays of a level that an operation may write; absent ones are NULL. */
enum { ARRAYS = 10, FIRST_POSITIVE = 4, SCALE = 5, SCALE_INVERSE = 6 };

static void arrays_of(const fg__level *level, bool finest, float *arrays[ARRAYS])
{
  float *all[ARRAYS] = {level->u,
                        level->w,
                        level->p,
                        level->q,
                        level->coupling,
                        level->scale,
                        level->scale_inverse,
                        level->curvature,
                        level->shape_curvature,
                        level->relaxation};
  for (int a = 0; a < ARRAYS; ++a)
    arrays[a] = finest && a > 2 ? NULL : all[a];
}

static void load(const problem *p)
{
  uint64_t seed = 4711;
  for (int n = 0; n < p->multigrid.level_count; ++n) {
    const fg__level *level = &p->multigrid.level[n];
    float *arrays[ARRAYS];
    arrays_of(level, n == 0, arrays);
    for (int a = 0; a < ARRAYS && arrays[a]; ++a) {
      const int *nodes = level->layout.nodes;
      for (int k = 0; k < nodes[2]; ++k)
        for (int j = 0; j < nodes[1]; ++j)
          for (int i = 0; i < nodes[0]; ++i) {
            double value = 1.2 * random_value(&seed) - 0.1;
            *fg__node(level, arrays[a], i, j, k) =
                (float)(a < FIRST_POSITIVE ? value : 0.2 + fabs(value));
          }
      fg__fill_ghosts(level, arrays[a]);
    }
  }
}

/* Values of all arrays at all nodes and, where a later operation reads them, ghosts. */
static size_t save(const problem *p, float *to)
{
  size_t count = 0;
  for (int n = 0; n < p->multigrid.level_count; ++n) {
    const fg__level *level = &p->multigrid.level[n];
    float *arrays[ARRAYS];
    arrays_of(level, n == 0, arrays);
    /* u, w and scales with their ghosts, the others without */
    for (int a = 0; a < ARRAYS && arrays[a]; ++a) {
      int ring = a < 2 || a == SCALE || a == SCALE_INVERSE,
          solid = ring && p->dimension == 3;
      const int *nodes = level->layout.nodes;
      for (int k = -solid; k < nodes[2] + solid; ++k)
        for (int j = -ring; j < nodes[1] + ring; ++j)
          for (int i = -ring; i < nodes[0] + ring; ++i)
            to[count++] = *fg__node(level, arrays[a], i, j, k);
    }
  }
  return count;
}

/* One operation, by several threads. */
typedef struct call {
  operation *run;
  const fg__kernel *kernel;
  const fg__level *fine;
  double sums[MEMBERS][SUMS];
} call;

static void run_share(void *argument, const fg__thread *thread)
{
  call *c = argument;
  c->run(c->kernel, c->fine, c->fine + 1, thread, c->sums[thread->index]);
}

/* Results of one operation with one kernel; the length of what was saved. */
static size_t result_of(const problem *p, size_t operation_index,
                        const fg__kernel *kernel, fg__threads *threads, float *values,
                        double sums[SUMS])
{
  call c = {OPERATIONS[operation_index].run,
            kernel,
            &p->multigrid.level[OPERATIONS[operation_index].linear],
            {{0.0}}};
  load(p);
  fg__threads_run(threads, run_share, &c);
  for (int n = 0; n < SUMS; ++n) {
    sums[n] = 0.0;
    for (int m = 0; m < MEMBERS; ++m)
      sums[n] += c.sums[m][n];
  }
  return save(p, values);
}

/* Sweep and restriction in one pass give what they give one after the other. */
static void compare_passes(const problem *p, fg__threads *threads)
{
  size_t room = 60 * p->nodes + 10000;
  float *expected = allocate_or_fail(room, sizeof *expected);
  float *values = allocate_or_fail(room, sizeof *values);
  fg__thread alone = fg__single_thread();
  const fg__level *level = p->multigrid.level;
  const fg__kernel *kernel = p->multigrid.kernel;
  double sums[SUMS];
  size_t fused = 0;
  while (OPERATIONS[fused].run != correct_smooth_restrict)
    ++fused;
  load(p);
  kernel->correct_smooth(level + 1, level, step_of(level), &alone);
  kernel->restrict_residuals(level, level + 1, step_of(level), &alone);
  size_t count = save(p, expected);
  for (int n = 0; n < 2; ++n) {
    result_of(p, fused, kernel, n ? threads : NULL, values, sums);
    if (memcmp(values, expected, count * sizeof *values) != 0)
      fail_msg("one pass is not two on %d x %d x %d cells", p->of.cells[0],
               p->of.cells[1], p->of.cells[2]);
  }
  free(expected);
  free(values);
}

/* Every kernel, by one thread and, one of them, by several, gives what the first does by
 * one: of an operation the next kernel in each `turn`. */
static void compare_kernels(const problem *p, fg__threads *threads, int turn)
{
  const fg__kernel *kernels[MOST_KERNELS];
  int kernel_count = kernels_of_this_machine(p->dimension, kernels);
  size_t room = 60 * p->nodes + 10000;
  float *before = allocate_or_fail(room, sizeof *before);
  float *expected = allocate_or_fail(room, sizeof *expected);
  float *values = allocate_or_fail(room, sizeof *values);
  for (size_t n = 0; n < sizeof OPERATIONS / sizeof *OPERATIONS; ++n) {
    if (p->multigrid.level_count < 1 + OPERATIONS[n].coarse + OPERATIONS[n].linear)
      continue;
    double expected_sums[SUMS], sums[SUMS];
    load(p);
    save(p, before);
    size_t count = result_of(p, n, kernels[0], NULL, expected, expected_sums);
    assert_true(count <= room);
    assert_true(memcmp(before, expected, count * sizeof *before) != 0 ||
                expected_sums[0] != 0.0);
    for (int k = 0; k < 2 * kernel_count; ++k) {
      const fg__kernel *kernel = kernels[k / 2];
      if (k == 0 || (k % 2 && k / 2 != (turn + (int)n) % kernel_count))
        continue; /* what is expected, or has its turn elsewhere */
      result_of(p, n, kernel, k % 2 ? threads : NULL, values, sums);
      if (memcmp(values, expected, count * sizeof *values) != 0 ||
          memcmp(sums, expected_sums, sizeof sums) != 0)
        fail_msg("%s of %s by %s differs on %d x %d x %d cells", OPERATIONS[n].name,
                 kernel->name, k % 2 ? "several threads" : "one thread", p->of.cells[0],
                 p->of.cells[1], p->of.cells[2]);
    }
  }
  free(before);
  free(expected);
  free(values);
}

static const int SIZES[][3] = {{8, 8},       {16, 24},     {30, 14},    {34, 18},
                               {33, 21},     {62, 44},     {66, 50},    {95, 17},
                               {128, 40},    {260, 12},    {8, 8, 8},   {16, 12, 20},
                               {34, 10, 14}, {66, 18, 12}, {21, 15, 11}};

static void compare_on_all_sizes(bool (*inside)(double, double))
{
  fg__threads *threads;
  assert_int_equal(fg__threads_create(&threads, NULL, MEMBERS), FG_STATUS_OK);
  int turn = 0;
  for (size_t n = 0; n < sizeof SIZES / sizeof *SIZES; ++n)
    for (int boundaries = 0; boundaries < (SIZES[n][2] > 0 ? 8 : 4); ++boundaries) {
      problem p;
      problem_description of = {.cells = {SIZES[n][0], SIZES[n][1], SIZES[n][2]},
                                .side = {1.0, 0.93 * SIZES[n][1] / SIZES[n][0],
                                         1.1 * SIZES[n][2] / SIZES[n][0]},
                                .gamma = 8.0 / SIZES[n][0] / SIZES[n][0],
                                .anisotropy = 0.17,
                                .angle = turning,
                                .inside = inside};
      for (int k = 0; k < 3; ++k)
        of.periodic[k] = boundaries >> k & 1;
      problem_create(&p, &of);
      compare_kernels(&p, threads, turn++);
      if (p.multigrid.level_count > 1)
        compare_passes(&p, threads);
      problem_clear(&p);
    }
  fg__threads_destroy(threads);
}

static void all_widths_and_threads_give_the_same_bits(void **state)
{
  (void)state;
  compare_on_all_sizes(NULL);
}

static void all_widths_and_threads_give_the_same_bits_with_a_mask(void **state)
{
  (void)state;
  compare_on_all_sizes(outside_holes);
}

/* Options choose at most the vector width that the machine has. */
static void narrower_vectors_can_be_chosen(void **state)
{
  (void)state;
  static const fg_vectors widths[] = {FG_VECTORS_GENERIC, FG_VECTORS_AVX2,
                                      FG_VECTORS_AVX512};
  for (int dimension = 2; dimension <= 3; ++dimension) {
    const fg__kernel *kernels[MOST_KERNELS];
    int count = kernels_of_this_machine(dimension, kernels);
    assert_ptr_equal(fg__kernel_choose(dimension, FG_VECTORS_WIDEST), kernels[count - 1]);
    for (int k = 0; k < 3; ++k)
      assert_ptr_equal(fg__kernel_choose(dimension, widths[k]),
                       kernels[k < count ? k : count - 1]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_widths_and_threads_give_the_same_bits),
      cmocka_unit_test(all_widths_and_threads_give_the_same_bits_with_a_mask),
      cmocka_unit_test(narrower_vectors_can_be_chosen),
  };
  return cmocka_run_group_tests_name("solver/kernel/kernel", tests, NULL, NULL);
}
