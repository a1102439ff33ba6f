/* Halo exchange for slabs: ranks with whole slices (rows in 2D, planes in 3D) along the
 * last axis send runs of memory to the rank above or below. Pencils use exchange.h. */
#ifndef FG__SLABS_H
#define FG__SLABS_H

#include "grid/partition.h"

typedef struct fg__slabs {
  const fg__ranks *ranks;
  int below, above; /* ranks, FG__NOBODY at the domain's ends */
} fg__slabs;

/* Floats for the rank above (or below), and where those of the other side's neighbour
 * go. */
typedef struct fg__run {
  const float *sent;
  float *received;
  size_t count;
  bool up;
} fg__run;

/* The neighbours of this rank's block along an axis. Not collective. */
fg__slabs fg__slabs_along(const fg__partition *partition, int axis);

/* The neighbours along the last axis; whether several ranks divide that axis only, which
 * is the same on all ranks. Not collective. */
bool fg__slabs_find(fg__slabs *out, const fg__partition *partition);

/* A run after the other. Collective: all ranks give as many, of the same directions and
 * sizes. */
void fg__slabs_exchange(const fg__slabs *slabs, const fg__run run[], int count);

#endif
