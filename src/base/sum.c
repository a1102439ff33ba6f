#include "base/sum.h"

#include <math.h>

enum { TERM_BITS = 51, SUM_BITS = 62 };

static int exponent_above(double value)
{
  int exponent;
  frexp(value, &exponent); /* value <= 2^exponent */
  return exponent;
}

fg__quantum fg__quantum_for(double bound, double terms)
{
  int bound_exponent = exponent_above(bound);
  int exponent = bound_exponent - TERM_BITS;
  int for_sum = bound_exponent + exponent_above(terms) - SUM_BITS;
  double size = ldexp(1.0, for_sum > exponent ? for_sum : exponent);
  fg__quantum out = {.size = size, .bound = bound, .shift = 0x1.8p52 * size};
  memcpy(&out.shift_bits, &out.shift, sizeof out.shift_bits);
  return out;
}

double fg__sum_value(const fg__quantum *quantum, uint64_t sum)
{
  return (double)(int64_t)sum * quantum->size;
}
