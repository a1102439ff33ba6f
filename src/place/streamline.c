#include "place/streamline.h"

#include "base/vector.h"

#include <math.h>

/* The longest step in cells of the data: the field is linear between samples, with kinks
 * at them. */
static const double LONGEST_STEP = 4.0;

enum { MOST_STEPS = 64 };

static bool advance_stage(const fg__place_tracing *with, double out[3],
                          const double from[3], const double slope[3], double step)
{
  double place[3];
  for (int k = 0; k < 3; ++k)
    place[k] = from[k] + step * slope[k];
  return fg__place_direction(with->domain, place, out) &&
         fg__dot(out, slope) > 0.0; /* else it reverses */
}

/* One step of the pair, to `out`; false where a stage falls outside or turns back. */
static bool try_step(const fg__place_tracing *with, fg__place_tip *out, double *error,
                     const fg__place_tip *from, double step)
{
  double k2[3], k3[3], k4[3], mean[3];
  const double *k1 = from->direction;
  if (!advance_stage(with, k2, from->position, k1, 0.5 * step) ||
      !advance_stage(with, k3, from->position, k2, 0.75 * step))
    return false;
  for (int k = 0; k < 3; ++k)
    mean[k] = (2.0 * k1[k] + 3.0 * k2[k] + 4.0 * k3[k]) / 9.0;
  if (!advance_stage(with, k4, from->position, mean, step))
    return false;
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    double off = step * (-5.0 / 72.0 * k1[k] + k2[k] / 12.0 + k3[k] / 9.0 - k4[k] / 8.0);
    square += off * off;
    out->position[k] = from->position[k] + step * mean[k];
    out->direction[k] = k4[k];
  }
  *error = sqrt(square);
  return true;
}

bool fg__place_move(fg__place_tracing *with, fg__place_tip *out,
                    const fg__place_tip *from, double way)
{
  double sign = way < 0.0 ? -1.0 : 1.0, left = fabs(way);
  double most = LONGEST_STEP * with->domain->data_step;
  *out = *from;
  for (int n = 0; n < MOST_STEPS && left > 0.0; ++n) {
    double step = fg__least(fg__least(with->step, most), left), error;
    fg__place_tip next = *out;
    if (!try_step(with, &next, &error, out, sign * step))
      return false;
    double grow = error > 0.0 ? 0.9 * sqrt(with->error / error) : 2.0;
    if (error > with->error && n + 1 < MOST_STEPS / 2) {
      with->step = step * fg__most(0.3, grow);
      continue;
    }
    if (step < left || grow < 1.0) /* one cut short by the sample says little */
      with->step = step * fg__least(fg__most(grow, 0.5), 2.0);
    else
      with->step = fg__most(with->step, step * fg__least(grow, 2.0));
    if (fg__dot(next.direction, from->direction) < with->least_cosine)
      return false;
    *out = next;
    left = step < left ? left - step : 0.0;
  }
  return left <= 0.0;
}
