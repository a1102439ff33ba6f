/* Directions on a raster, smoothed, and their critical points. */
#ifndef FG__CRITICAL_DIRECTIONS_H
#define FG__CRITICAL_DIRECTIONS_H

#include <math.h>

#include "critical/points.h"
#include "critical/raster.h"

/* A direction in 2D a cell; smoothed by a Gaussian of lambda / 4 once points are found.
 */
typedef struct fg__directions {
  const fg__domain_raster *raster;
  double lambda;
  unsigned char *inside;
  double *value[2], *smooth[2];
  double *kernel[2]; /* along x and y, from the middle on */
  int radius[2];
} fg__directions;

/* Every cell is to be set then. Ends with fg__directions_clear, also after a failure.
 * MEMORY. */
fg_status fg__directions_create(fg__directions *out, fg_context *context,
                                const fg__domain_raster *raster, double lambda);
void fg__directions_clear(fg__directions *directions);

/* Sets a cell to the direction of a vector, to none where that is 0. */
static inline void fg__directions_set(fg__directions *directions, size_t cell,
                                      bool inside, double x, double y)
{
  const double length = hypot(x, y);
  directions->inside[cell] = inside;
  directions->value[0][cell] = length > 0.0 ? x / length : 0.0;
  directions->value[1][cell] = length > 0.0 ? y / length : 0.0;
}

/* Smooths, and finds the points with an index; those nearer than lambda / 2 are merged.
 * End them with fg__points_clear, also after a failure. MEMORY. */
fg_status fg__directions_find(fg__points *points, fg__directions *directions,
                              fg_context *context, fg__threads *threads);

/* The share of the Gaussian round a point that lies in the domain. */
double fg__directions_share(const fg__directions *directions, const double at[2]);

#endif
