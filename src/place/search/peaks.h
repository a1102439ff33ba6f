/* The maximum of a raster that changes in boxes of cells; each row's maximum is kept. */
#ifndef FG__PLACE_PEAKS_H
#define FG__PLACE_PEAKS_H

#include "place/reader/readers.h"

typedef struct fg__place_peak {
  float height; /* value times weight of the row's highest cell; negative: none counts */
  int column;
} fg__place_peak;

typedef struct fg__place_peaks {
  const fg__place_raster *raster; /* borrowed, as what follows */
  const float *value;             /* [cells] */
  const float *weight; /* by which values count, where it is positive; NULL: 1 */
  fg__place_peak *row;
} fg__place_peaks;

/* MEMORY. */
fg_status fg__place_peaks_create(fg__place_peaks *out, fg_context *context,
                                 const fg__place_raster *raster, const float *value,
                                 const float *weight);
void fg__place_peaks_clear(fg__place_peaks *peaks);

/* Finds the maxima of the rows from low to below high, along y and z, again. */
void fg__place_peaks_renew(fg__place_peaks *peaks, const int low[3], const int high[3]);

/* Returns the largest value times weight, and the first cell that has it; negative, with
 * *cell 0, where no cell counts. */
float fg__place_peaks_top(size_t *cell, const fg__place_peaks *peaks);

#endif
