#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "base/sum.h"

enum { TERMS = 20011 };

/* Values of very different sizes and both signs, at most 2.9 in size. */
static double term_at(uint64_t seed, int n)
{
  uint64_t x = (seed + (uint64_t)n + 1) * 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9U;
  x ^= x >> 32;
  double value = (double)(int64_t)x * 0x1p-63;
  return 2.9 * ldexp(value, -(int)(x % 40));
}

/* A permutation of 0 ... TERMS - 1. */
static int *order_of(uint64_t seed)
{
  int *order = malloc(TERMS * sizeof *order);
  assert_non_null(order);
  for (int n = 0; n < TERMS; ++n)
    order[n] = n;
  for (int n = TERMS - 1; n > 0; --n) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    int other = (int)((seed >> 33) % (uint64_t)(n + 1)), kept = order[n];
    order[n] = order[other];
    order[other] = kept;
  }
  return order;
}

/* Plain sums of the same terms do differ: else the test would show nothing. */
static void any_order_and_partition_gives_the_same_bits(void **state)
{
  (void)state;
  fg__quantum q = fg__quantum_for(2.9, TERMS);
  uint64_t sum = 0;
  double plain = 0.0;
  for (int n = 0; n < TERMS; ++n) {
    sum += fg__quanta(&q, term_at(7, n));
    plain += term_at(7, n);
  }
  double value = fg__sum_value(&q, sum);
  int differing = 0;
  for (int trial = 1; trial <= 20; ++trial) {
    int *order = order_of((uint64_t)trial);
    uint64_t part[7] = {0}, all = 0;
    double plain_again = 0.0;
    for (int n = 0; n < TERMS; ++n) {
      double term = term_at(7, order[n]);
      part[order[n] % trial % 7] += fg__quanta(&q, term);
      plain_again += term;
    }
    free(order);
    for (int n = 0; n < 7; ++n)
      all += part[n];
    double again = fg__sum_value(&q, all);
    assert_memory_equal(&again, &value, sizeof value);
    differing += plain_again != plain;
  }
  assert_true(differing > 10);
}

static void the_error_is_half_a_quantum_a_term(void **state)
{
  (void)state;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    double bound = ldexp(2.9, (int)seed - 10);
    fg__quantum q = fg__quantum_for(bound, TERMS);
    uint64_t sum = 0;
    long double exact = 0.0L;
    for (int n = 0; n < TERMS; ++n) {
      double term = ldexp(term_at(seed, n), (int)seed - 10);
      sum += fg__quanta(&q, term);
      exact += (long double)term;
    }
    double error = (double)((long double)fg__sum_value(&q, sum) - exact);
    assert_true(fabs(error) <= 0.5 * q.size * TERMS);
    /* as documented, twice at most what the larger of the two asks for */
    assert_true(q.size <= 2.0 * fmax(0x1p-51, 2.0 * TERMS * 0x1p-62) * bound);
    assert_true(q.size >= fmax(0x1p-51, TERMS * 0x1p-62) * bound);
  }
}

static void multiples_of_the_quantum_are_exact(void **state)
{
  (void)state;
  fg__quantum q = fg__quantum_for(1.0, 1e9);
  const double counts[] = {0.0, 1.0, -1.0, 3.0, 1e6, -123456789.0};
  for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n)
    assert_true(fg__sum_value(&q, fg__quanta(&q, counts[n] * q.size)) ==
                counts[n] * q.size);
}

/* The worst that the description allows: every term at the bound, of either sign. */
static void a_sum_of_bounds_does_not_overflow(void **state)
{
  (void)state;
  for (int sign = -1; sign <= 1; sign += 2)
    for (double bound = 0.7; bound < 1e3; bound *= 1.9) {
      double terms = ldexp(1.0, 40);
      fg__quantum q = fg__quantum_for(bound, terms);
      uint64_t sum = fg__quanta(&q, sign * bound) << 40;
      assert_true(fabs(fg__sum_value(&q, sum) - sign * bound * terms) <= q.size * terms);
    }
}

static void what_exceeds_the_bound_counts_as_the_bound(void **state)
{
  (void)state;
  fg__quantum q = fg__quantum_for(3.0, 100.0);
  const double most[] = {3.0, 3.1, 1e300, (double)INFINITY};
  for (size_t n = 0; n < sizeof most / sizeof *most; ++n) {
    assert_true(fg__sum_value(&q, fg__quanta(&q, most[n])) == 3.0);
    assert_true(fg__sum_value(&q, fg__quanta(&q, -most[n])) == -3.0);
  }
  assert_true(fg__sum_value(&q, fg__quanta(&q, (double)NAN)) == -3.0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_order_and_partition_gives_the_same_bits),
      cmocka_unit_test(the_error_is_half_a_quantum_a_term),
      cmocka_unit_test(multiples_of_the_quantum_are_exact),
      cmocka_unit_test(a_sum_of_bounds_does_not_overflow),
      cmocka_unit_test(what_exceeds_the_bound_counts_as_the_bound),
  };
  return cmocka_run_group_tests_name("base/sum", tests, NULL, NULL);
}
