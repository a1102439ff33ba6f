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

bool fg_evolution_should_coarsen(const fg_evolution *evolution)
{
  const fg_evolution *e = evolution;
  double needed = e->mesh.dimension == 3 ? coarsening_cells_3d : coarsening_cells_2d;
  bool masked = e->active_cells < (int64_t)e->cells;
  int least = 2 * (fg__default_nodes(e->mesh.dimension) - 1);
  return e->clusters > 0 && !masked && fg__mesh_most_cells(&e->mesh) >= least &&
         (double)e->active_cells >= needed * e->clusters &&
         fg__mesh_can_coarsen(&e->mesh);
}

static fg_status check(const fg_evolution *e)
{
  if (e->active_cells < (int64_t)e->cells)
    return fg__fail(e->context, FG_STATUS_ARGUMENT,
                    "coarser mesh: the field is missing in places, which a coarser mesh "
                    "would not show as they are");
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
  e->stepper.mean =
      e->coarsened_mean;        /* to the last bit, as a resumed run will have it */
  e->stepper.time = 0.5 * time; /* its unit is twice as long */
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

fg_status fg_evolution_coarsen(fg_evolution *evolution, fg_step *step)
{
  fg_evolution *e = evolution;
  double energy = fg__evolution_describe(e, 0, 0).energy;
  fg_phase before = fg__phase_begin(e->ranks->counters, FG_PHASE_SETUP);
  fg__coarsened coarsened = {.values = NULL};
  fg_status status = fg__ranks_agree(e->ranks, e->context, check(e));
  if (!status)
    status = fg__coarsened_create(&coarsened, e->context, &e->stepper.multigrid,
                                  &e->mesh.partition, e->stepper.current);
  if (!status)
    status = change_mesh(e, &coarsened);
  if (!status)
    status = fg__evolution_count(e);
  fg__coarsened_clear(&coarsened);
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
