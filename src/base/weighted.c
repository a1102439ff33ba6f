#include "base/weighted.h"

#include <stdlib.h>

static int compare(const void *a, const void *b)
{
  const double one = ((const fg__weighted *)a)->value;
  const double other = ((const fg__weighted *)b)->value;
  return (one > other) - (one < other);
}

static double quantile(const fg__weighted *sorted, size_t count, double weight)
{
  double passed = 0.0;
  for (size_t n = 0; n < count; ++n) {
    passed += sorted[n].weight;
    if (passed >= weight)
      return sorted[n].value;
  }
  return count > 0 ? sorted[count - 1].value : 0.0;
}

void fg__weighted_range(double range[2], fg__weighted *values, size_t count,
                        double beyond)
{
  double all = 0.0;
  qsort(values, count, sizeof *values, compare);
  for (size_t n = 0; n < count; ++n)
    all += values[n].weight;
  range[0] = quantile(values, count, beyond * all);
  range[1] = quantile(values, count, (1.0 - beyond) * all);
}
