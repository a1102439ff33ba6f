/* The initial density: reproducible noise that belongs to the place, not to the mesh. */
#ifndef FG__NOISE_H
#define FG__NOISE_H

#include <stdbool.h>
#include <stdint.h>

/* One axis of the lattice of random numbers that the noise is a smooth surface over. */
typedef struct fg__noise_axis {
  double node_spacing;
  double spacing; /* of the lattice */
  int64_t period; /* in lattice intervals; 0: none */
} fg__noise_axis;

typedef struct fg__noise {
  int dimension;
  fg__noise_axis axis[3];
  double mean, scale;
  uint64_t key;
} fg__noise;

/* Noise about `mean` with the standard deviation of uniform values up to `amplitude` off
 * it, whose correlation length is `length` (units of the spacing), over a uniform grid of
 * cells[k] cells of side spacing[k] along each axis. The noise at a place depends only on
 * the place, the seed, the length and the domain's size: neither on the mesh nor on who
 * computes it. Its standard deviation is the same in 2D and 3D. */
fg__noise fg__noise_of(int dimension, const int cells[3], const double spacing[3],
                       const bool periodic[3], double mean, double amplitude,
                       double length, uint64_t seed);

/* Writes the noise at nodes (first + n, j, k), n = 0 ... count - 1, of the whole grid to
 * out[n]; k is 0 in 2D. */
void fg__noise_row(const fg__noise *noise, int j, int k, int first, int count,
                   float *out);

#endif
