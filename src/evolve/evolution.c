#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/mix.h"
#include "evolve/evolution.h"
#include "evolve/field_boxes.h"
#include "field/fingerprint.h"

/* Defaults that give the paper's pictures (design.md section 2). */
enum { DEFAULT_NODES = 257, DEFAULT_NODES_3D = 65, DEFAULT_SEED = 1, DEFAULT_CYCLES = 3 };
static const double default_anisotropy = 0.15, default_coverage = 0.3;
/* By scheme: chosen by the time they take for the same error (docs/design/interfaces.md,
 * docs/method/schemes.md). */
static const double default_accuracy[] = {0.08, 0.05, 0.05};
/* Half-width of an interface along the stream in cells; at 1 an isotropic pattern pins.
 */
static const double interface_cells = 1.1, isotropic_interface_cells = 1.5;
/* A thinner one lies between two nodes and can not move. */
static const double least_interface_cells = 0.3;

/* The wells are at -1 and 1; an initial density far beyond them is a mistake. */
static const double most_initial = 10.0;

/* Debris: less than this many squares (in 3D cubes) of the interface width across the
 * stream, sqrt(gamma a); about a dozen cells by default, balls of the same radius in 3D.
 * Such a drop is all interface. */
static const double debris_squares = 10.0, debris_cubes = 24.0;

/* The first step, as a share of the fastest growth time of linear theory. */
static const double first_step_share = 1e-3;

/* tau gamma / h^4 (measured at 1025 nodes, docs/design/evolution.md). */
static const double most_stiffness = 2e5;

static fg_status check_range(fg_context *context, const char *name, double value,
                             double low, double high, bool low_included)
{
  if ((low_included ? value >= low : value > low) && value <= high)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "%s %g is not in %c%g, %g]", name, value,
                  low_included ? '[' : '(', low, high);
}

static fg_status settle_options(fg_evolution_options *o, fg_context *context,
                                int dimension)
{
  fg_status status = check_range(context, "scheme", o->scheme, 0, FG_SCHEME_THETA, true);
  if (status)
    return status;
  if (o->nodes == 0)
    o->nodes = dimension == 3 ? DEFAULT_NODES_3D : DEFAULT_NODES;
  if (o->law)
    o->energy = FG_ENERGY_LAW;
  else
    o->law = fg__energy(o->energy);
  if (!o->law)
    return fg__fail(context, FG_STATUS_ARGUMENT, "there is no energy number %d",
                    (int)o->energy);
  if (o->law->anisotropy > 0.0)
    o->anisotropy = o->law->anisotropy;
  else if (o->anisotropy == 0.0)
    o->anisotropy = default_anisotropy;
  if (o->coverage == 0.0)
    o->coverage = default_coverage;
  if (o->seed == 0)
    o->seed = DEFAULT_SEED;
  if (o->accuracy == 0.0)
    o->accuracy = default_accuracy[o->scheme];
  if (o->cycles == 0)
    o->cycles = DEFAULT_CYCLES;
  status = check_range(context, "anisotropy", o->anisotropy, 0.0, 1.0, false);
  if (!status && !(o->coverage > 0.0 && o->coverage < 1.0))
    status = fg__fail(context, FG_STATUS_ARGUMENT, "coverage %g is not in (0, 1)",
                      o->coverage);
  if (!status)
    status = check_range(context, "accuracy", o->accuracy, 0.0, 1.0, false);
  if (!status)
    status = check_range(context, "cycles", o->cycles, 1, 1000, true);
  if (!status && o->gamma != 0.0)
    status = check_range(context, "gamma", o->gamma, 0.0, 1.0, false);
  if (!status && o->threads < 0)
    status = fg__fail(context, FG_STATUS_ARGUMENT, "%d threads", o->threads);
  return status;
}

static fg_status create_mesh(fg_evolution *e, const fg_field *field)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  fg__mesh_description description = {
      .dimension = arrays->dimension, .nodes = e->options.nodes, .ranks = e->ranks};
  for (int k = 0; k < arrays->dimension; ++k) {
    description.origin[k] = arrays->axis[k][0];
    description.periodic[k] = arrays->period[k] > 0.0;
    description.side[k] = description.periodic[k]
                              ? arrays->period[k]
                              : arrays->axis[k][arrays->size[k] - 1] - arrays->axis[k][0];
  }
  return fg__mesh_create(&e->mesh, e->context, &description);
}

