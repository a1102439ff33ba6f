/* Densities during the evolution, from the messages of a run. */
#ifndef VIEW_DENSITIES_H
#define VIEW_DENSITIES_H

#include <stddef.h>

#include "progress.h"

/* More than a run of a month sends (evolving.c). */
enum { MOST_DENSITIES = 400 };

typedef struct view_densities {
  int count;
  unsigned char *bytes[MOST_DENSITIES]; /* nodes along x and y in two bytes each, low byte
                                           first, then `u` of progress_message */
  size_t size[MOST_DENSITIES];
} view_densities;

/* Adds a density, if there is room and memory for it. */
void densities_add(view_densities *densities, const progress_message *message);

void densities_clear(view_densities *densities);

#endif
