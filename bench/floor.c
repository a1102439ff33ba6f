#include "floor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/memory.h"

enum { REPETITIONS = 12 };

double floor_clock(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Twelve chains of sums and products that do not wait for each other. */
enum { CHAINS = 12, ROUNDS = 400000, LANES = 16 };

#define CHAINED_SUMS(name, set)                                                          \
  set static double name(void)                                                           \
  {                                                                                      \
    typedef float vector __attribute__((vector_size(LANES * sizeof(float))));            \
    vector x[CHAINS], scale = {0};                                                       \
    for (int n = 0; n < CHAINS; ++n)                                                     \
      x[n] = scale + (float)n;                                                           \
    scale += 0.5F;                                                                       \
    double start = floor_clock();                                                        \
    for (int round = 0; round < ROUNDS; ++round)                                         \
      for (int n = 0; n < CHAINS; ++n)                                                   \
        x[n] = x[n] * scale + scale;                                                     \
    double seconds = floor_clock() - start;                                              \
    vector sum = x[0];                                                                   \
    for (int n = 1; n < CHAINS; ++n)                                                     \
      sum += x[n];                                                                       \
    volatile float used = sum[0];                                                        \
    (void)used;                                                                          \
    return 2.0 * LANES * CHAINS * (double)ROUNDS / seconds;                              \
  }

#define CHANGE_IN_PLACE(name, set)                                                       \
  set static void name(float *values, size_t count)                                      \
  {                                                                                      \
    typedef float vector __attribute__((vector_size(LANES * sizeof(float))));            \
    vector *at = (vector *)(void *)values;                                               \
    for (size_t n = 0; n < count / LANES; ++n)                                           \
      at[n] = 1.0F - at[n];                                                              \
  }

typedef struct probe {
  const char *kernel;
  double (*sums)(void);
  void (*change)(float *values, size_t count);
} probe;

#if defined(__x86_64__)
CHAINED_SUMS(sums_512, __attribute__((target("avx512f"))))
CHANGE_IN_PLACE(change_512, __attribute__((target("avx512f"))))
CHAINED_SUMS(sums_256, __attribute__((target("avx2"))))
CHANGE_IN_PLACE(change_256, __attribute__((target("avx2"))))
#endif
CHAINED_SUMS(sums_generic, )
CHANGE_IN_PLACE(change_generic, )

static const probe *probe_of(const char *kernel)
{
  static const probe table[] = {
#if defined(__x86_64__)
    {"avx512", sums_512, change_512},
    {"avx2", sums_256, change_256},
#endif
    {"generic", sums_generic, change_generic}
  };
  const probe *last = table + sizeof table / sizeof table[0] - 1;
  const probe *p = table;
  while (p < last && strcmp(p->kernel, kernel) != 0)
    ++p;
  return p;
}

double floor_arithmetic(const char *kernel)
{
  const probe *p = probe_of(kernel);
  double most = 0.0;
  for (int k = 0; k < REPETITIONS; ++k)
    most = fmax(most, p->sums());
  return most;
}

double floor_traffic(const char *kernel, size_t count)
{
  const probe *p = probe_of(kernel);
  count = count > LANES ? count : LANES;
  float *values = fg__allocate_aligned(count, sizeof *values);
  if (!values)
    return 0.0;
  for (size_t n = 0; n < count; ++n)
    values[n] = 1.0F;
  const size_t least_floats = (size_t)1 << 24;
  size_t rounds = 1 + least_floats / count;
  double least = (double)INFINITY;
  for (int k = 0; k < REPETITIONS; ++k) {
    double start = floor_clock();
    for (size_t round = 0; round < rounds; ++round)
      p->change(values, count);
    least = fmin(least, floor_clock() - start);
  }
  free(values);
  return 2.0 * sizeof(float) * (double)count * (double)rounds / least;
}
