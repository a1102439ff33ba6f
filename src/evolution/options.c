#include <math.h>
#include <string.h>

#include "base/mix.h"
#include "evolution/options.h"

/* Defaults that give the paper's pictures. */
enum { DEFAULT_NODES = 257, DEFAULT_NODES_3D = 65, DEFAULT_SEED = 1 };
static const double default_anisotropy = 0.15, default_coverage = 0.3;
/* Strong noise gives separate grains, weak noise stripes along whole streamlines
 * (docs/design/evolution.md). */
static const double default_noise = 1.5, most_noise = 5.0;
/* By scheme: chosen by time and error, which stays below the scatter of seeds
 * (docs/design/evolution.md, docs/method/schemes.md). */
static const double default_accuracy[] = {0.08, 0.05, 0.05};
static const int default_cycles[] = {2, 3, 3};

int fg__default_nodes(int dimension)
{
  return dimension == 3 ? DEFAULT_NODES_3D : DEFAULT_NODES;
}

static fg_status check_range(fg_context *context, const char *name, double value,
                             double low, double high, bool low_included)
{
  if ((low_included ? value >= low : value > low) && value <= high)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "%s %g is not in %c%g, %g]", name, value,
                  low_included ? '[' : '(', low, high);
}

static fg_status check_isotropic_below(const fg_evolution_options *o, fg_context *context)
{
  if (!(o->isotropic_below >= 0.0) || isinf(o->isotropic_below))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "isotropic_below: the speed %g is not in [0, inf)",
                    o->isotropic_below);
  if (o->isotropic_below > 0.0 && o->energy != FG_ENERGY_FLOW)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "isotropic_below: the speed %g: only with the energy flow",
                    o->isotropic_below);
  return FG_STATUS_OK;
}

static fg_status check_open_range(fg_context *context, const char *name, double value,
                                  double low, double high)
{
  if (value > low && value < high)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "%s %g is not in (%g, %g)", name, value,
                  low, high);
}

/* After the defaults: those of other schemes are 0. */
static fg_status check_splitting(const fg_evolution_options *o, fg_context *context)
{
  if (o->scheme != FG_SCHEME_THETA && (o->theta != 0.0 || o->alpha != 0.0))
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s %g: only with the scheme theta",
                    o->theta != 0.0 ? "theta" : "alpha",
                    o->theta != 0.0 ? o->theta : o->alpha);
  if (o->scheme != FG_SCHEME_THETA)
    return FG_STATUS_OK;
  fg_status status = check_open_range(context, "theta", o->theta, 0.0, 0.5);
  return status ? status : check_range(context, "alpha", o->alpha, 0.5, 1.0, false);
}

static void fill_in_defaults(fg_evolution_options *o)
{
  if (o->law->anisotropy > 0.0)
    o->anisotropy = o->law->anisotropy;
  else if (o->anisotropy == 0.0)
    o->anisotropy = default_anisotropy;
  if (o->coverage == 0.0)
    o->coverage = default_coverage;
  if (o->noise == 0.0)
    o->noise = default_noise;
  if (o->seed == 0)
    o->seed = DEFAULT_SEED;
  if (o->accuracy == 0.0)
    o->accuracy = default_accuracy[o->scheme];
  if (o->cycles == 0)
    o->cycles = default_cycles[o->scheme];
  if (o->scheme == FG_SCHEME_THETA && o->theta == 0.0)
    o->theta = fg__theta_default.theta;
  if (o->scheme == FG_SCHEME_THETA && o->alpha == 0.0)
    o->alpha = fg__theta_default.alpha;
}

static fg_status check_numbers(const fg_evolution_options *o, fg_context *context)
{
  fg_status status = check_range(context, "anisotropy", o->anisotropy, 0.0, 1.0, false);
  if (!status)
    status = check_open_range(context, "coverage", o->coverage, 0.0, 1.0);
  if (!status)
    status = check_splitting(o, context);
  if (!status && o->residual != 0.0)
    status = check_open_range(context, "residual", o->residual, 0.0, (double)INFINITY);
  if (!status)
    status = check_range(context, "accuracy", o->accuracy, 0.0, 1.0, false);
  if (!status)
    status = check_isotropic_below(o, context);
  if (!status)
    status = check_range(context, "noise", o->noise, 0.0, most_noise, false);
  if (!status)
    status = check_range(context, "cycles", o->cycles, 1, 1000, true);
  if (!status && o->gamma != 0.0)
    status = check_range(context, "gamma", o->gamma, 0.0, 1.0, false);
  if (!status)
    status = check_range(context, "vectors", o->vectors, 0, FG_VECTORS_AVX512, true);
  if (!status && o->threads < 0)
    status =
        fg__fail(context, FG_STATUS_ARGUMENT,
                 "threads: %d; at least 1, or 0 for all cores, is needed", o->threads);
  return status;
}

fg_status fg__evolution_options_settle(fg_evolution_options *o, fg_context *context,
                                       int dimension)
{
  fg_status status = check_range(context, "scheme", o->scheme, 0, FG_SCHEME_THETA, true);
  if (!status)
    status = check_range(context, "mesh", o->mesh, 0, FG_MESH_UNIFORM, true);
  if (status)
    return status;
  if (o->nodes == 0)
    o->nodes = fg__default_nodes(dimension);
  if (o->law)
    o->energy = FG_ENERGY_LAW;
  else
    o->law = fg__energy(o->energy);
  if (!o->law)
    return fg__fail(context, FG_STATUS_ARGUMENT, "there is no energy number %d",
                    (int)o->energy);
  fill_in_defaults(o);
  return check_numbers(o, context);
}

fg_status fg__evolution_check_alike(const fg_evolution *e)
{
  const fg_evolution_options *o = &e->options;
  const double numbers[] = {o->anisotropy, o->isotropic_below, o->coverage,
                            o->gamma,      o->accuracy,        o->noise,
                            o->residual,   o->theta,           o->alpha};
  const int words[] = {o->nodes,       o->cycles,    (int)o->energy,
                       (int)o->scheme, (int)o->mesh, o->initial != NULL};
  uint64_t key = fg__mix(e->field_fingerprint ^ fg__mix(o->seed));
  key = fg__mix(key ^ e->law_identity);
  for (size_t n = 0; n < sizeof words / sizeof *words; ++n)
    key = fg__mix(key ^ (uint64_t)words[n]);
  for (size_t n = 0; n < sizeof numbers / sizeof *numbers; ++n) {
    uint64_t bits;
    memcpy(&bits, &numbers[n], sizeof bits);
    key = fg__mix(key ^ bits);
  }
  if (fg__ranks_alike(e->ranks, key))
    return FG_STATUS_OK;
  return fg__fail(e->context, FG_STATUS_ARGUMENT,
                  "the %d ranks have different fields or options", e->ranks->count);
}
