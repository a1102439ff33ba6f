#include "evolution/widen.h"

#include <math.h>

#include "solver/passes.h"

/* By the flow of the gradient energy alone, du/dt = -K u, which smooths along the stream
 * as much more than across it as interfaces are wider there. In the time t it adds
 * 2 t gamma a to the variance (pi^2 / 12) gamma a of a profile's slope; a finer mesh's
 * profile lacks three quarters of that, of which means over its nodes have added a sixth.
 */
static const double smoothing_time = 0.26;

/* Largest eigenvalue of K: 4 gamma / spacing^2. A step damps its wave out. */
static int steps_of(double gamma, double spacing)
{
  return (int)ceil(smoothing_time * 4.0 * gamma / (spacing * spacing));
}

void fg__widen_interfaces(const fg__multigrid *multigrid, double gamma, double share,
                          double spacing)
{
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  float *u = fg__multigrid_u(multigrid), *w = fg__multigrid_w(multigrid);
  float *to = u - shape.first, *slope = w - shape.first;
  int steps = steps_of(gamma, spacing);
  float step = (float)(smoothing_time / (share * steps));
  for (int k = 0; k < steps; ++k) {
    fg__pass_evaluate(multigrid, u, w);
    fg__pass_subtract_potential_derivative(multigrid, u, w);
    for (size_t n = 0; n < shape.size; ++n)
      to[n] -= step * slope[n];
  }
}
