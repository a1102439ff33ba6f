/* Sums whose bits do not depend on the order of the terms, nor on who adds which.
 *
 * Each term is rounded to the nearest multiple of a quantum, and multiples are added as
 * 64-bit integers: exactly, in any order, in any number of parts. (The rounding is the
 * pre-rounding of Demmel and Nguyen, Fast reproducible floating-point summation, 2013;
 * integers in place of doubles leave ten more bits to the sum.) A sum is off by half a
 * quantum per term at most.
 *
 *     fg__quantum q = fg__quantum_for(4.0, nodes);
 *     uint64_t sum = 0;
 *     for (...)
 *       sum += fg__quanta(&q, term);
 *     fg__ranks_add(ranks, &sum, 1);                  // mesh/ranks.h
 *     double value = fg__sum_value(&q, sum);
 *
 * A term costs two comparisons, an addition and two integer operations, all of which
 * vectorise: 0.22 ns a term in place of 0.11 for a plain sum (AVX2, gcc 12, Xeon).
 * Terms may be summed first, in doubles and in a fixed order, over nodes that
 * always lie in one box (a column of a patch); that spares most of it. */
#ifndef FG__SUM_H
#define FG__SUM_H

#include <stdint.h>
#include <string.h>

typedef struct fg__quantum {
  double size;  /* of the quantum, a power of two */
  double bound; /* of a term */
  double shift; /* 3 2^51 quanta: added to a term leaves no bits below the quantum */
  uint64_t shift_bits;
} fg__quantum;

/* The least quantum for `terms` terms of at most `bound` in size (> 0, finite, the same
 * on all ranks): bound 2^-51, or bound terms 2^-62 if that is more, each factor rounded
 * up to a power of two. */
fg__quantum fg__quantum_for(double bound, double terms);

/* The term in quanta, as an integer modulo 2^64. A larger term counts as the bound; NaN
 * counts as minus the bound. */
static inline uint64_t fg__quanta(const fg__quantum *quantum, double term)
{
  double bound = quantum->bound;
  term = term > -bound ? term : -bound;
  term = term < bound ? term : bound;
  double shifted = term + quantum->shift;
  uint64_t bits;
  memcpy(&bits, &shifted, sizeof bits);
  return bits - quantum->shift_bits;
}

/* The sum of what fg__quanta gave, as a number. */
double fg__sum_value(const fg__quantum *quantum, uint64_t sum);

#endif
