#include "cluster/stretch.h"

#include <math.h>

/* A part with less than this share both of the cluster and of the mean cluster gets no
 * icon: it would be a small arrow beside large ones. */
static const double LEAST_SHARE = 0.25;

bool fg__stretch_find(fg__stretch *out, const fg_density_arrays *density, int axis,
                      double origin, int nodes, int n)
{
  int last = nodes - 1, period = density->nodes[axis];
  int start = (int)lround((origin - density->origin[axis]) / density->spacing[axis]);
  *out = (fg__stretch){0, last, start};
  if (!density->periodic[axis])
    return n == 0;
  int turn = (int)floor((double)start / period) + n;
  int first = turn * period - start, next = first + period;
  out->first = first > 0 ? first : 0;
  out->last = next < last ? next : last;
  out->start = start + out->first - turn * period;
  return out->first < last;
}

double fg__stretch_least(const fg__labels *labels, int cluster)
{
  double mean = 0.0, area = labels->area[cluster - 1];
  for (int n = 0; n < labels->count; ++n)
    mean += labels->area[n] / labels->count;
  return LEAST_SHARE * (area > mean ? mean / area : 1.0);
}
