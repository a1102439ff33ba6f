#include "place/scale.h"
#include "base/angle.h"

#include <math.h>

/* Lines get shorter by this factor where no more fit, down to so many lambda. */
static const double SHORTER = 0.7;
static const double LEAST_LENGTH = 0.2;

/* Of a volume thinner than that, it is the length in the plane, or along the line. */
static double fair_length(const fg__place_domain *domain, int count)
{
  const double share = domain->measure / count;
  double side[3], lambda = cbrt(share);
  if (domain->dimension == 2)
    return sqrt(share);
  for (int k = 0; k < 3; ++k)
    side[k] = domain->cells[k] * domain->spacing; /* as the measure takes it */
  const double thin = fmin(side[0], fmin(side[1], side[2]));
  const double long_side = fmax(side[0], fmax(side[1], side[2]));
  const double middle = side[0] * side[1] * side[2] / (thin * long_side);
  if (lambda > thin)
    lambda = sqrt(share / thin);
  return lambda > middle ? share / (thin * middle) : lambda;
}

fg__place_scale fg__place_scale_of(const fg__place_domain *domain, int count, bool free,
                                   fg__place_grain grain)
{
  const bool flat = domain->dimension == 2;
  const double lambda = ldexp(fair_length(domain, count), -domain->small_arrows);
  const double ink = flat || !free ? 0.0 : 0.1;
  fg__place_scale scale = {
      .dimension = domain->dimension,
      .count = count,
      .lambda = lambda,
      .cell = lambda / (flat ? (grain == FG__PLACE_FINE ? 8.0 : 6.0) : 4.0),
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
  for (int k = 0; k < 3; ++k) {
    const double side = domain->high[k] - domain->low[k];
    const bool thin = k < scale.dimension && side < scale.cell;
    scale.origin[k] = domain->low[k] - (thin ? (scale.cell - side) / 2.0 : 0.0);
  }
  return scale;
}

bool fg__place_shorten(fg__place_scale *scale)
{
  double shorter = SHORTER * scale->shortest;
  if (shorter < LEAST_LENGTH * scale->lambda)
    return false;
  scale->shortest = shorter;
  return true;
}
