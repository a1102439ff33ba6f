#include "evolution/stepper.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "evolution/residual.h"

/* Step control (docs/design/interfaces.md). The rms correction of the last cycle over the
 * rms change of the step, delta, estimates the algebraic error before that cycle; after
 * it the error is much smaller, so that delta may be large. An attempt that is not
 * accepted is given up to MORE_CYCLES cycles, unless it is hopeless, before it is
 * rejected. */
static const double acceptable_correction = 1.0; /* delta above this rejects */
static const double wanted_correction = 1.0;     /* delta that keeps tau */
static const double hopeless_correction = 2.0;   /* no more cycles above this */
enum { MORE_CYCLES = 3 };
static const double correction_floor = 0.2; /* of eta: least change it is compared to */
static const double acceptable_increment = 3.0; /* in units of eta */
static const double most_growth = 2.0, most_shrinkage = 0.4;
static const double reject_factor = 0.5, after_reject = 0.75, relaxation = 1.3;
static const double most_extrapolation = 2.0;

/* To a residual: a step that these cycles do not solve is rejected. Rounding is what is
 * left when a cycle changes u by less than this (rms) and the residual no longer falls.
 */
enum { MOST_CYCLES = 100 };
static const double rounding_correction = 1e-7, rounding_fall = 0.95;

/* A step below this share of the first fails: not its length is the cause. */
static const double least_tau_share = 1e-9;

/* Mass is held to the rounding of the stored precision. */
static const double mass_tolerance = 1e-7;

/* At rest: an attempt that changes u by less than rest_increment (rms), and raises the
 * energy by less than the share energy_rounding, a few times the rounding of u to floats.
 * It is discarded and time alone goes on, for a real motion would lower the energy. */
static const double energy_rounding = 1e-7, rest_increment = 1e-4;

/* A pattern is stationary after QUIET_STEPS steps in a row at whose rate u would change
 * by less than quiet_change (rms) while time doubles; coarsening of clusters changes it
 * by some tenths. Not before quiet_after times the first step, which is twenty growth
 * times of linear theory (more on a coarsened mesh, whose first step is longer), because
 * a weak perturbation may grow unseen until then. */
enum { QUIET_STEPS = 12 };
static const double quiet_change = 1e-3, quiet_after = 2e4;

static double mean_of(const fg__stepper *s, const float *u)
{
  return fg__pass_changes(&s->multigrid, u, u, u, u).u / s->total_mass;
}

/* The sum of masses is the sum of u when u is 1 everywhere. */
static double weigh_domain(const fg__stepper *s)
{
  fg__array_shape shape = fg__multigrid_shape(&s->multigrid, 0);
  float *ones = s->first_iterate;
  for (size_t n = 0; n < shape.size; ++n)
    (ones - shape.first)[n] = 1.0F;
  return fg__pass_changes(&s->multigrid, ones, ones, ones, ones).u;
}

fg_status fg__stepper_create(fg__stepper *out, fg_context *context,
                             fg__multigrid *multigrid,
                             const fg__stepper_description *description)
{
  *out = (fg__stepper){.multigrid = *multigrid,
                       .cell_volume = description->cell_volume,
                       .accuracy = description->accuracy,
                       .cycles = description->cycles,
                       .residual = description->residual,
                       .second_order = description->second_order,
                       .first_tau = description->first_tau,
                       .most_tau = description->most_tau,
                       .tau = description->first_tau,
                       .tau_limit = (double)INFINITY};
  *multigrid = (fg__multigrid){0};
  fg__multigrid *m = &out->multigrid;
  fg__array_shape finest = fg__multigrid_shape(m, 0);
  size_t size = finest.size + FG__LANES;
  size_t count = (description->residual > 0.0 ? 5 : 3) * size;
  float *memory = fg__allocate_aligned(count, sizeof *memory);
  fg_status status = FG_STATUS_OK;
  if (!memory)
    status = fg__fail_memory(context, "the time steps", count * sizeof *memory);
  status = fg__ranks_agree(m->ranks, context, status);
  out->memory = memory;
  bool implicit = !(description->splitting.alpha > 0.0);
  if (!status && !implicit)
    status = fg__theta_create(&out->theta, context, m, description->splitting);
  if (status) {
    fg__stepper_clear(out);
    return status;
  }
  out->current = memory + finest.first;
  out->previous = out->current + size;
  out->first_iterate = out->previous + size;
  if (description->residual > 0.0) {
    out->scratch[0] = out->first_iterate + size;
    out->scratch[1] = out->scratch[0] + size;
  }
  out->total_mass = weigh_domain(out);
  fg__pass_copy(m, fg__multigrid_u(m), out->current);
  status = fg__mass_constraint_create(&out->masses, context, m, out->current);
  out->mean = mean_of(out, out->current);
  if (!status && description->coarser) {
    fg__stepper_hold_means(out);
    fg__mass_constraint_restore(&out->masses, m, out->current);
  }
  if (!status && implicit)
    status = fg__subdomains_create(&out->subdomains, context, m, &out->masses);
  if (status) {
    fg__stepper_clear(out);
    return status;
  }
  fg__sums sums = fg__pass_evaluate(m, out->current, fg__multigrid_w(m));
  out->energy = out->cell_volume * sums.energy;
  out->chemical = out->cell_volume * sums.chemical;
  out->mass = out->cell_volume * sums.u;
  return FG_STATUS_OK;
}

