/* The initial density: reproducible noise that belongs to the place, not to the mesh. */
#ifndef FG__NOISE_H
#define FG__NOISE_H

#include "evolve/level.h"

/* Fills u at the nodes of the level with mean + smooth noise, whose correlation length is
 * `length` (units of the longest side, like the level's spacing; `first` gives the global
 * index of node (0, 0)). The noise at a place depends only on the place, the seed, the
 * length and the domain's size: neither on the mesh nor on who computes it. */
void fg__noise_fill(const fg__level *level, const int first[2], const int domain_cells[2],
                    double mean, double length, uint64_t seed, float *u);

#endif
