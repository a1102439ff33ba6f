#include <math.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "evolution/options.h"
#include "evolution/tensor.h"
#include "field/fingerprint.h"
#include "grid/field_slabs.h"

/* A thinner interface lies between two nodes and can not move (pinning). */
static const double least_interface_cells = 0.3;

/* The minima of the double well are at -1 and 1; an initial density far beyond them is a
 * mistake. */
static const double most_initial = 10.0;

/* Debris is less than this many squares (in 3D cubes) of the least interface width,
 * sqrt(gamma a): about a dozen cells by default, and in 3D a ball of the same radius.
 * Such a droplet has no bulk, and is about to vanish. */
static const double debris_squares = 10.0, debris_cubes = 24.0;

/* The first step, as a share of the growth time of linear theory (least over modes); and
 * the first on a coarsened mesh, whose u has interfaces already. */
static const double first_step_share = 1e-3, first_coarsened_fraction = 0.1;

/* Greatest tau gamma / h^4 (measured at 1025 nodes, docs/design/evolution.md). */
static const double most_stiffness = 2e5;

static fg_status create_mesh(fg_evolution *e, const fg_field *field)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  fg__mesh_description description = {.dimension = arrays->dimension,
                                      .nodes = e->mesh_nodes,
                                      .coarsest =
                                          fg__default_nodes(arrays->dimension) - 1,
                                      .ranks = e->ranks,
                                      .may_idle = e->coarsenings > 0};
  for (int k = 0; k < arrays->dimension; ++k) {
    description.origin[k] = arrays->axis[k][0];
    description.periodic[k] = arrays->period[k] > 0.0;
    description.side[k] = description.periodic[k]
                              ? arrays->period[k]
                              : arrays->axis[k][arrays->size[k] - 1] - arrays->axis[k][0];
  }
  return fg__mesh_create(&e->mesh, e->context, &description);
}

static fg_status check_interface(const fg_evolution *e)
{
  double cells = sqrt(e->info.gamma * e->options.anisotropy) / fg__evolution_spacing(e);
  if (cells >= least_interface_cells)
    return FG_STATUS_OK;
  fg__fail(e->context, FG_STATUS_ARGUMENT,
           "gamma %g makes interfaces %.3g cells wide; at least %g are needed",
           e->info.gamma, cells, least_interface_cells);
  fg__hint(e->context, "Take a larger gamma or more nodes.");
  return FG_STATUS_ARGUMENT;
}

static fg_status check_initial(const fg_evolution *e)
{
  const float *u = e->options.initial;
  for (size_t n = 0; u && n < e->nodes; ++n)
    if (!(fabs((double)u[n]) <= most_initial))
      return fg__fail(e->context, FG_STATUS_ARGUMENT,
                      "initial density %g at node %zu; at most %g in size is possible",
                      (double)u[n], n, most_initial);
  return FG_STATUS_OK;
}

/* The longest step. Beyond it the theta scheme is unstable, and the cycles of an implicit
 * step move interfaces less than the step should, which the correction does not show. */
static double most_step(const fg_evolution *e)
{
  double gamma = e->info.gamma;
  if (e->options.scheme == FG_SCHEME_THETA) {
    double least = fg__evolution_least_spacing(e);
    return fg__theta_stable_step(fg__evolution_splitting(e),
                                 e->options.anisotropy * gamma, gamma,
                                 4.0 / (least * least));
  }
  double h = pow(fg__evolution_cell_volume(e), 1.0 / e->mesh.dimension);
  double first = first_step_share / fg__evolution_growth_rate(e);
  return fmax(most_stiffness * h * h * h * h / gamma, first);
}

static void count_cells(fg_evolution *e)
{
  e->nodes = e->cells = 1;
  for (int k = 0; k < e->mesh.dimension; ++k) {
    e->nodes *= (size_t)e->mesh.partition.nodes[k];
    e->cells *= (size_t)e->mesh.cells[k];
  }
}

/* Fills in what fg_evolution_mesh returns. */
static void describe_mesh(fg_evolution *e)
{
  int dimension = e->mesh.dimension;
  e->info = (fg_mesh_info){.dimension = dimension,
                           .cells = {1, 1, 1},
                           .gamma = fg__evolution_interface_energy(e),
                           .anisotropy = e->options.anisotropy,
                           .isotropic_below = e->options.isotropic_below,
                           .coverage = e->options.coverage,
                           .noise = e->options.noise,
                           .theta = e->options.theta,
                           .alpha = e->options.alpha,
                           .adaptive = fg__evolution_adapts(e),
                           .length = e->mesh.length};
  double cell = 1.0;
  for (int k = 0; k < dimension; ++k) {
    e->info.cells[k] = e->mesh.cells[k];
    e->info.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
    cell *= e->info.spacing[k];
  }
  e->info.active_cells = e->active_cells;
  e->info.domain_measure = cell * (double)e->info.active_cells;
}

