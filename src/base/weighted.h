/* Values by size, and of different weight. */
#ifndef FG__WEIGHTED_H
#define FG__WEIGHTED_H

#include <stddef.h>

/* Orders of numbers for qsort. */
int fg__by_size(const void *a, const void *b);
int fg__by_size_of_floats(const void *a, const void *b);

typedef struct fg__weighted {
  double value, weight;
} fg__weighted;

/* Sorts the values and gives those that `beyond`, a share of all weight, lies below and
 * above; 0 of no values. */
void fg__weighted_range(double range[2], fg__weighted *values, size_t count,
                        double beyond);

#endif