static double largest_spacing(const fg_evolution *e)
{
  double h = 0.0;
  for (int k = 0; k < e->mesh.dimension; ++k)
    h = fmax(h, e->mesh.spacing[k]);
  return h;
}

static double least_spacing(const fg_evolution *e)
{
  double h = (double)INFINITY;
  for (int k = 0; k < e->mesh.dimension; ++k)
    h = fmin(h, e->mesh.spacing[k]);
  return h;
}

double fg__evolution_cell_volume(const fg_evolution *e)
{
  double volume = 1.0;
  for (int k = 0; k < e->mesh.dimension; ++k)
    volume *= e->mesh.spacing[k];
  return volume;
}

static double interface_energy(const fg_evolution *e)
{
  double h = largest_spacing(e);
  bool isotropic = e->options.law->anisotropy >= 1.0;
  double width = (isotropic ? isotropic_interface_cells : interface_cells) * h;
  return e->options.gamma > 0.0 ? e->options.gamma
                                : width * width / e->options.anisotropy;
}

static fg_status allocate_tensor(fg_evolution *e)
{
  float **arrays[] = {&e->tensor.xx, &e->tensor.xy, &e->tensor.yy,
                      &e->tensor.zz, &e->tensor.xz, &e->tensor.yz};
  int count = e->mesh.dimension == 3 ? 6 : 3;
  bool whole = true;
  for (int n = 0; n < count; ++n) {
    *arrays[n] = fg__allocate(e->cells, sizeof **arrays[n]);
    whole = whole && *arrays[n];
  }
  e->tensor.active = fg__allocate(e->cells, 1);
  if (whole && e->tensor.active)
    return FG_STATUS_OK;
  return fg__fail_memory(e->context, "the tensor",
                         e->cells * ((size_t)count * sizeof(float) + 1));
}

static void free_tensor(fg_evolution *e)
{
  float **arrays[] = {&e->tensor.xx, &e->tensor.xy, &e->tensor.yy,
                      &e->tensor.zz, &e->tensor.xz, &e->tensor.yz};
  for (int n = 0; n < 6; ++n) {
    free(*arrays[n]);
    *arrays[n] = NULL;
  }
}

static fg__tensor_recipe recipe_of(const fg_evolution *e, const fg_field *field)
{
  fg__tensor_recipe r = {.field = field,
                         .law = e->options.law,
                         .anisotropy = e->options.anisotropy,
                         .dimension = e->mesh.dimension,
                         .cells = {1, 1, 1},
                         .masked = e->active_cells < (long)e->cells};
  /* an interface across the stream is sqrt(gamma) wide */
  if (e->options.law->axes)
    r.width = sqrt(interface_energy(e)) * e->mesh.length;
  for (int k = 0; k < r.dimension; ++k) {
    r.cells[k] = e->mesh.cells[k];
    r.periodic[k] = e->mesh.periodic[k];
    r.origin[k] = e->mesh.origin[k];
    r.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
  }
  return r;
}

/* The active cells whose lowest corners a box owns. */
static fg_status count_box(const fg_evolution *e, const fg__tensor_recipe *recipe,
                           const fg__box *box, fg__wide_tensor *wide, uint64_t *active)
{
  fg__cells_of_box cells;
  fg_status status = fg__cells_for_box(&cells, e->context, recipe, box, wide);
  const fg__box own = fg__box_cells(&e->mesh.partition, box);
  for (int k = 0; k < own.nodes[2] && !status; ++k)
    for (int j = 0; j < own.nodes[1]; ++j)
      for (int i = 0; i < own.nodes[0]; ++i)
        *active += cells.weight[fg__cell_at(&cells, i, j, k)] > 0.0F;
  fg__cells_clear(&cells);
  return status;
}