void fg__stepper_hold_means(fg__stepper *stepper)
{
  fg__stepper *s = stepper;
  if (s->masses.count > 1)
    s->mean = fg__mass_constraint_hold(&s->masses, &s->multigrid, s->current);
}

void fg__stepper_clear(fg__stepper *stepper)
{
  fg__multigrid_clear(&stepper->multigrid);
  fg__mass_constraint_clear(&stepper->masses);
  fg__subdomains_clear(&stepper->subdomains);
  fg__theta_clear(&stepper->theta);
  free(stepper->memory);
  *stepper = (fg__stepper){0};
}

/* The first guess of u after a share of the step: with history, the last step's change
 * continued. */
static void guess(fg__stepper *s, double tau, double share)
{
  fg__multigrid *m = &s->multigrid;
  float *u = fg__multigrid_u(m);
  if (!s->history) {
    fg__pass_copy(m, s->current, u);
    return;
  }
  double omega = fmin(tau / s->last_tau, most_extrapolation);
  omega *= share * s->persistence;
  fg__pass_predict(m, s->current, s->previous, omega, u);
}

/* Runs cycles; s->first_iterate becomes u before the last one. With several subdomains
 * the mean of each is restored after every cycle, so that the next one does not restrict
 * the error of the mean. */
static void run_cycles(fg__stepper *s, double tau, int cycles)
{
  fg__multigrid *m = &s->multigrid;
  int at_once = s->masses.count > 1 ? 1 : cycles;
  for (int n = 0; n < cycles; n += at_once) {
    fg__pass_solve(m, tau, at_once, s->first_iterate);
    fg__subdomains_apply(&s->subdomains, m, s->first_iterate);
    fg__mass_constraint_restore(&s->masses, m, fg__multigrid_u(m));
  }
  s->cycles_spent += cycles;
}

static fg__changes changes_of(const fg__stepper *s)
{
  const fg__multigrid *m = &s->multigrid;
  return fg__pass_changes(m, fg__multigrid_u(m), s->current, s->first_iterate,
                          s->previous);
}

static double residual_now(fg__stepper *s, double tau)
{
  return fg__residual(&s->multigrid, &s->subdomains, tau, s->scratch[0], s->scratch[1]);
}

/* Whether floats hold no better solution. */
static bool is_rounding(const fg__stepper *s, double left, double before)
{
  return left > rounding_fall * before &&
         sqrt(changes_of(s).correction / s->total_mass) <= rounding_correction;
}

/* At least the given cycles, then more until the residual is small enough. */
static void solve_to_residual(fg__stepper *s, double tau, int cycles)
{
  const double first = residual_now(s, tau);
  double left = first;
  bool solved = false;
  for (int n = 0; n < MOST_CYCLES && !solved; n += cycles, cycles = 1) {
    const double before = left;
    run_cycles(s, tau, cycles);
    left = residual_now(s, tau);
    solved = left <= s->residual * first || is_rounding(s, left, before);
  }
  double share = first > 0.0 ? left / first : 0.0;
  if (!(share <= s->residual_left))
    s->residual_left = share;
  s->solved = s->solved && solved;
}

