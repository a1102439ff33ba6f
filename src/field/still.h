/* What is still: the one rule of placements, scores and outlines. */
#ifndef FG__STILL_H
#define FG__STILL_H

#include <stdbool.h>
#include <stddef.h>

/* The greatest of a raster's speeds, but not those beside a singularity: at most 30 times
 * the typical speed, the largest that at least half of what is faster than an eighth of
 * it reaches, and at least a 200th of all that moves. Where a field falls as a power of
 * the distance from a charge, a wire or a dipole, no speed is typical down to the median;
 * a jet, a vessel and any flow without singularities have one near their greatest.
 * Negative values are no speeds. 0: nothing moves. */
double fg__top_speed(const float *speed, size_t count);

/* Whether a speed is enough for a direction to be read. */
bool fg__moves(double speed, double top);

/* The root mean square of a raster's speeds, those beyond the top counted as that. 0
 * where there is none. */
double fg__usual_speed(const float *speed, size_t count, double top);

/* Which share of a raster's speeds is slower than a tenth of the usual one: more than
 * half in a box of noise round a vessel. */
double fg__slow_share(const float *speed, size_t count, double usual);

#endif
