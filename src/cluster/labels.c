/* Bounds without the whole grid. Those inside the grid are greatest and least indices.
 * What lies on both sides of a periodic boundary is followed across it: where some column
 * holds nothing of the cluster, the columns that do are one arc of the circle. Where all
 * do, one rank takes the rows concerned and floods the cluster as if it had the whole. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cluster/patches.h"
#include "cluster/unwrap.h"

typedef struct finding {
  fg__labels *labels;
  const fg_density *density;
  const fg_density_arrays *grid;
  const fg__density_block *block;
  const fg__ranks *ranks;
  double (*edge)[6];   /* [count] -x0, x1, -y0, y1, -z0, z1 */
  size_t (*column)[3]; /* [count] where its numbers of nodes a column (row) begin in
                          `filled`, counted from 1; 0: not on both sides */
  uint64_t *filled;
  size_t filled_count;
  bool (*full)[3]; /* [count] every column (row, plane) has nodes of the cluster */
} finding;

typedef void node_action(finding *f, int cluster, const int node[3]);

/* Acts on every own node of a cluster, from 0. */
static void for_own_nodes(finding *f, node_action *act)
{
  const fg__box *own = fg__own_block(&f->block->partition);
  const int *label = f->block->label;
  for (int z = 0; z < own->nodes[2]; ++z)
    for (int y = 0; y < own->nodes[1]; ++y)
      for (int x = 0; x < own->nodes[0]; ++x, ++label) {
        int cluster = *label - 1;
        const int node[3] = {own->first[0] + x, own->first[1] + y, own->first[2] + z};
        if (cluster >= 0)
          act(f, cluster, node);
      }
}

static void widen(finding *f, int cluster, const int node[3])
{
  double *edge = f->edge[cluster];
  for (int k = 0; k < 3; ++k) {
    edge[2 * k] = edge[2 * k] > -node[k] ? edge[2 * k] : -node[k];
    edge[2 * k + 1] = edge[2 * k + 1] > node[k] ? edge[2 * k + 1] : node[k];
  }
}

static void count_node(finding *f, int cluster, const int node[3])
{
  for (int k = 0; k < 3; ++k)
    if (f->column[cluster][k])
      ++f->filled[f->column[cluster][k] - 1 + (size_t)node[k]];
}

static void find_bounds(finding *f)
{
  int count = f->labels->count;
  for (int n = 0; n < count; ++n)
    for (int k = 0; k < 6; ++k)
      f->edge[n][k] = -1e300;
  for_own_nodes(f, widen);
  fg__ranks_greatest(f->ranks, f->edge[0], 6 * count);
  for (int n = 0; n < count; ++n)
    for (int k = 0; k < 3; ++k) {
      int *bounds = f->labels->bounds[n];
      bounds[2 * k] = (int)-f->edge[n][2 * k];
      bounds[2 * k + 1] = (int)f->edge[n][2 * k + 1];
      bool both = f->grid->periodic[k] && bounds[2 * k] == 0 &&
                  bounds[2 * k + 1] == f->grid->nodes[k] - 1;
      f->column[n][k] = both ? f->filled_count + 1 : 0;
      f->filled_count += both ? (size_t)f->grid->nodes[k] : 0;
    }
}

/* False: there is no gap. */
static bool find_arc(int bounds[2], const uint64_t *filled, int nodes)
{
  int first = -1, count = 0;
  for (int n = 0; n < nodes; ++n) {
    count += filled[n] > 0;
    if (!filled[n] && filled[(n + 1) % nodes])
      first = (n + 1) % nodes;
  }
  if (first < 0)
    return false;
  bounds[0] = first;
  bounds[1] = first + count - 1;
  return true;
}

static fg_status follow_arcs(finding *f, fg_context *context, int *full_count)
{
  *full_count = 0;
  if (f->filled_count == 0)
    return FG_STATUS_OK;
  f->filled = fg__allocate(f->filled_count, sizeof *f->filled);
  fg_status status = FG_STATUS_OK;
  if (!f->filled)
    status = fg__fail_memory(context, "clusters across a periodic boundary",
                             f->filled_count * sizeof *f->filled);
  status = fg__ranks_agree(f->ranks, context, status);
  if (status)
    return status;
  for_own_nodes(f, count_node);
  fg__ranks_add(f->ranks, f->filled, (int)f->filled_count);
  for (int n = 0; n < f->labels->count; ++n) {
    for (int k = 0; k < 3; ++k)
      f->full[n][k] = f->column[n][k] &&
                      !find_arc(&f->labels->bounds[n][2 * k],
                                f->filled + (f->column[n][k] - 1), f->grid->nodes[k]);
    *full_count += f->full[n][0] || f->full[n][1] || f->full[n][2];
  }
  return FG_STATUS_OK;
}