static fg__changes solve(fg__stepper *s, double tau, int cycles)
{
  if (s->residual > 0.0)
    solve_to_residual(s, tau, cycles);
  else
    run_cycles(s, tau, cycles);
  return changes_of(s);
}

/* Sets up the system of backward differences; returns the tau in its formula. Without
 * history, at first and after a rejected attempt, they are of first order, and w, which
 * may be left from that attempt, is evaluated anew; else of second order, over two steps
 * of unequal size. */
static double prepare_implicit(fg__stepper *s, double tau)
{
  fg__multigrid *m = &s->multigrid;
  guess(s, tau, 1.0);
  if (!s->history)
    fg__pass_evaluate(m, s->current, fg__multigrid_w(m));
  if (!s->history || !s->second_order) {
    fg__pass_copy(m, s->current, fg__multigrid_p(m));
    return tau;
  }
  double omega = tau / s->last_tau, both = 1.0 + 2.0 * omega;
  fg__pass_extrapolate(m, s->current, s->previous, omega * omega / both,
                       fg__multigrid_p(m));
  return tau * (1.0 + omega) / both;
}

/* The correction is the largest of the substeps'. */
static fg__changes step_by_theta(fg__stepper *s, double tau)
{
  fg__changes sums = {0};
  guess(s, tau, fg__theta_share(s->theta.splitting, 0));
  for (int n = 0; n < FG__THETA_SUBSTEPS; ++n) {
    double worst = sums.correction;
    double substep = fg__theta_prepare(&s->theta, &s->multigrid, n, tau, s->current);
    sums = solve(s, substep, s->cycles);
    sums.correction = fmax(sums.correction, worst);
  }
  return sums;
}

typedef struct outcome {
  double increment, correction, energy, chemical, mean;
  double
      persistence; /* the rate of change projected on the last step's, as a share of it */
  bool accepted;
  bool at_rest; /* the change is within the rounding of the stored density */
} outcome;

/* Cycles do not conserve the mean of u: restores it, in the domain and each subdomain. */
static void restore_means(fg__stepper *s, const fg__changes *sums)
{
  float *u = fg__multigrid_u(&s->multigrid);
  fg__pass_shift(&s->multigrid, u, s->mean - sums->u / s->total_mass);
  fg__mass_constraint_restore(&s->masses, &s->multigrid, u);
}

/* Whether the attempt in the level's u, of which `sums` are, is accepted. */
static outcome judge(fg__stepper *s, double tau, fg__changes sums)
{
  fg__multigrid *m = &s->multigrid;
  outcome result;
  restore_means(s, &sums);
  result.increment = sqrt(sums.change / s->total_mass);
  result.correction = sqrt(sums.correction / s->total_mass) /
                      fmax(result.increment, correction_floor * s->accuracy);
  result.persistence = 0.0;
  if (s->increment > 0.0)
    result.persistence =
        sums.product * s->last_tau / (tau * s->increment * s->increment * s->total_mass);
  fg__sums shifted = fg__pass_evaluate(m, fg__multigrid_u(m), s->first_iterate);
  result.energy = s->cell_volume * shifted.energy;
  result.chemical = s->cell_volume * shifted.chemical;
  result.mean = shifted.u / s->total_mass;
  result.at_rest = result.increment < rest_increment && result.energy >= s->energy &&
                   result.energy - s->energy <= energy_rounding * s->energy;
  /* comparisons are false for NaN, which rejects */
  result.accepted = result.correction <= acceptable_correction &&
                    result.increment <= acceptable_increment * s->accuracy &&
                    result.energy <= s->energy && s->solved;
  return result;
}

