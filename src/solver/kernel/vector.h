/* Vectors of floats as wide as the instructions that a kernel is compiled for. Part of
 * solver/kernel/body.h. */
#ifndef FG__KERNEL_VECTOR_H
#define FG__KERNEL_VECTOR_H

#include <stddef.h>
#include <stdint.h>

#define INLINE static inline __attribute__((always_inline))

#if defined(__AVX512F__)
enum { WIDTH = 16 };
#elif defined(__AVX2__)
enum { WIDTH = 8 };
#else
enum { WIDTH = 4 };
#endif

typedef float vector __attribute__((vector_size(WIDTH * sizeof(float))));
typedef int32_t lanes_mask __attribute__((vector_size(WIDTH * sizeof(int32_t))));
/* The same anywhere in memory. */
typedef float loose_vector
    __attribute__((vector_size(WIDTH * sizeof(float)), aligned(4), may_alias));

INLINE vector load(const float *from)
{
  return *(const loose_vector *)from;
}

INLINE void store(float *to, vector x)
{
  *(loose_vector *)to = x;
}

/* Lane n gets lane n - 1, the first one the last of the vector before. */
INLINE vector from_west(vector before, vector here)
{
#if defined(__AVX512F__)
  return __builtin_shufflevector(before, here, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25,
                                 26, 27, 28, 29, 30);
#elif defined(__AVX2__)
  return __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14);
#else
  return __builtin_shufflevector(before, here, 3, 4, 5, 6);
#endif
}

/* Lane n gets lane n + 1, the last one the first of the vector after. */
INLINE vector from_east(vector here, vector after)
{
#if defined(__AVX512F__)
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13,
                                 14, 15, 16);
#elif defined(__AVX2__)
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8);
#else
  return __builtin_shufflevector(here, after, 1, 2, 3, 4);
#endif
}

INLINE vector greater_lanes(vector a, vector b)
{
  lanes_mask m = a > b;
  return (vector)((m & (lanes_mask)a) | (~m & (lanes_mask)b));
}

/* The lesser of both, where x is a number. */
INLINE vector at_most_lanes(vector x, vector most)
{
  lanes_mask m = x > most;
  return (vector)((m & (lanes_mask)most) | (~m & (lanes_mask)x));
}

/* The sign bits of x, and x without them. */
INLINE lanes_mask sign_of_lanes(vector x)
{
  return (lanes_mask)x & INT32_MIN;
}

INLINE vector size_of_lanes(vector x)
{
  return (vector)((lanes_mask)x & INT32_MAX);
}

#endif
