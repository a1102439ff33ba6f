/* Every vector width gives the same bits. */
#include "evolve/reference_test.h"

enum { MOST_KERNELS = 3, SUMS = 4 };

static int kernels_of_this_machine(const fg__kernel *kernels[MOST_KERNELS])
{
  int count = 0;
  kernels[count++] = &fg__kernel_generic;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2"))
    kernels[count++] = &fg__kernel_avx2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    kernels[count++] = &fg__kernel_avx512;
#endif
  return count;
}

/* An entry of the table put to use on two levels, the finest or the two after it. */
typedef void operation(const fg__kernel *kernel, const fg__level *fine,
                       const fg__level *coarse, double sums[SUMS]);

/* Of the order of the diffusion time of a cell. */
static float step_of(const fg__level *level)
{
  return (float)(0.7 * level->spacing[0] * level->spacing[1]);
}

static void smooth(const fg__kernel *kernel, const fg__level *fine,
                   const fg__level *coarse, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->smooth(fine, step_of(fine));
}

static void smooth_linear(const fg__kernel *kernel, const fg__level *fine,
                          const fg__level *coarse, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->smooth_linear(fine, step_of(fine));
}

static void smooth_restrict(const fg__kernel *kernel, const fg__level *fine,
                            const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->smooth_restrict(fine, coarse, step_of(fine));
}

static void smooth_restrict_linear(const fg__kernel *kernel, const fg__level *fine,
                                   const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->smooth_restrict_linear(fine, coarse, step_of(fine));
}

static void prolong_smooth(const fg__kernel *kernel, const fg__level *fine,
                           const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->prolong_smooth(coarse, fine, step_of(fine));
}

static void prolong_smooth_linear(const fg__kernel *kernel, const fg__level *fine,
                                  const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->prolong_smooth_linear(coarse, fine, step_of(fine));
}

static void prolong_array(const fg__kernel *kernel, const fg__level *fine,
                          const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->prolong_array(coarse, coarse->p, fine, fine->p, fine->u);
  kernel->prolong_array(coarse, coarse->u, fine, fine->w, fine->w);
}

static void restrict_defect(const fg__kernel *kernel, const fg__level *fine,
                            const fg__level *coarse, double sums[SUMS])
{
  (void)sums;
  kernel->restrict_defect(fine, fine->w, coarse, coarse->q, step_of(fine));
}

static void evaluate(const fg__kernel *kernel, const fg__level *fine,
                     const fg__level *coarse, double sums[SUMS])
{
  (void)coarse;
  fg__sums result = kernel->evaluate(fine, fine->u, fine->w);
  sums[0] = result.energy;
  sums[1] = result.u;
}

static void changes(const fg__kernel *kernel, const fg__level *fine,
                    const fg__level *coarse, double sums[SUMS])
{
  (void)coarse;
  fg__changes result = kernel->changes(fine, fine->u, fine->w, fine->p, fine->p);
  sums[0] = result.u;
  sums[1] = result.from_a;
  sums[2] = result.from_b;
  sums[3] = result.along;
}

static void extrapolate(const fg__kernel *kernel, const fg__level *fine,
                        const fg__level *coarse, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->extrapolate(fine, fine->w, fine->p, 1.37F, fine->u);
}

static void shift(const fg__kernel *kernel, const fg__level *fine,
                  const fg__level *coarse, double sums[SUMS])
{
  (void)coarse, (void)sums;
  kernel->shift(fine, fine->u, -0.0321F);
}

