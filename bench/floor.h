/* What the machine allows a loop: how fast one thread moves floats that lie where the
 * loop's arrays lie, and how many operations a second its vectors can do. */
#ifndef FG_BENCH_FLOOR_H
#define FG_BENCH_FLOOR_H

#include <stddef.h>

/* Bytes a second, read and written, when `count` floats are changed in place again and
 * again, in vectors of the kernel of that name (solver/kernel/kernel.h); 0: out of
 * memory. */
double floor_traffic(const char *kernel, size_t count);

/* Additions and multiplications, not fused, a second, of floats in such vectors. */
double floor_arithmetic(const char *kernel);

double floor_clock(void); /* seconds since some moment */

#endif
