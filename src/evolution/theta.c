#include "evolution/theta.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

const fg__splitting fg__theta_default = {0.29289321881345247560, 0.58578643762690495120};

double fg__theta_held(fg__splitting splitting)
{
  double beta = 1.0 - splitting.alpha;
  return beta > 0.0 ? beta : 1.0;
}

fg_status fg__theta_create(fg__theta *out, fg_context *context, fg__multigrid *multigrid,
                           fg__splitting splitting)
{
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  *out = (fg__theta){.splitting = splitting};
  float *memory = fg__allocate_aligned(3 * shape.size, sizeof *memory);
  fg_status status = FG_STATUS_OK;
  if (!memory)
    status =
        fg__fail_memory(context, "the theta scheme", 3 * shape.size * sizeof *memory);
  out->memory = memory;
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (status) {
    fg__theta_clear(out);
    return status;
  }
  out->instead = (fg__linear_terms){.zeros = memory + shape.first};
  out->instead.ones = out->instead.zeros + shape.size;
  out->instead.relaxation = out->instead.ones + shape.size;
  for (size_t n = shape.size; n < 2 * shape.size; ++n)
    memory[n] = 1.0F;
  out->none = fg__multigrid_no_energies(out->instead.zeros);
  fg__multigrid_weigh_gradient(multigrid, 1.0 / fg__theta_held(splitting));
  return FG_STATUS_OK;
}

void fg__theta_clear(fg__theta *theta)
{
  free(theta->memory);
  *theta = (fg__theta){0};
}

double fg__theta_share(fg__splitting splitting, int substep)
{
  return substep == 1 ? 1.0 - 2.0 * splitting.theta : splitting.theta;
}

/* By what a step multiplies an eigenvector of L and K round u = 1 or -1, where
 * Psi'' = 4. */
static double amplification(fg__splitting s, double laplacian, double stiffness,
                            double tau)
{
  double one = tau * laplacian * s.alpha * stiffness;
  double other = tau * laplacian * ((1.0 - s.alpha) * stiffness + 4.0);
  double outer = (1.0 - s.theta * other) / (1.0 + s.theta * one);
  double middle = fg__theta_share(s, 1);
  return outer * outer * (1.0 - middle * one) / (1.0 + middle * other);
}

/* Waves and interface energies by ratios so near 1 that the stable step keeps three
 * digits. Long waves, whose K is less than a fortieth of Psi'', allow longer steps. */
static bool nothing_grows(fg__splitting s, double least, double most, double stiffest,
                          double tau)
{
  for (double wave = stiffest; most * wave > 0.1; wave *= 0.97)
    for (double gamma = least; gamma < 1.1 * most; gamma *= 1.1)
      if (fabs(amplification(s, wave, fmin(gamma, most) * wave, tau)) > 1.0)
        return false;
  return true;
}

double fg__theta_stable_step(fg__splitting splitting, double least, double most,
                             double stiffest)
{
  /* the first hardly moves the stiffest wave; in the second some wave grows, on a mesh
   * that has interfaces at all */
  double low = 1e-3 / (stiffest * (4.0 + most * stiffest)), high = 1e3 * least;
  while (high > 1.001 * low) {
    double tau = sqrt(low * high);
    if (nothing_grows(splitting, least, most, stiffest, tau))
      low = tau;
    else
      high = tau;
  }
  return low;
}

/* Where the scheme needs beta K and beta is 0: takes K away, and puts it back. */
static void exchange_energies(fg__theta *theta, fg__multigrid *multigrid)
{
  if (!(theta->splitting.alpha < 1.0))
    fg__multigrid_exchange_energies(multigrid, &theta->none);
}

double fg__theta_prepare(fg__theta *theta, fg__multigrid *multigrid, int substep,
                         double tau, const float *start)
{
  float *u = fg__multigrid_u(multigrid), *w = fg__multigrid_w(multigrid);
  float *p = fg__multigrid_p(multigrid);
  fg__splitting splitting = theta->splitting;
  double share = fg__theta_share(splitting, substep);
  double alpha_of_held = splitting.alpha / fg__theta_held(splitting);
  bool linear = substep != 1;
  if (substep == 0) {
    exchange_energies(theta, multigrid);
    fg__pass_evaluate(multigrid, start, w);
    fg__pass_explicit_part(multigrid, start, w, share * tau, p);
  } else {
    /* what is explicit now was implicit in the substep before: w has it */
    double factor = substep == 1 ? alpha_of_held : 1.0;
    fg__pass_explicit_part(multigrid, u, w, factor * share * tau, p);
    double since_start = substep == 1 ? splitting.theta : 1.0 - splitting.theta;
    fg__pass_extrapolate(multigrid, u, start, share / since_start, u);
  }
  exchange_energies(theta, multigrid);
  fg__multigrid_linearise(multigrid, linear ? &theta->instead : NULL);
  fg__pass_evaluate(multigrid, u, w);
  if (linear)
    fg__pass_subtract_potential_derivative(multigrid, u, w);
  return linear ? alpha_of_held * share * tau : share * tau;
}
