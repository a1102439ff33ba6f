/* Numbers that look random and depend on nothing but their key. */
#ifndef FG__MIX_H
#define FG__MIX_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection of 64 bits. */
static inline uint64_t fg__mix(uint64_t x)
{
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/* A number for a sequence of floats, bit for bit, which begins at place `first` of a
 * larger one. Numbers of parts add up to the number of the whole, in any order, so that
 * each rank can hash its own. */
static inline uint64_t fg__mix_floats(uint64_t key, uint64_t first, const float *values,
                                      size_t count)
{
  uint64_t sum = 0;
  for (size_t n = 0; n < count; ++n) {
    uint32_t bits;
    memcpy(&bits, &values[n], sizeof bits);
    sum += fg__mix(fg__mix(key ^ (first + n)) ^ bits);
  }
  return sum;
}

#endif
