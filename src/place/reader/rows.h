/* The inner loops of the readers: boxes of cells, row by row, compiled for several vector
 * widths. Every width gives the same bits: products and sums stay apart, and sums go in
 * sixteen fixed lanes. Rows are read and written in whole vectors: arrays have
 * FG__PLACE_PAD more elements behind, what lies there does not count. */
#ifndef FG__PLACE_READER_ROWS_H
#define FG__PLACE_READER_ROWS_H

#include "place/reader/readers.h"

/* Writes a line's contribution to all cells of `to`. */
void fg__place_contribute_rows(fg__place_contribution *to, const fg__place_raster *raster,
                               const fg__place_line *line, float reach);

/* Adds one contribution to another in the cells of a box that both have: the nearer of
 * two samples, and the sums over icons. */
void fg__place_add_rows(fg__place_contribution *to, const fg__place_contribution *from,
                        const fg__place_box *box);

/* fg__place_cost. */
double fg__place_cost_rows(float *cost, const fg__place_raster *raster,
                           const fg__place_box *box,
                           const fg__place_contribution *const parts[2],
                           const fg__place_weights *weights);

/* Cells in a row. */
typedef struct fg__place_run {
  size_t first;
  int count;
} fg__place_run;

/* The cells of a window of the diffusion reader, with one more on each side, which stay:
 * values that are worked on, and those of the step before. */
typedef struct fg__place_window_rows {
  int dimension, size[3];
  size_t stride[2]; /* of rows and planes */
  size_t origin;    /* of the first cell */
  float *value[3], *last[3];
  const float *source[3];
  float *inverse;
  const fg__place_run *run; /* of rows, those with cells of the domain */
  size_t run_count;
} fg__place_window_rows;

/* One step of Chebyshev's iteration: `last` becomes what follows on `value`. */
void fg__place_diffuse_rows(const fg__place_window_rows *window, float omega);

/* Where the window's first cell lies in arrays of a raster. */
typedef struct fg__place_raster_rows {
  size_t stride[2], origin;
} fg__place_raster_rows;

/* 1 / (faces + strength), what a cell's value follows from; 0 outside the domain. */
void fg__place_inverse_rows(const fg__place_window_rows *window, const float *strength,
                            const fg__place_raster_rows *at, const float *faces);

/* Angles between the window's values and the flow times weight, degrees, to `error` (of
 * the window); returns the sum of what they are more than `before` (of the raster). */
double fg__place_angle_rows(float *error, const fg__place_window_rows *window,
                            const fg__place_raster_rows *at,
                            const fg__place_raster *raster, const float *before);

/* For each of a line's samples the square of the distance to the nearest of `count`
 * points, whole vectors of them; their coordinates lie in arrays `stride` apart. 1e18
 * without any. */
void fg__place_nearest_points(int dimension, float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count);

#endif
