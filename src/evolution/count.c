#include <math.h>
#include <string.h>

#include "density/density.h"
#include "evolution/evolution.h"

/* Nucleation is over, and clusters are counted, once this share of the wanted area is
 * covered; the noise covers it too, but has smoothed away after one growth time of linear
 * theory. */
static const double nucleated = 0.8;

static fg__cluster_grid grid_of(const fg_evolution *e)
{
  const fg__multigrid *m = &e->stepper.multigrid;
  return (fg__cluster_grid){.partition = &e->mesh.partition,
                            .layout = &fg__multigrid_finest(m)->layout,
                            .active = e->mask.active,
                            .cell_row = e->mask.row,
                            .cell_plane = e->mask.plane,
                            .threads = m->threaded_levels > 0 ? m->threads : NULL};
}

static fg_status count(fg_evolution *e, bool counting)
{
  const fg__cluster_grid grid = grid_of(e);
  const fg__cluster_request request = {counting, e->debris_area, e->debris_area};
  fg_status status = fg__clusters_find(e->clusters_found, e->context, &grid,
                                       e->stepper.current, &request);
  e->area_fraction = e->clusters_found->covered / (double)e->active_cells;
  e->clusters = e->clusters_found->found.count;
  return status;
}

static fg_status count_clusters(fg_evolution *e)
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
  fg__counters *counters = evolution->ranks->counters;
  fg_phase before = fg__phase_begin(counters, FG_PHASE_COUNTING);
  fg_status status = count_clusters(evolution);
  fg__phase_return(counters, before);
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

/* The block's own cells, which the mask has one more of on each side. */
static void copy_mask(fg__density_block *out, const fg_evolution *e)
{
  unsigned char *to = out->active;
  fg__box own = fg__block_cells(&out->partition, fg__own_block(&out->partition));
  size_t width = (size_t)own.nodes[0];
  for (int k = 0; k < own.nodes[2]; ++k)
    for (int j = 0; j < own.nodes[1]; ++j, to += width)
      memcpy(to, e->mask.active + j * e->mask.row + k * e->mask.plane, width);
}

static fg_status find_clusters(fg__density_block *out, const fg_evolution *e,
                               double debris_cells)
{
  const fg__cluster_grid grid = grid_of(e);
  const fg__cluster_request request = {.counting = true, .debris_area = debris_cells};
  fg__components *found = &e->clusters_found->found;
  fg_status status = fg__clusters_find(e->clusters_found, e->context, &grid,
                                       e->stepper.current, &request);
  if (status)
    return status;
  fg__clusters_label(e->clusters_found, out->label);
  out->count = found->count;
  out->debris = found->debris;
  out->area = found->area; /* and another list is made for the next count */
  found->area = NULL;
  found->area_capacity = 0;
  return FG_STATUS_OK;
}

static fg_status create(fg_density **out, const fg_evolution *e)
{
  const fg__multigrid *m = &e->stepper.multigrid;
  fg_density_arrays arrays = describe_density(e);
  double cell = 1.0;
  for (int k = 0; k < arrays.dimension; ++k)
    cell *= arrays.spacing[k];
  fg__density_block block;
  fg_status status = fg__density_block_create(&block, e->context, &e->mesh.partition,
                                              e->active_cells < (int64_t)e->cells);
  status = fg__ranks_agree(e->ranks, e->context, status);
  if (!status) {
    fg__level_export(fg__multigrid_finest(m), e->stepper.current, block.u);
    if (block.masked)
      copy_mask(&block, e);
    status = find_clusters(&block, e, arrays.debris_area / cell);
  }
  if (!status)
    status = fg__ranks_agree(e->ranks, e->context,
                             fg__density_create(out, e->context, &arrays, &block));
  fg__density_block_clear(&block);
  if (status) {
    fg_density_destroy(*out);
    *out = NULL;
  }
  return status;
}

fg_status fg_density_create(fg_density **out, const fg_evolution *evolution)
{
  *out = NULL;
  fg__counters *counters = evolution->ranks->counters;
  fg_phase before = fg__phase_begin(counters, FG_PHASE_SNAPSHOTS);
  fg_status status = create(out, evolution);
  fg__phase_return(counters, before);
  return status;
}
