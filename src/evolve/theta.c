#include "evolve/theta.h"

#include <stdlib.h>

#include "base/memory.h"

/* 1 - 1 / sqrt 2, the only value of second order for every alpha. */
static const double theta_share = 0.29289321881345247560;
const double fg__theta_alpha = 0.58578643762690495120;
const double fg__theta_stable = 0.799;

fg_status fg__theta_create(fg__theta *out, fg_context *context, fg__multigrid *multigrid,
                           double alpha)
{
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  *out = (fg__theta){.alpha = alpha};
  float *memory = fg__allocate_aligned(shape.size, sizeof *memory);
  fg_status status = FG_STATUS_OK;
  if (!memory)
    status = fg__fail_memory(context, "the theta scheme", shape.size * sizeof *memory);
  out->memory = memory;
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (status) {
    fg__theta_clear(out);
    return status;
  }
  out->zeros = memory + shape.first;
  fg__multigrid_weigh_gradient(multigrid, 1.0 / (1.0 - alpha));
  return FG_STATUS_OK;
}

void fg__theta_clear(fg__theta *theta)
{
  free(theta->memory);
  *theta = (fg__theta){0};
}

double fg__theta_share(int substep)
{
  return substep == 1 ? 1.0 - 2.0 * theta_share : theta_share;
}

double fg__theta_prepare(const fg__theta *theta, fg__multigrid *multigrid, int substep,
                         double tau, const float *start)
{
  float *u = fg__multigrid_u(multigrid), *w = fg__multigrid_w(multigrid);
  float *p = fg__multigrid_p(multigrid);
  double share = fg__theta_share(substep);
  bool linear = substep != 1;
  fg__multigrid_leave_wells(multigrid, linear ? theta->zeros : NULL);
  if (substep == 0) {
    fg__pass_evaluate(multigrid, start, w);
    fg__pass_explicit_part(multigrid, start, w, share * tau);
  } else {
    /* what is explicit now was implicit in the substep before, which knows it: p - u, for
     * the time of that substep */
    fg__pass_extrapolate(multigrid, u, p, share / fg__theta_share(substep - 1), p);
    double since_start = substep == 1 ? theta_share : 1.0 - theta_share;
    fg__pass_extrapolate(multigrid, u, start, share / since_start, u);
  }
  fg__pass_evaluate(multigrid, u, w);
  if (linear)
    fg__pass_subtract_wells(multigrid, u, w);
  return linear ? share * tau * theta->alpha / (1.0 - theta->alpha) : share * tau;
}
