#include "place/search/peaks.h"

#include "base/memory.h"

#include <stdlib.h>

static fg__place_peak peak_of(const fg__place_peaks *peaks, size_t row)
{
  const int columns = peaks->raster->cells[0];
  const float *value = peaks->value + row * (size_t)columns;
  const float *weight = peaks->weight ? peaks->weight + row * (size_t)columns : NULL;
  fg__place_peak best = {-1.0F, 0};
  for (int x = 0; x < columns; ++x) {
    float height = !weight ? value[x] : weight[x] > 0.0F ? value[x] * weight[x] : -1.0F;
    if (height > best.height)
      best = (fg__place_peak){height, x};
  }
  return best;
}

fg_status fg__place_peaks_create(fg__place_peaks *out, fg_context *context,
                                 const fg__place_raster *raster, const float *value,
                                 const float *weight)
{
  const size_t rows = (size_t)raster->cells[1] * (size_t)raster->cells[2];
  *out = (fg__place_peaks){.raster = raster, .value = value, .weight = weight};
  out->row = fg__allocate(rows, sizeof *out->row);
  if (!out->row)
    return fg__fail_memory(context, "the peaks of rows", rows * sizeof *out->row);
  for (size_t row = 0; row < rows; ++row)
    out->row[row] = peak_of(out, row);
  return FG_STATUS_OK;
}

void fg__place_peaks_clear(fg__place_peaks *peaks)
{
  free(peaks->row);
  peaks->row = NULL;
}

void fg__place_peaks_renew(fg__place_peaks *peaks, const int low[3], const int high[3])
{
  const int *cells = peaks->raster->cells;
  int from[3], end[3];
  for (int k = 1; k < 3; ++k) {
    from[k] = low[k] > 0 ? low[k] : 0;
    end[k] = high[k] < cells[k] ? high[k] : cells[k];
  }
  for (int z = from[2]; z < end[2]; ++z)
    for (int y = from[1]; y < end[1]; ++y) {
      size_t row = (size_t)z * (size_t)cells[1] + (size_t)y;
      peaks->row[row] = peak_of(peaks, row);
    }
}

float fg__place_peaks_top(size_t *cell, const fg__place_peaks *peaks)
{
  const int *cells = peaks->raster->cells;
  const size_t rows = (size_t)cells[1] * (size_t)cells[2];
  size_t best = 0;
  for (size_t row = 1; row < rows; ++row)
    if (peaks->row[row].height > peaks->row[best].height)
      best = row;
  *cell = best * (size_t)cells[0] + (size_t)peaks->row[best].column;
  return peaks->row[best].height;
}
