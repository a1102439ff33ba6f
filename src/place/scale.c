#include "place/scale.h"
#include "base/angle.h"

#include <math.h>

/* Lines get shorter by this factor where no more fit, down to so many lambda. */
static const double SHORTER = 0.7;
static const double LEAST_LENGTH = 0.2;

fg__place_scale fg__place_scale_of(int dimension, int count, double measure, bool free)
{
  bool flat = dimension == 2;
  double share = measure / count, lambda = flat ? sqrt(share) : cbrt(share);
  const double ink = flat || !free ? 0.0 : 0.1;
  return (fg__place_scale){
      .dimension = dimension,
      .count = count,
      .lambda = lambda,
      .cell = lambda / (flat ? 8.0 : 4.0),
      .sampling = lambda / (flat ? 10.0 : 8.0),
      .reach = lambda * (flat ? 1.0 : 1.1),
      .clearance = lambda * (flat ? 0.1 : 0.05),
      .shortest = 0.5 * lambda,
      .turning = 165.0 * FG__RADIANS,
      .longest = (free ? 2.0 : 1.0) * lambda,
      .first_way = (free ? 0.6 : 0.5) * lambda,
      .crowding = 0.1,
      .crowd_range = 0.3 * lambda,
      .ends = 0.7,
      .end_gap = 0.2 * lambda,
      .touch = flat ? 7.0 : 6.0,
      .touch_gap = 0.15 * lambda,
      .diffusion = 2.0,
      .far = 3.0,
      .brevity = 4.0,
      .ink = ink,
      .first_ink = ink,
      .free = free,
  };
}

bool fg__place_shorten(fg__place_scale *scale)
{
  double shorter = SHORTER * scale->shortest;
  if (shorter < LEAST_LENGTH * scale->lambda)
    return false;
  scale->shortest = shorter;
  return true;
}