static const struct {
  const char *name;
  operation *run;
  bool coarse; /* two levels */
  bool linear; /* below the finest */
} OPERATIONS[] = {
    {"smooth", smooth, false, false},
    {"smooth_linear", smooth_linear, false, true},
    {"smooth_restrict", smooth_restrict, true, false},
    {"smooth_restrict_linear", smooth_restrict_linear, true, true},
    {"prolong_smooth", prolong_smooth, true, false},
    {"prolong_smooth_linear", prolong_smooth_linear, true, true},
    {"prolong_array", prolong_array, true, false},
    {"restrict_defect", restrict_defect, true, false},
    {"evaluate", evaluate, false, false},
    {"changes", changes, false, false},
    {"extrapolate", extrapolate, false, false},
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
enum { ARRAYS = 5 };

static void arrays_of(const fg__level *level, bool finest, float *arrays[ARRAYS])
{
  arrays[0] = level->u;
  arrays[1] = level->w;
  arrays[2] = level->p;
  arrays[3] = finest ? NULL : level->q;
  arrays[4] = finest ? NULL : level->curvature;
}

static void load(const problem *p)
{
  uint64_t seed = 4711;
  for (int n = 0; n < p->multigrid.level_count; ++n) {
    const fg__level *level = &p->multigrid.level[n];
    float *arrays[ARRAYS];
    arrays_of(level, n == 0, arrays);
    for (int a = 0; a < ARRAYS && arrays[a]; ++a) {
      for (int j = 0; j < level->rows; ++j)
        for (int i = 0; i < level->columns; ++i) {
          double value = 1.2 * random_value(&seed) - 0.1;
          *fg__node(level, arrays[a], i, j) = (float)(a == 4 ? 2.0 * fabs(value) : value);
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
    for (int a = 0; a < ARRAYS && arrays[a]; ++a)
      for (int j = 0; j < level->rows; ++j)
        for (int i = 0; i < level->columns; ++i)
          to[count++] = *fg__node(level, arrays[a], i, j);
    for (int a = 0; a < 2; ++a)
      for (int side = 0; side < 2; ++side) {
        for (int j = 0; j < level->rows; ++j)
          to[count++] = fg__row(level, arrays[a], j)[level->ghost_column[side]];
        for (int i = 0; i < level->columns; ++i)
          to[count++] = *fg__node(level, arrays[a], i, side ? level->rows : -1);
      }
  }
  return count;
}

/* Results of one operation with one kernel; the length of what was saved. */
static size_t result_of(const problem *p, size_t operation_index,
                        const fg__kernel *kernel, float *values, double sums[SUMS])
{
  const fg__level *fine = &p->multigrid.level[OPERATIONS[operation_index].linear];
  load(p);
  for (int n = 0; n < SUMS; ++n)
    sums[n] = 0.0;
  OPERATIONS[operation_index].run(kernel, fine, fine + 1, sums);
  return save(p, values);
}

static void compare_kernels(const problem *p)
{
  const fg__kernel *kernels[MOST_KERNELS];
  int kernel_count = kernels_of_this_machine(kernels);
  size_t room = 20 * p->nodes + 10000;
  float *before = allocate_or_fail(room, sizeof *before);
  float *expected = allocate_or_fail(room, sizeof *expected);
  float *values = allocate_or_fail(room, sizeof *values);
  for (size_t n = 0; n < sizeof OPERATIONS / sizeof *OPERATIONS; ++n) {
    if (p->multigrid.level_count < 1 + OPERATIONS[n].coarse + OPERATIONS[n].linear)
      continue;
    double expected_sums[SUMS], sums[SUMS];
    load(p);
    save(p, before);
    size_t count = result_of(p, n, kernels[0], expected, expected_sums);
    assert_true(count <= room);
    assert_true(memcmp(before, expected, count * sizeof *before) != 0 ||
                expected_sums[0] != 0.0);
    for (int k = 1; k < kernel_count; ++k) {
      result_of(p, n, kernels[k], values, sums);
      if (memcmp(values, expected, count * sizeof *values) != 0 ||
          memcmp(sums, expected_sums, sizeof sums) != 0)
        fail_msg("%s of %s differs from that of %s on %d x %d cells", OPERATIONS[n].name,
                 kernels[k]->name, kernels[0]->name, p->of.cells[0], p->of.cells[1]);
    }
  }
  free(before);
  free(expected);
  free(values);
}

static const int SIZES[][2] = {{8, 8},   {16, 24}, {30, 14}, {34, 18},  {33, 21},
                               {62, 44}, {66, 50}, {95, 17}, {128, 40}, {260, 12}};

static void compare_on_all_sizes(bool (*inside)(double, double))
{
  for (size_t n = 0; n < sizeof SIZES / sizeof *SIZES; ++n)
    for (int borders = 0; borders < 4; ++borders) {
      problem p;
      problem_create(
          &p, &(problem_description){.cells = {SIZES[n][0], SIZES[n][1]},
                                     .side = {1.0, 0.93 * SIZES[n][1] / SIZES[n][0]},
                                     .periodic = {(borders & 1) != 0, (borders & 2) != 0},
                                     .gamma = 8.0 / SIZES[n][0] / SIZES[n][0],
                                     .anisotropy = 0.17,
                                     .angle = turning,
                                     .inside = inside});
      compare_kernels(&p);
      problem_clear(&p);
    }
}

static void all_widths_give_the_same_bits(void **state)
{
  (void)state;
  const fg__kernel *kernels[MOST_KERNELS];
  if (kernels_of_this_machine(kernels) == 1)
    skip();
  compare_on_all_sizes(NULL);
}

static void all_widths_give_the_same_bits_with_a_mask(void **state)
{
  (void)state;
  const fg__kernel *kernels[MOST_KERNELS];
  if (kernels_of_this_machine(kernels) == 1)
    skip();
  compare_on_all_sizes(outside_holes);
}

/* The environment asks for less than the machine has, never for more. */
static void the_environment_narrows_the_choice(void **state)
{
  (void)state;
  const fg__kernel *kernels[MOST_KERNELS];
  int count = kernels_of_this_machine(kernels);
  assert_int_equal(unsetenv("FLOWGRAIN_KERNEL"), 0);
  assert_ptr_equal(fg__kernel_choose(), kernels[count - 1]);
  for (int k = 0; k < count; ++k) {
    assert_int_equal(setenv("FLOWGRAIN_KERNEL", kernels[k]->name, 1), 0);
    assert_ptr_equal(fg__kernel_choose(), kernels[k]);
  }
  assert_int_equal(unsetenv("FLOWGRAIN_KERNEL"), 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_widths_give_the_same_bits),
      cmocka_unit_test(all_widths_give_the_same_bits_with_a_mask),
      cmocka_unit_test(the_environment_narrows_the_choice),
  };
  return cmocka_run_group_tests_name("evolve/kernel", tests, NULL, NULL);
}