static double find_debris_cells(const fg_evolution *e)
{
  double width = sqrt(e->info.gamma * e->info.anisotropy);
  double debris = e->mesh.dimension == 3 ? debris_cubes * width * width * width
                                         : debris_squares * width * width;
  return debris / fg__evolution_cell_volume(e);
}

static fg_status take_mask(fg_evolution *e, const fg__multigrid *multigrid)
{
  const fg__cells_of_box *cells = &fg__multigrid_finest(multigrid)->tensor;
  if (e->active_cells == (int64_t)e->cells)
    return FG_STATUS_OK;
  ptrdiff_t origin;
  e->mask.memory = fg__cells_mask(cells, &origin);
  if (!e->mask.memory)
    return fg__fail_memory(e->context, "the mask", e->cells);
  e->mask.active = e->mask.memory + origin;
  e->mask.row = cells->row;
  e->mask.plane = cells->plane;
  return FG_STATUS_OK;
}

static fg_status create_stepper(fg_evolution *e)
{
  fg__multigrid multigrid = {0};
  fg__stepper_description description = {
      .cell_volume = fg__evolution_cell_volume(e),
      .first_tau = (e->coarsened ? first_coarsened_fraction : first_step_share) /
                   fg__evolution_growth_rate(e),
      .most_tau = most_step(e),
      .accuracy = e->options.accuracy,
      .cycles = e->options.cycles,
      .residual = e->options.residual,
      .second_order = e->options.scheme == FG_SCHEME_BDF2,
      .splitting = fg__evolution_splitting(e),
      .coarser = e->coarsened};
  fg_status status = fg__ranks_agree(e->ranks, e->context, check_initial(e));
  if (!status)
    status = fg__evolution_multigrid_create(
        &multigrid, e, fg__theta_held(description.splitting) * e->info.gamma);
  if (status)
    return status;
  multigrid.kernel = fg__kernel_choose(e->mesh.dimension, e->options.vectors);
  e->info.kernel = multigrid.kernel->name;
  status = fg__ranks_agree(e->ranks, e->context, take_mask(e, &multigrid));
  if (!status)
    status = fg__evolution_fill(e, &multigrid);
  if (!status)
    status = fg__stepper_create(&e->stepper, e->context, &multigrid, &description);
  if (status)
    fg__multigrid_clear(&multigrid);
  return status;
}

static fg_status begin(fg_evolution *e, fg_context *context, const fg__ranks *ranks,
                       const fg_field *field, const fg_evolution_options *options)
{
  e->context = context;
  e->ranks = ranks;
  e->field = field;
  e->start = fg__clock_seconds();
  if (options)
    e->options = *options;
  e->field_fingerprint = fg__field_fingerprint(field);
  fg_status status = fg__evolution_options_settle(&e->options, context,
                                                  fg_field_contents(field)->dimension);
  if (!status) {
    e->law = *e->options.law;
    e->law_identity = e->law.identity;
    if (e->options.isotropic_below > 0.0)
      e->law.data = &e->options.isotropic_below;
    e->options.law = &e->law;
  }
  e->mesh_nodes = e->options.nodes;
  e->clusters_found = fg__allocate(1, sizeof *e->clusters_found);
  if (!status && !e->clusters_found)
    status = fg__fail_memory(context, "an evolution", sizeof *e->clusters_found);
  return status;
}

fg_status fg__evolution_build(fg_evolution *evolution)
{
  fg_evolution *e = evolution;
  const fg_field *field = e->field;
  fg_status status = fg__field_check_shared(e->context, e->ranks, field);
  if (!status)
    status = fg__evolution_check_alike(e);
  if (!status)
    status = create_mesh(e, field);
  if (!status) {
    count_cells(e);
    if (e->ranks->count == 1 && (double)e->nodes >= fg__least_threaded_nodes)
      status = fg__threads_create(&e->threads, e->context, e->options.threads);
  }
  if (!status)
    status = fg__evolution_cells_create(e, field);
  if (!status) {
    describe_mesh(e);
    e->debris_area = find_debris_cells(e);
    status = check_interface(e);
  }
  if (!status)
    status = create_stepper(e);
  return status;
}

