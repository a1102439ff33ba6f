#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "evolve/evolution.h"

/* Nucleation is over, and clusters are counted, once this share of the wanted area is
 * covered; the noise covers it too, but has smoothed away after one growth time of linear
 * theory. */
static const double nucleated = 0.8;

static const unsigned char *mask_of(const fg_evolution *e)
{
  return e->active_cells < (long)e->cells ? e->tensor.active : NULL;
}

static int nodes_along(const fg_evolution *e, int axis)
{
  return e->mesh.level[0].nodes[axis];
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

/* An array of all ranks' boxes as a plain one on every rank. */
static fg_status gather_whole(const fg_evolution *e, float *array, float *plain)
{
  const fg__spread *finest = &e->stepper.multigrid.spread[0];
  fg__layout layout = fg__layout_of(e->mesh.dimension, finest->partition.nodes);
  float *whole = fg__allocate(layout.array_size, sizeof *whole);
  fg_status status = FG_STATUS_OK;
  if (!whole || !plain)
    status = fg__fail_memory(e->context, "the density", e->nodes * sizeof *whole);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  fg__gather *gather = NULL;
  if (!status)
    status = fg__gather_create(&gather, e->context, &finest->partition, 1);
  if (!status) {
    float *const *boxes[1];
    float *const to = whole + layout.first;
    fg__spread_pointers(finest, 1, &array, boxes);
    fg__gather_fill(gather, 1, boxes, &to);
    for (int k = 0; k < layout.nodes[2]; ++k)
      for (int j = 0; j < layout.nodes[1]; ++j)
        for (int i = 0; i < layout.nodes[0]; ++i)
          *plain++ = to[fg__node_at(&layout, i, j, k)];
  }
  fg__gather_destroy(gather);
  free(whole);
  return status;
}

/* Whether cells are active, as nodal values of their lowest corners. */
static void mark_cells(const fg__spread *spread, float *out)
{
  for (int b = 0; b < spread->count; ++b) {
    const fg__level *box = &spread->box[b];
    const int *nodes = box->layout.nodes;
    for (int k = 0; k < nodes[2]; ++k)
      for (int j = 0; j < nodes[1]; ++j)
        for (int i = 0; i < nodes[0]; ++i)
          out[spread->offset[b] + fg__node_at(&box->layout, i, j, k)] =
              box->tensor.weight[fg__cell_at(&box->tensor, i, j, k)];
  }
}

fg_status fg__evolution_gather_mask(fg_evolution *evolution)
{
  fg_evolution *e = evolution;
  if (!e->spread || e->active_cells == (long)e->cells)
    return FG_STATUS_OK;
  const fg__spread *finest = &e->stepper.multigrid.spread[0];
  float *plain = fg__allocate(e->nodes, sizeof *plain), *marks = finest->residual[0];
  bool first = e->mesh.ranks->rank == 0;
  if (first)
    e->tensor.active = fg__allocate(e->cells, 1);
  fg_status status = FG_STATUS_OK;
  if (first && !e->tensor.active)
    status = fg__fail_memory(e->context, "the mask", e->cells);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  mark_cells(finest, marks);
  if (!status)
    status = gather_whole(e, marks, plain);
  if (!status && first) {
    unsigned char *active = e->tensor.active;
    const int *cells = e->mesh.cells, *nodes = e->mesh.level[0].nodes;
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j) {
        const float *row = plain + ((ptrdiff_t)k * nodes[1] + j) * nodes[0];
        for (int i = 0; i < cells[0]; ++i)
          *active++ = row[i] > 0.0F;
      }
  }
  free(plain);
  return status;
}

static fg_status create_density(fg_density **out, const fg_evolution *e, const float *u)
{
  fg_density_arrays arrays = {.dimension = e->mesh.dimension,
                              .u = u,
                              .active = mask_of(e),
                              .debris_area = e->debris_area *
                                             fg__evolution_cell_volume(e) *
                                             pow(e->mesh.length, e->mesh.dimension),
                              .time = e->stepper.time,
                              .energy = e->stepper.energy,
                              .area_fraction = e->area_fraction,
                              .clusters = e->clusters};
  for (int k = 0; k < 3; ++k) {
    arrays.nodes[k] = nodes_along(e, k);
    arrays.origin[k] = e->mesh.origin[k];
    arrays.spacing[k] = e->info.spacing[k];
    arrays.periodic[k] = e->mesh.periodic[k];
  }
  return fg_density_create_from_arrays(out, e->context, &arrays);
}

fg_status fg_density_create(fg_density **out, const fg_evolution *evolution)
{
  const fg_evolution *e = evolution;
  *out = NULL;
  fg_activity before = fg__traffic_begin(e->ranks->book, FG_ACTIVITY_SNAPSHOTS);
  float *plain = fg__allocate(e->nodes, sizeof *plain);
  fg_status status = FG_STATUS_OK;
  if (e->spread) {
    status = gather_whole(e, e->stepper.current, plain);
  } else if (plain) {
    fg__level_export(&e->stepper.multigrid.level[0], e->stepper.current, plain);
  } else {
    status = fg__fail_memory(e->context, "the density", e->nodes * sizeof *plain);
  }
  if (!status && e->mesh.ranks->rank == 0)
    status = create_density(out, e, plain);
  free(plain);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  fg__traffic_return(e->ranks->book, before);
  return status;
}