static fg_status count_active_cells(fg_evolution *e, const fg_field *field)
{
  const fg__partition *partition = &e->mesh.partition;
  fg__tensor_recipe recipe = recipe_of(e, field);
  recipe.width = 0.0; /* directions do not matter */
  recipe.law = &fg__law_isotropic;
  recipe.anisotropy = 1.0;
  uint64_t active = 0;
  int boxes;
  const fg__box *own = fg__own_boxes(partition, &boxes);
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg__most_boxes(partition) && !status; ++n) {
    fg__wide_tensor wide;
    status = fg__wide_of_box(&wide, e->context, &recipe, partition, n);
    if (status)
      break;
    if (n < boxes)
      status = count_box(e, &recipe, &own[n], &wide, &active);
    status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  }
  if (status)
    return status;
  fg__ranks_add(e->mesh.ranks, &active, 1);
  e->active_cells = (long)active;
  if (active == 0)
    return fg__fail(e->context, FG_STATUS_ARGUMENT, "the field is missing everywhere");
  return FG_STATUS_OK;
}

static fg_status create_tensor(fg_evolution *e, const fg_field *field)
{
  if (e->spread)
    return count_active_cells(e, field);
  fg_status status = allocate_tensor(e);
  if (status)
    return status;
  fg__cells cells = {.dimension = e->mesh.dimension};
  for (int k = 0; k < e->mesh.dimension; ++k) {
    cells.count[k] = e->mesh.cells[k];
    cells.origin[k] = e->mesh.origin[k];
    cells.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
  }
  status = fg__tensor_fill(&e->tensor, e->context, field, e->options.law,
                           e->options.anisotropy, &cells, e->team);
  for (size_t n = 0; n < e->cells && !status; ++n)
    e->active_cells += e->tensor.active[n];
  double width = recipe_of(e, field).width;
  if (status || !(width > 0.0))
    return status;
  return fg__tensor_smooth(&e->tensor, e->context, e->options.anisotropy, &cells,
                           e->mesh.periodic, width, e->team);
}

