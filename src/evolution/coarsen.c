/* A mesh that follows its clusters: when they have grown, half the nodes along each side
 * show them as well. docs/design/adaptive.md has the measurements. */
#include <string.h>

#include "evolution/evolution.h"
#include "evolution/options.h"

/* Cells a cluster, of all the domain's, from which on the mesh is finer than needed: each
 * keeps what clusters have on the meshes that are the default, at the scales at which
 * these are drawn. */
static const double coarsening_cells_2d = 64.0 * 64.0,
                    coarsening_cells_3d = 32.0 * 32.0 * 32.0;

/* Energies of winds and currents took 0 to 10 (docs/design/adaptive.md). */
enum { MOST_RELAXING_STEPS = 20 };

bool fg_evolution_should_coarsen(const fg_evolution *evolution)
{
  const fg_evolution *e = evolution;
  double needed = e->mesh.dimension == 3 ? coarsening_cells_3d : coarsening_cells_2d;
  int least = 2 * (fg__default_nodes(e->mesh.dimension) - 1);
  return e->clusters > 0 && fg__mesh_most_cells(&e->mesh) >= least &&
         (double)e->active_cells >= needed * e->clusters &&
         fg__mesh_can_coarsen(&e->mesh);
}

static fg_status check(const fg_evolution *e)
{
  if (!fg__mesh_can_coarsen(&e->mesh))
    return fg__fail(e->context, FG_STATUS_ARGUMENT,
                    "coarser mesh: %d cells along the longest side can not be halved",
                    fg__mesh_most_cells(&e->mesh));
  return FG_STATUS_OK;
}

/* Leaves one mesh for the next. */
static fg_status change_mesh(fg_evolution *e, const fg__coarsened *coarsened)
{
  double time = e->stepper.time;
  e->coarsened = coarsened;
  e->coarsened_mean = e->stepper.mean;
  e->earlier_steps += e->stepper.accepted;
  e->mesh_nodes = fg__mesh_most_cells(&e->mesh) / 2 + 1;
  ++e->coarsenings;
  fg__evolution_clear(e);
  fg_status status = fg__evolution_build(e);
  e->coarsened = NULL;
  if (e->stepper.masses.count <= 1)
    e->stepper.mean = e->coarsened_mean; /* to the last bit, as a resumed run has it */
  e->stepper.time = 0.5 * time;          /* its unit is twice as long */
  return status;
}

static void remember(fg_evolution *e, double energy_before, const fg_step *step)
{
  e->coarsening = (fg_coarsening){.step = step->step,
                                  .time = step->time,
                                  .energy_before = energy_before,
                                  .energy_after = step->energy,
                                  .clusters = step->clusters};
  memcpy(e->coarsening.cells, e->info.cells, sizeof e->coarsening.cells);
  e->has_coarsening = true;
}

fg_status fg__evolution_coarsen_mesh(fg_evolution *evolution)
{
  fg_evolution *e = evolution;
  fg__coarsened coarsened = {.values = NULL};
  fg_status status = fg__ranks_agree(e->ranks, e->context, check(e));
  if (!status)
    status = fg__coarsened_create(&coarsened, e->context, &e->stepper.multigrid,
                                  &e->mesh.partition, e->stepper.current);
  if (!status)
    status = change_mesh(e, &coarsened);
  fg__coarsened_clear(&coarsened);
  return status;
}

/* Steps until the energy is no larger than before the coarsening, whose part they are: no
 * time passes and none is counted. */
static fg_status relax(fg_evolution *e, double energy_before)
{
  fg__stepper *s = &e->stepper;
  double time = s->time;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < MOST_RELAXING_STEPS && !status; ++n) {
    if (fg__evolution_describe(e, 0, 0).energy <= energy_before)
      break;
    status = fg__stepper_advance(s, e->context);
  }
  s->time = time;
  s->accepted = s->quiet_steps = 0;
  return status;
}

fg_status fg_evolution_coarsen(fg_evolution *evolution, fg_step *step)
{
  fg_evolution *e = evolution;
  double energy = fg__evolution_describe(e, 0, 0).energy;
  fg_phase before = fg__phase_begin(e->ranks->counters, FG_PHASE_SETUP);
  fg_status status = fg__evolution_coarsen_mesh(e);
  if (!status)
    status = relax(e, energy);
  if (!status)
    status = fg__evolution_count(e);
  fg__phase_return(e->ranks->counters, before);
  if (!status) {
    *step = fg__evolution_describe(e, 0, 0);
    remember(e, energy, step);
  }
  return status;
}

const fg_coarsening *fg_evolution_coarsening(const fg_evolution *evolution)
{
  return evolution->has_coarsening ? &evolution->coarsening : NULL;
}

bool fg__evolution_adapts(const fg_evolution *evolution)
{
  const fg_evolution_options *o = &evolution->options;
  return o->mesh == FG_MESH_ADAPTIVE || (o->mesh == FG_MESH_AUTO && o->gamma == 0.0);
}
