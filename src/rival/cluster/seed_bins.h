/* Seeds with a place and a direction, in square (cubic) bins, to find the nearest. */
#ifndef FG__RIVAL_SEED_BINS_H
#define FG__RIVAL_SEED_BINS_H

#include "rival/domain.h"

typedef struct fg__seed {
  double position[3], direction[3];
} fg__seed;

typedef struct fg__seed_bins {
  const fg__domain *domain;
  const fg__seed *seed;
  double lambda;
  int bins[3];
  double size[3];  /* of a bin */
  int *top, *next; /* the last seed of each bin, the next of each seed's; -1: none */
  size_t top_capacity, next_capacity;
} fg__seed_bins;

/* Sorts seeds into bins about `lambda` wide, which is what distances are measured in; the
 * seeds are borrowed. `out` is all zero or to be used again. MEMORY. */
fg_status fg__seed_bins_fill(fg__seed_bins *out, fg_context *context,
                             const fg__domain *domain, const fg__seed *seed, int count,
                             double lambda);
void fg__seed_bins_clear(fg__seed_bins *bins);

/* The seed with the least |dx|^2 / lambda^2 + weight^2 |dd|^2, which is *cost; of equal
 * ones the first, but `guess`, any seed, goes before. */
int fg__seed_bins_nearest(const fg__seed_bins *bins, const fg__seed *from, double weight,
                          int guess, double *cost);

#endif
