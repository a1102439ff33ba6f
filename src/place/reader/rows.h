/* The inner loops of reading: rows of cells, compiled for several vector widths. Every
 * width gives the same bits: products and sums stay apart, and sums go in eight fixed
 * lanes. */
#ifndef FG__PLACE_READER_ROWS_H
#define FG__PLACE_READER_ROWS_H

#include "place/reader/readers.h"

/* Where a row of cells lies, in lambda. */
typedef struct fg__place_row_place {
  float x, y, z;                     /* its low end, its middle */
  float cell, reach, inverse_square; /* 1 / reach^2 */
} fg__place_row_place;

/* Tells `count` untold cells from `value` on, arrays `stride` apart, what a line tells.
 */
void fg__place_tell_row(int dimension, float *value, size_t stride, int count,
                        const fg__place_line *line, const fg__place_row_place *row);

/* Joins what other icons tell: the nearer of two, the sums of the rest. */
void fg__place_add_row(int dimension, float *to, size_t to_stride, const float *from,
                       size_t from_stride, int count);

/* A row that a contribution has, from cell `first` of the row that is asked on. */
typedef struct fg__place_told_row {
  const float *value; /* NULL: nothing */
  size_t stride;
  int first, count;
} fg__place_told_row;

typedef struct fg__place_row {
  const float *weight;
  const float *direction[3];
  fg__place_price price;
} fg__place_row;

/* The sum of the cells' prices, kept in `cost` unless NULL. */
double fg__place_cost_row(int dimension, float *cost, int count, const fg__place_row *row,
                          const fg__place_told_row parts[2]);

/* One step of Chebyshev's iteration for the diffusion reader: `out` has the values of the
 * step before the last, `in` those of the last. */
void fg__place_diffuse_row(int dimension, float *out, const float *in,
                           const size_t stride[2], const float *source,
                           const float *inverse, int count, float omega);

/* 1 / (faces + strength), what a cell's value follows from; 0 outside the domain. */
void fg__place_inverse_row(float *out, const float *faces, const float *strength,
                           int count);

typedef struct fg__place_angle_cells {
  const float *value[3], *direction[3]; /* directions are unit vectors */
  const float *weight, *before;
} fg__place_angle_cells;

/* Angles between values and directions times weight, degrees; returns the sum of what
 * they are more than `before`. */
double fg__place_angle_row(int dimension, float *out, const fg__place_angle_cells *cells,
                           int count);

/* For each of a line's samples the square of the distance to the nearest of `count`
 * points, whole vectors of them; their coordinates lie in arrays `stride` apart. 1e18
 * without any. */
void fg__place_nearest_points(int dimension, float *square, const fg__place_line *line,
                              const float *position, size_t stride, int count);

#endif