static fg_status check_interface(const fg_evolution *e)
{
  double h = largest_spacing(e);
  double cells = sqrt(e->info.gamma * e->options.anisotropy) / h;
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

/* The fastest growing mode of linear theory grows at this rate (design.md section 3).
 * Where the mean itself is stable the wells' own curvature sets the pace. */
double fg__evolution_growth_rate(const fg_evolution *e)
{
  double mean = 2.0 * e->options.coverage - 1.0;
  double curvature = fmax(fabs(6.0 * mean * mean - 2.0), 1.0);
  return curvature * curvature / (4.0 * e->options.anisotropy * e->info.gamma);
}

/* Beyond it the theta scheme is not stable, and the cycles of implicit steps move less of
 * a pattern than such a step should, unseen. */
static double most_step(const fg_evolution *e)
{
  double gamma = e->info.gamma;
  if (e->options.scheme == FG_SCHEME_THETA) {
    double least = least_spacing(e);
    return fg__theta_stable_step(fg__theta_alpha, e->options.anisotropy * gamma, gamma,
                                 4.0 / (least * least));
  }
  double h = pow(fg__evolution_cell_volume(e), 1.0 / e->mesh.dimension);
  double first = first_step_share / fg__evolution_growth_rate(e);
  return fmax(most_stiffness * h * h * h * h / gamma, first);
}

/* Nodes along an axis; the repeated last one of a periodic axis is left out. */
static int nodes_along(const fg__mesh *mesh, int axis)
{
  if (axis >= mesh->dimension)
    return 1;
  return mesh->periodic[axis] ? mesh->cells[axis] : mesh->cells[axis] + 1;
}

static void count_cells(fg_evolution *e)
{
  e->nodes = e->cells = 1;
  for (int k = 0; k < e->mesh.dimension; ++k) {
    e->nodes *= (size_t)nodes_along(&e->mesh, k);
    e->cells *= (size_t)e->mesh.cells[k];
  }
}

static void describe(fg_evolution *e)
{
  int dimension = e->mesh.dimension;
  e->info = (fg_mesh_info){.dimension = dimension,
                           .cells = {1, 1, 1},
                           .gamma = interface_energy(e),
                           .anisotropy = e->options.anisotropy,
                           .coverage = e->options.coverage,
                           .length = e->mesh.length};
  double cell = 1.0;
  for (int k = 0; k < dimension; ++k) {
    e->info.cells[k] = e->mesh.cells[k];
    e->info.spacing[k] = e->mesh.spacing[k] * e->mesh.length;
    cell *= e->info.spacing[k];
  }
  e->info.active_cells = e->active_cells;
  e->info.domain_measure = cell * (double)e->info.active_cells;
  double width = sqrt(e->info.gamma * e->info.anisotropy);
  double debris = dimension == 3 ? debris_cubes * width * width * width
                                 : debris_squares * width * width;
  e->debris_area = debris / fg__evolution_cell_volume(e);
}

/* Of the theta scheme; 0: an implicit one. */
static double alpha_of(const fg_evolution *e)
{
  return e->options.scheme == FG_SCHEME_THETA ? fg__theta_alpha : 0.0;
}

static fg_status create_multigrid(fg_evolution *e, const fg_field *field,
                                  fg__multigrid *out)
{
  double gamma = (1.0 - alpha_of(e)) * e->info.gamma;
  if (e->spread) {
    fg__tensor_recipe recipe = recipe_of(e, field);
    return fg__multigrid_create_spread(out, e->context, &e->mesh, &recipe, gamma);
  }
  fg_status status = fg__multigrid_create(out, e->context, &e->mesh, &e->mesh.tile[0],
                                          &e->tensor, gamma, e->team);
  free_tensor(e);
  return status;
}

static fg_status create_stepper(fg_evolution *e, const fg_field *field)
{
  fg__multigrid multigrid = {0};
  fg__stepper_description description = {
      .cell_volume = fg__evolution_cell_volume(e),
      .first_tau = first_step_share / fg__evolution_growth_rate(e),
      .most_tau = most_step(e),
      .accuracy = e->options.accuracy,
      .cycles = e->options.cycles,
      .second_order = e->options.scheme == FG_SCHEME_BDF2,
      .alpha = alpha_of(e)};
  fg_status status = fg__ranks_agree(e->ranks, e->context, check_initial(e));
  if (!status)
    status = create_multigrid(e, field, &multigrid);
  if (status)
    return status;
  e->info.kernel = multigrid.kernel->name;
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
  clock_gettime(CLOCK_MONOTONIC, &e->start);
  if (options)
    e->options = *options;
  e->field_fingerprint = fg__field_fingerprint(field);
  fg_status status =
      settle_options(&e->options, context, fg_field_contents(field)->dimension);
  if (!status)
    e->law_identity = e->options.law->identity;
  return status;
}

/* Ranks with different meshes would wait for messages that never come. */
static fg_status check_alike(const fg_evolution *e)
{
  const fg_evolution_options *o = &e->options;
  const double numbers[] = {o->anisotropy, o->coverage, o->gamma, o->accuracy};
  const int words[] = {o->nodes, o->cycles, (int)o->energy, (int)o->scheme,
                       o->initial != NULL};
  uint64_t key = fg__mix(e->field_fingerprint ^ fg__mix(o->seed));
  key = fg__mix(key ^ e->law_identity);
  for (int n = 0; n < 5; ++n)
    key = fg__mix(key ^ (uint64_t)words[n]);
  for (int n = 0; n < 4; ++n) {
    uint64_t bits;
    memcpy(&bits, &numbers[n], sizeof bits);
    key = fg__mix(key ^ bits);
  }
  /* halves are whole numbers in a double; the greatest of -x is the least of x */
  double high = (double)(key >> 32), low = (double)(uint32_t)key;
  double greatest[] = {high, -high, low, -low};
  fg__ranks_greatest(e->ranks, greatest, 4);
  if (greatest[0] == -greatest[1] && greatest[2] == -greatest[3])
    return FG_STATUS_OK;
  return fg__fail(e->context, FG_STATUS_ARGUMENT,
                  "the %d ranks have different fields or options", e->ranks->count);
}

static fg_status build(fg_evolution *e, const fg_field *field)
{
  fg_status status = fg__field_check_shared(e->context, e->ranks, field);
  if (!status)
    status = check_alike(e);
  if (!status)
    status = create_mesh(e, field);
  if (!status) {
    count_cells(e);
    e->spread = e->ranks->count > 1 || e->mesh.partition.count != 1;
    if (!e->spread && (double)e->nodes >= fg__least_shared_nodes)
      status = fg__team_create(&e->team, e->context, e->options.threads);
  }
  if (!status)
    status = create_tensor(e, field);
  if (!status) {
    describe(e);
    status = check_interface(e);
  }
  if (!status)
    status = create_stepper(e, field);
  return status;
}

fg_status fg_evolution_create(fg_evolution **out, fg_context *context,
                              const fg_field *field, const fg_evolution_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "evolution: a NULL argument");
  *out = NULL;
  const fg__ranks *ranks;
  fg_status status = fg__ranks_all(&ranks, context);
  return status ? status : fg__evolution_create(out, context, ranks, field, options);
}

