/* How the density of a run evolved: the messages with densities that the run has sent. */
#ifndef VIEW_DENSITIES_H
#define VIEW_DENSITIES_H

#include <stddef.h>

#include "progress.h"

/* More than a run of a month sends. */
enum { MOST_DENSITIES = 400 };

typedef struct view_densities {
  int count;
  unsigned char *bytes[MOST_DENSITIES]; /* nodes along x and y, of two bytes, the lower
                                           one first; then `u` of progress_message */
  size_t size[MOST_DENSITIES];
} view_densities;

/* Adds one, if there is memory and room for it. */
void densities_add(view_densities *densities, const progress_message *message);

void densities_clear(view_densities *densities);

#endif
