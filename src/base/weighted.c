#include "base/weighted.h"

#include <stdlib.h>

int fg__by_size(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int fg__by_size_of_floats(const void *a, const void *b)
{
  const float x = *(const float *)a, y = *(const float *)b;
  return (x > y) - (x < y);
}

static int compare(const void *a, const void *b)
{
  return fg__by_size(&((const fg__weighted *)a)->value,
                     &((const fg__weighted *)b)->value);
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