/* Bounds and closed axes of one cluster from a patch that has all of it. */
static fg_status flood(const finding *f, fg_context *context, const fg__patch *patch,
                       int cluster, int bounds[6], bool closed[3])
{
  fg__component_grid grid = {.u = patch->u, .active = patch->active};
  for (int k = 0; k < 3; ++k) {
    grid.nodes[k] = patch->nodes[k];
    grid.periodic[k] = f->grid->periodic[k] && patch->nodes[k] == f->grid->nodes[k];
  }
  fg__unwrap unwrap;
  fg_status status = fg__unwrap_create(&unwrap, context, &grid, patch->label);
  if (status)
    return status;
  int first = 0;
  while (patch->label[first] != cluster)
    ++first;
  fg__unwrap_bounds(&unwrap, first, bounds, closed);
  fg__unwrap_clear(&unwrap);
  for (int k = 0; k < 3; ++k) {
    int period = f->grid->periodic[k] ? f->grid->nodes[k] : 0;
    int shift = patch->first[k];
    while (period && bounds[2 * k] + shift < 0)
      shift += period;
    while (period && bounds[2 * k] + shift >= period)
      shift -= period;
    bounds[2 * k] += shift;
    bounds[2 * k + 1] += shift;
  }
  return FG_STATUS_OK;
}

enum { NUMBERS = 9 }; /* told of a flooded cluster: bounds, closed */

static void tell(uint64_t *number, const int bounds[6], const bool closed[3])
{
  for (int k = 0; k < NUMBERS; ++k)
    number[k] = (uint64_t)(k < 6 ? bounds[k] : closed[k - 6]);
}

static void hear(fg__labels *labels, int n, const uint64_t *number)
{
  for (int k = 0; k < 6; ++k)
    labels->bounds[n][k] = (int)number[k];
  for (int k = 0; k < 3; ++k)
    labels->closed[n][k] = number[6 + k] != 0;
}

/* The clusters without a gap, shared out over the ranks. */
static fg_status flood_full_ones(finding *f, fg_context *context, int count)
{
  fg__wanted_patch *wanted = fg__allocate((size_t)count, sizeof *wanted);
  int *cluster = fg__allocate((size_t)count, sizeof *cluster);
  uint64_t *number = fg__allocate((size_t)count * NUMBERS, sizeof *number);
  fg_status status = FG_STATUS_OK;
  if (!wanted || !cluster || !number)
    status = fg__fail_memory(context, "clusters across a periodic boundary",
                             (size_t)count * sizeof *wanted);
  status = fg__ranks_agree(f->ranks, context, status);
  if (status)
    goto cleanup;
  for (int n = 0, at = 0; n < f->labels->count; ++n)
    if (f->full[n][0] || f->full[n][1] || f->full[n][2]) {
      fg__patch_place(&wanted[at].patch, f->grid, f->labels->bounds[n], f->full[n]);
      wanted[at].rank = at % f->ranks->count;
      cluster[at++] = n;
    }
  status = fg__patches_fill(context, f->density, wanted, count);
  if (status)
    goto cleanup;
  for (int n = 0; n < count; ++n) {
    int bounds[6];
    bool closed[3];
    if (wanted[n].rank != f->ranks->rank)
      continue;
    if (!status)
      status = flood(f, context, &wanted[n].patch, cluster[n] + 1, bounds, closed);
    if (!status)
      tell(number + (size_t)n * NUMBERS, bounds, closed);
    fg__patch_clear(&wanted[n].patch);
  }
  status = fg__ranks_agree(f->ranks, context, status);
  if (status)
    goto cleanup;
  fg__ranks_add(f->ranks, number, count * NUMBERS); /* others told nothing */
  for (int n = 0; n < count; ++n)
    hear(f->labels, cluster[n], number + (size_t)n * NUMBERS);
cleanup:
  free(wanted);
  free(cluster);
  free(number);
  return status;
}

static fg_status allocate(finding *f, fg_context *context)
{
  size_t count = (size_t)f->labels->count;
  fg__labels *labels = f->labels;
  labels->area = fg__allocate(count, sizeof *labels->area);
  labels->bounds = fg__allocate(count, sizeof *labels->bounds);
  labels->closed = fg__allocate(count, sizeof *labels->closed);
  f->edge = fg__allocate(count, sizeof *f->edge);
  f->column = fg__allocate(count, sizeof *f->column);
  f->full = fg__allocate(count, sizeof *f->full);
  fg_status status = FG_STATUS_OK;
  if (!labels->area || !labels->bounds || !labels->closed || !f->edge || !f->column ||
      !f->full)
    status = fg__fail_memory(context, "a list of clusters", count * sizeof *f->edge);
  return fg__ranks_agree(f->ranks, context, status);
}

fg_status fg__labels_create(fg__labels *out, fg_context *context,
                            const fg_density *density)
{
  const fg__density_block *block = fg__density_block_of(density);
  const fg_density_arrays *grid = fg_density_contents(density);
  *out =
      (fg__labels){.label = block->label, .count = block->count, .debris = block->debris};
  finding f = {.labels = out,
               .density = density,
               .grid = grid,
               .block = block,
               .ranks = block->partition.ranks};
  int full_count = 0;
  fg_status status = allocate(&f, context);
  if (!status && out->count > 0) {
    double cell_area = grid->spacing[0] * grid->spacing[1];
    if (grid->dimension == 3)
      cell_area *= grid->spacing[2];
    for (int n = 0; n < out->count; ++n)
      out->area[n] = block->area[n] * cell_area;
    find_bounds(&f);
    status = follow_arcs(&f, context, &full_count);
  }
  if (!status && full_count > 0)
    status = flood_full_ones(&f, context, full_count);
  free(f.edge);
  free(f.column);
  free(f.full);
  free(f.filled);
  if (status)
    fg__labels_clear(out);
  return status;
}

void fg__labels_clear(fg__labels *labels)
{
  free(labels->area);
  free(labels->bounds);
  free(labels->closed);
  *labels = (fg__labels){0};
}
