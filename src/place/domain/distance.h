/* Exact distances on a raster. */
#ifndef FG__PLACE_DISTANCE_H
#define FG__PLACE_DISTANCE_H

#include "base/context.h"

/* Sets each cell of `out` to the distance from its centre to that of the nearest cell
 * that is outside (inside[] is 0, or beyond the raster's own box), less half a cell,
 * where a wall along an axis is; 0 outside. Two or three dimensions, `spacing` between
 * cells. A distance transform of parabolas along one axis after the other (Felzenszwalb
 * and Huttenlocher, Theory of Computing 8, 2012). MEMORY.
 */
fg_status fg__place_distance(float *out, fg_context *context, const int *inside,
                             const int cells[3], int dimension, double spacing);

#endif
