#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "density/share.h"
#include "evolution/evolution.h"

/* Nucleation is over, and clusters are counted, once this share of the wanted area is
 * covered; the noise covers it too, but has smoothed away after one growth time of linear
 * theory. */
static const double nucleated = 0.8;

static const unsigned char *mask_of(const fg_evolution *e)
{
  return e->active_cells < (int64_t)e->cells ? e->tensor.active : NULL;
}

static fg_status count_whole(fg_evolution *e, bool counting, double *covered)
{
  fg__team_clusters *c = &e->clusters_found;
  const fg__multigrid *m = &e->stepper.multigrid;
  fg__team *team = m->shared_levels > 0 ? m->team : NULL;
  fg_status status =
      fg__team_clusters_find(c, e->context, team, &m->level[0].layout, e->mesh.periodic,
                             e->stepper.current, mask_of(e), e->debris_area, counting);
  *covered = c->covered;
  e->clusters = c->whole.count;
  return status;
}

static fg_status count_spread(fg_evolution *e, bool counting, double *covered)
{
  fg__spread_clusters *c = &e->spread_clusters;
  const fg__spread *finest = &e->stepper.multigrid.spread[0];
  fg_status status =
      fg__spread_clusters_find(c, e->context, finest, e->stepper.current,
                               finest->residual[0], e->debris_area, counting);
  *covered = c->covered;
  e->clusters = c->whole.count;
  return status;
}

static fg_status count(fg_evolution *e, bool counting)
{
  double covered = 0.0;
  fg_status status = e->spread ? count_spread(e, counting, &covered)
                               : count_whole(e, counting, &covered);
  e->area_fraction = covered / (double)e->active_cells;
  return status;
}

static fg_status watch(fg_evolution *e)
{
  fg_status status = count(e, e->counting);
  if (status || e->counting)
    return status;
  e->clusters = 0;
  bool smoothed = e->stepper.time * fg__evolution_growth_rate(e) >= 1.0;
  bool covered_enough = e->area_fraction >= nucleated * e->options.coverage;
  e->counting = smoothed && covered_enough;
  return e->counting ? count(e, true) : FG_STATUS_OK;
}

fg_status fg__evolution_count(fg_evolution *evolution)
{
  fg__traffic_book *book = evolution->ranks->book;
  fg_activity before = fg__traffic_begin(book, FG_ACTIVITY_COUNTING);
  fg_status status = watch(evolution);
  fg__traffic_return(book, before);
  return status;
}

static fg_density_arrays describe_density(const fg_evolution *e)
{
  fg_density_arrays arrays = {.dimension = e->mesh.dimension,
                              .debris_area = e->debris_area *
                                             fg__evolution_cell_volume(e) *
                                             pow(e->mesh.length, e->mesh.dimension),
                              .time = fg__evolution_unit(e) * e->stepper.time,
                              .energy = e->stepper.energy / fg__evolution_unit(e),
                              .area_fraction = e->area_fraction,
                              .clusters = e->clusters};
  for (int k = 0; k < 3; ++k) {
    arrays.nodes[k] = e->mesh.partition.nodes[k];
    arrays.origin[k] = e->mesh.origin[k];
    arrays.spacing[k] = e->info.spacing[k];
    arrays.periodic[k] = e->mesh.periodic[k];
  }
  return arrays;
}

static fg_status create_shared(fg_density **out, const fg_evolution *e)
{
  const fg__spread *finest = &e->stepper.multigrid.spread[0];
  fg_density_arrays arrays = describe_density(e);
  double cell = 1.0; /* as whoever labels a density whole takes it */
  for (int k = 0; k < arrays.dimension; ++k)
    cell *= arrays.spacing[k];
  fg__density_share *share;
  fg_status status = fg__density_share_create(
      &share, e->context, finest, e->stepper.current, finest->residual[0],
      arrays.debris_area / cell, e->active_cells < (int64_t)e->cells);
  if (status)
    return status;
  status = fg__density_create_shared(out, e->context, &arrays, share);
  if (status)
    fg__density_share_destroy(share);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  if (status) {
    fg_density_destroy(*out);
    *out = NULL;
  }
  return status;
}

static fg_status create_whole(fg_density **out, const fg_evolution *e)
{
  fg_density_arrays arrays = describe_density(e);
  float *plain = fg__allocate(e->nodes, sizeof *plain);
  if (!plain)
    return fg__fail_memory(e->context, "the density", e->nodes * sizeof *plain);
  fg__level_export(&e->stepper.multigrid.level[0], e->stepper.current, plain);
  arrays.u = plain;
  arrays.active = mask_of(e);
  fg_status status = fg_density_create_from_arrays(out, e->context, &arrays);
  free(plain);
  return status;
}

static fg_status create(fg_density **out, const fg_evolution *e)
{
  return e->spread ? create_shared(out, e) : create_whole(out, e);
}

fg_status fg_density_create(fg_density **out, const fg_evolution *evolution)
{
  *out = NULL;
  fg__traffic_book *book = evolution->ranks->book;
  fg_activity before = fg__traffic_begin(book, FG_ACTIVITY_SNAPSHOTS);
  fg_status status = create(out, evolution);
  fg__traffic_return(book, before);
  return status;
}
