#include "score/reader.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static const double DEGREES = 57.29577951308232;

double fg__angle(const double a[3], const double b[3])
{
  const double inner = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const double across[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
  const double outer =
      sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
  return inner == 0.0 && outer == 0.0 ? 90.0 : DEGREES * atan2(outer, inner);
}

static void swap(float *a, float *b)
{
  const float kept = *a;
  *a = *b;
  *b = kept;
}

/* The value at `place` of the sorted list (Hoare's selection, which permutes it). */
static float select_value(float *value, size_t count, size_t place)
{
  size_t low = 0, high = count - 1;
  while (low < high) {
    const float pivot = value[low + (high - low) / 2];
    size_t i = low, j = high;
    for (;; ++i, --j) {
      while (value[i] < pivot)
        ++i;
      while (value[j] > pivot)
        --j;
      if (i >= j)
        break;
      swap(&value[i], &value[j]);
    }
    /* up to j none is greater than the pivot, beyond it none is less */
    if (place <= j)
      high = j;
    else
      low = j + 1;
  }
  return value[low];
}

fg_status fg__reader_error(fg_reader_error *out, fg_context *context,
                           const fg__domain_raster *raster, const float *angle)
{
  double sum = 0.0, weighted = 0.0, speeds = 0.0;
  size_t count = 0;
  float *counted = fg__allocate(raster->cells, sizeof *counted);
  if (!counted)
    return fg__fail_memory(context, "angles", raster->cells * sizeof *counted);
  for (size_t n = 0; n < raster->cells; ++n)
    if (raster->counts[n]) {
      const double speed = (double)raster->speed[n];
      sum += (double)angle[n];
      weighted += speed * (double)angle[n];
      speeds += speed;
      counted[count++] = angle[n];
    }
  fg_status status = FG_STATUS_OK;
  if (count == 0)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "score: the field moves at no centre of %zu cells", raster->cells);
  else
    *out = (fg_reader_error){.mean = sum / (double)count,
                             .percentile_95 = (double)select_value(
                                 counted, count, (size_t)ceil(0.95 * (double)count) - 1),
                             .speed_weighted = weighted / speeds};
  free(counted);
  return status;
}
