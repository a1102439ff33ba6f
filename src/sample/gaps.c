#include "sample/gaps.h"

#include <stdlib.h>

#include "base/memory.h"

enum {
  BESIDE = 3,
  FEWEST =
      7 /* intervals: of fewer, most of those round one are unlike it on an uneven axis */
};

/* An interval of 4 is rounded in even grids of which three lines are left out. */
static const double WIDE = 4.5;

/* The median of what is known of the intervals round number i; 0: nothing is. */
static double median_beside(const double *length, size_t n, size_t i)
{
  double sorted[2 * BESIDE + 1];
  size_t count = 0;
  for (size_t k = i > BESIDE ? i - BESIDE : 0; k < n && k <= i + BESIDE; ++k) {
    if (!(length[k] > 0.0))
      continue;
    size_t at = count++;
    for (; at > 0 && sorted[at - 1] > length[k]; --at)
      sorted[at] = sorted[at - 1];
    sorted[at] = length[k];
  }
  return count > 0 ? sorted[count / 2] : 0.0;
}

size_t fg__gaps_find(bool *gap, const double *length, size_t n)
{
  size_t count = 0;
  for (size_t i = 0; i < n; ++i) {
    const double median = median_beside(length, n, i);
    gap[i] = median > 0.0 && length[i] > WIDE * median;
    count += gap[i];
  }
  return count;
}

bool fg__gaps_along(bool **gap, size_t *count, const double *axis, size_t size)
{
  *gap = NULL;
  *count = 0;
  if (size <= FEWEST)
    return true;
  double *length = fg__allocate(size - 1, sizeof *length);
  *gap = fg__allocate(size - 1, sizeof **gap);
  for (size_t i = 0; i + 1 < size && length; ++i)
    length[i] = axis[i + 1] - axis[i];
  const bool memory = length && *gap;
  if (memory)
    *count = fg__gaps_find(*gap, length, size - 1);
  free(length);
  return memory;
}