fg_status fg__evolution_create(fg_evolution **out, fg_context *context,
                               const fg__ranks *ranks, const fg_field *field,
                               const fg_evolution_options *options)
{
  *out = NULL;
  fg_status status;
  fg_activity before = fg__traffic_begin(ranks->book, FG_ACTIVITY_SETUP);
  fg_evolution *e = fg__allocate(1, sizeof *e);
  if (e)
    status = begin(e, context, ranks, field, options);
  else
    status = fg__fail_memory(context, "an evolution", sizeof *e);
  status = fg__ranks_agree(ranks, context, status);
  if (e && !status)
    status = build(e, field);
  fg__traffic_return(ranks->book, before);
  if (e) {
    e->options.initial = NULL; /* the caller's, and used up */
    e->options.law = NULL;
  }
  if (status) {
    fg_evolution_destroy(e);
    return status;
  }
  *out = e;
  return FG_STATUS_OK;
}

void fg_evolution_destroy(fg_evolution *evolution)
{
  if (!evolution)
    return;
  fg__stepper_clear(&evolution->stepper);
  fg__team_destroy(evolution->team);
  fg__team_clusters_clear(&evolution->clusters_found);
  fg__spread_clusters_clear(&evolution->spread_clusters);
  fg__mesh_clear(&evolution->mesh);
  free_tensor(evolution);
  free(evolution->tensor.active);
  free(evolution);
}

const fg_mesh_info *fg_evolution_mesh(const fg_evolution *evolution)
{
  return &evolution->info;
}

double fg__evolution_seconds(const fg_evolution *evolution)
{
  const struct timespec *start = &evolution->start;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return evolution->earlier_seconds + (double)(now.tv_sec - start->tv_sec) +
         1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

fg_step fg__evolution_describe(const fg_evolution *evolution, int cycles, int rejected)
{
  const fg_evolution *e = evolution;
  const fg__stepper *s = &e->stepper;
  return (fg_step){.step = s->accepted,
                   .time = s->time,
                   .tau = s->last_tau,
                   .energy = s->energy,
                   .mass = s->mass,
                   .area_fraction = e->area_fraction,
                   .clusters = e->clusters,
                   .cycles = cycles,
                   .rejected = rejected,
                   .cells = e->info.active_cells,
                   .increment = s->increment,
                   .seconds = fg__evolution_seconds(e),
                   .stationary = fg__stepper_stationary(s)};
}

fg_status fg_evolution_step(fg_evolution *evolution, fg_step *step)
{
  fg_evolution *e = evolution;
  long cycles = e->stepper.cycles_spent, rejected = e->stepper.rejected;
  fg_activity before = fg__traffic_begin(e->ranks->book, FG_ACTIVITY_STEPS);
  /* asked once only: a step that has begun ends, so that it is the same when resumed */
  fg_status status = fg__ranks_agree(e->ranks, e->context, fg__check_stop(e->context));
  if (!status)
    status = fg__stepper_advance(&e->stepper, e->context);
  if (!status)
    status = fg__evolution_count(e);
  fg__traffic_return(e->ranks->book, before);
  if (!status)
    *step = fg__evolution_describe(e, (int)(e->stepper.cycles_spent - cycles),
                                   (int)(e->stepper.rejected - rejected));
  return status;
}
