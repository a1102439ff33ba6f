/* How the density of a run evolved: what the run told, from the first. */
#ifndef VIEW_DENSITIES_H
#define VIEW_DENSITIES_H

#include <stddef.h>

#include "progress.h"

/* More than a run of a month tells. */
enum { MOST_DENSITIES = 400 };

typedef struct view_densities {
  int count;
  unsigned char *bytes[MOST_DENSITIES]; /* nodes along x and y, of two bytes, the lower
                                           one first; then `u` of progress_told */
  size_t size[MOST_DENSITIES];
} view_densities;

/* Adds one, if there is memory and room for it. */
void densities_add(view_densities *densities, const progress_told *told);

void densities_clear(view_densities *densities);

#endif