fg_status fg_evolution_create(fg_evolution **out, fg_context *context,
                              const fg_field *field, const fg_evolution_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "evolution: a NULL argument");
  *out = NULL;
  return fg__evolution_create(out, context, fg__ranks_of(context), field, options);
}

fg_status fg__evolution_create(fg_evolution **out, fg_context *context,
                               const fg__ranks *ranks, const fg_field *field,
                               const fg_evolution_options *options)
{
  *out = NULL;
  fg_status status;
  fg_phase before = fg__phase_begin(ranks->counters, FG_PHASE_SETUP);
  fg_evolution *e = fg__allocate(1, sizeof *e);
  if (e)
    status = begin(e, context, ranks, field, options);
  else
    status = fg__fail_memory(context, "an evolution", sizeof *e);
  status = fg__ranks_agree(ranks, context, status);
  if (e && !status)
    status = fg__evolution_build(e);
  fg__phase_return(ranks->counters, before);
  if (e)
    e->options.initial = NULL; /* the caller's, and used up */
  if (status) {
    fg_evolution_destroy(e);
    return status;
  }
  *out = e;
  return FG_STATUS_OK;
}

void fg__evolution_clear(fg_evolution *evolution)
{
  fg_evolution *e = evolution;
  fg__stepper_clear(&e->stepper);
  fg__threads_destroy(e->threads);
  e->threads = NULL;
  if (e->clusters_found)
    fg__clusters_clear(e->clusters_found);
  fg__mesh_clear(&e->mesh);
  fg__cells_clear(&e->finest_cells);
  free(e->mask.memory);
  e->mask.memory = NULL;
  e->mask.active = NULL;
  e->active_cells = 0;
}

void fg_evolution_destroy(fg_evolution *evolution)
{
  if (!evolution)
    return;
  fg__evolution_clear(evolution);
  free(evolution->clusters_found);
  free(evolution);
}

const fg_mesh_info *fg_evolution_mesh(const fg_evolution *evolution)
{
  return &evolution->info;
}

double fg__evolution_seconds(const fg_evolution *evolution)
{
  return evolution->earlier_seconds + fg__clock_seconds() - evolution->start;
}

fg_step fg__evolution_describe(const fg_evolution *evolution, int cycles, int rejected)
{
  const fg_evolution *e = evolution;
  const fg__stepper *s = &e->stepper;
  double unit = fg__evolution_unit(e);
  return (fg_step){.step = e->earlier_steps + s->accepted,
                   .time = unit * s->time,
                   .tau = unit * s->last_tau,
                   .energy = s->energy / unit,
                   .chemical_energy = s->chemical / unit,
                   .gradient_energy = (s->energy - s->chemical) / unit,
                   .mass = s->mass,
                   .area_fraction = e->area_fraction,
                   .clusters = e->clusters,
                   .cycles = cycles,
                   .rejected = rejected,
                   .residual = s->residual_left,
                   .cells = e->info.active_cells,
                   .coarsenings = e->coarsenings,
                   .increment = s->increment,
                   .seconds = fg__evolution_seconds(e),
                   .stationary = fg__stepper_stationary(s)};
}

fg_status fg_evolution_step(fg_evolution *evolution, fg_step *step)
{
  fg_evolution *e = evolution;
  fg_step coarsened;
  fg_phase before = fg__phase_begin(e->ranks->counters, FG_PHASE_STEPS);
  /* not within the step: one that has begun is ended, as a resumed run would do it */
  fg_status status = fg__ranks_agree(e->ranks, e->context, fg__check_stop(e->context));
  /* before a step, not after: a checkpoint holds what the next step begins with */
  if (!status && fg__evolution_adapts(e) && fg_evolution_should_coarsen(e))
    status = fg_evolution_coarsen(e, &coarsened);
  int64_t cycles = e->stepper.cycles_spent, rejected = e->stepper.rejected;
  if (!status)
    status = fg__stepper_advance(&e->stepper, e->context);
  if (!status)
    status = fg__evolution_count(e);
  fg__phase_return(e->ranks->counters, before);
  if (!status)
    *step = fg__evolution_describe(e, (int)(e->stepper.cycles_spent - cycles),
                                   (int)(e->stepper.rejected - rejected));
  return status;
}