static outcome attempt(fg__stepper *s, double tau)
{
  s->residual_left = 0.0;
  s->solved = true;
  if (s->theta.splitting.alpha > 0.0)
    return judge(s, tau, step_by_theta(s, tau));
  double effective = prepare_implicit(s, tau);
  bool failed = s->tau_limit < s->most_tau; /* an attempt was rejected lately */
  fg__subdomains_solve(&s->subdomains, &s->multigrid, tau, effective, s->current, failed);
  outcome result = judge(s, tau, solve(s, effective, s->cycles));
  for (int n = 0; n < MORE_CYCLES && s->solved; ++n) {
    if (result.accepted || result.at_rest || !(result.correction <= hopeless_correction))
      break;
    result = judge(s, tau, solve(s, effective, 1));
  }
  return result;
}

/* The accepted density becomes the current one. */
static void keep(fg__stepper *s, double tau, const outcome *result)
{
  fg__multigrid *m = &s->multigrid;
  float *oldest = s->previous;
  s->previous = s->current;
  s->current = fg__multigrid_u(m);
  fg__multigrid_use(m, oldest);
  s->energy = result->energy;
  s->chemical = result->chemical;
  s->mass = s->cell_volume * s->total_mass * result->mean;
  s->increment = result->increment;
  s->persistence = s->accepted > 0 ? fmin(fmax(result->persistence, 0.0), 1.0) : 1.0;
  s->history = true;
  s->last_tau = tau;
  s->time += tau;
  ++s->accepted;
}

static void choose_next_tau(fg__stepper *s, double tau, const outcome *result)
{
  double by_increment = s->accuracy / result->increment;
  double by_correction = sqrt(wanted_correction / result->correction);
  double factor = fmin(by_increment, by_correction);
  factor = fmin(fmax(factor, most_shrinkage), most_growth);
  s->tau_limit *= relaxation;
  s->tau = fmin(tau * factor, fmin(s->tau_limit, s->most_tau));
  bool quiet = result->increment * s->time < quiet_change * tau &&
               s->time > quiet_after * s->first_tau;
  s->quiet_steps = quiet ? s->quiet_steps + 1 : 0;
}

/* A step in which nothing moves: time alone goes on. */
static void pass_time(fg__stepper *s, double tau)
{
  s->history = false;
  s->last_tau = tau;
  s->time += tau;
  ++s->accepted;
  outcome nothing = {.correction = 0.0};
  choose_next_tau(s, tau, &nothing);
  s->increment = 0.0;
}

static fg_status fail_step(const fg__stepper *s, fg_context *context, double tau,
                           const outcome *result)
{
  char residual[96] = "";
  if (s->residual > 0.0)
    snprintf(residual, sizeof residual,
             ", its residual %g of the first guess's (at most %g)", s->residual_left,
             s->residual);
  fg__fail(context, FG_STATUS_NO_CONVERGENCE,
           "no time step is accepted after step %" PRId64 " at t = %g, down to tau = %g: "
           "its rms change is %g, its relative correction %g (at most %g), its energy %g "
           "(at most %g)%s",
           s->accepted, s->time, tau, result->increment, result->correction,
           acceptable_correction, result->energy, s->energy, residual);
  fg__hint(context, "Take a larger gamma or more nodes.");
  return FG_STATUS_NO_CONVERGENCE;
}

fg_status fg__stepper_advance(fg__stepper *stepper, fg_context *context)
{
  fg__stepper *s = stepper;
  double tau = s->tau;
  for (;;) {
    outcome result = attempt(s, tau);
    if (result.at_rest) {
      pass_time(s, tau);
      return FG_STATUS_OK;
    }
    if (result.accepted) {
      keep(s, tau, &result);
      choose_next_tau(s, tau, &result);
      if (fabs(result.mean - s->mean) <= mass_tolerance)
        return FG_STATUS_OK;
      return fg__fail(context, FG_STATUS_NO_CONVERGENCE,
                      "the mean density drifted by %g (allowed %g) in step %" PRId64,
                      result.mean - s->mean, mass_tolerance, s->accepted);
    }
    ++s->rejected;
    s->history = false;
    s->tau_limit = after_reject * tau;
    tau *= reject_factor;
    if (!(tau > least_tau_share * s->first_tau))
      return fail_step(s, context, tau, &result);
  }
}

bool fg__stepper_stationary(const fg__stepper *stepper)
{
  return stepper->quiet_steps >= QUIET_STEPS;
}
