#include "density/share.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

struct fg_density {
  fg_density_arrays arrays;
  float *u;
  unsigned char *active;
  fg__density_share *share; /* NULL: all of it is here */
};

static size_t cell_count(const fg_density_arrays *arrays)
{
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    count *= (size_t)(arrays->periodic[k] ? arrays->nodes[k] : arrays->nodes[k] - 1);
  return count;
}

static size_t node_count(const fg_density_arrays *arrays)
{
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    count *= (size_t)arrays->nodes[k];
  return count;
}

static fg_status check(fg_context *context, const fg_density_arrays *arrays)
{
  if (arrays->dimension != 2 && arrays->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: dimension %d, not 2 or 3",
                    arrays->dimension);
  if (!arrays->u)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: no values");
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k) {
    if (arrays->nodes[k] < 2)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "density: %d nodes along axis %d, at least 2 are needed",
                      arrays->nodes[k], k);
    if (!(arrays->spacing[k] > 0.0) || !isfinite(arrays->spacing[k]) ||
        !isfinite(arrays->origin[k]))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "density: spacing %g and origin %g along axis %d",
                      arrays->spacing[k], arrays->origin[k], k);
    if ((size_t)arrays->nodes[k] > SIZE_MAX / 16 / count)
      return fg__fail(context, FG_STATUS_ARGUMENT, "density: the grid is too large");
    count *= (size_t)arrays->nodes[k];
  }
  return FG_STATUS_OK;
}

static void describe(fg_density *density, const fg_density_arrays *arrays)
{
  density->arrays = *arrays;
  for (int k = arrays->dimension; k < 3; ++k) {
    density->arrays.nodes[k] = 1;
    density->arrays.origin[k] = density->arrays.spacing[k] = 0.0;
    density->arrays.periodic[k] = false;
  }
}

fg_status fg_density_create_from_arrays(fg_density **out, fg_context *context,
                                        const fg_density_arrays *arrays)
{
  if (!out || !arrays)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: a NULL argument");
  *out = NULL;
  fg_status status = check(context, arrays);
  if (status)
    return status;
  size_t nodes = node_count(arrays);
  size_t cells = cell_count(arrays);
  fg_density *density = fg__allocate(1, sizeof *density);
  if (!density)
    return fg__fail_memory(context, "a density", sizeof *density);
  describe(density, arrays);
  density->u = fg__allocate(nodes, sizeof *density->u);
  density->active = arrays->active ? fg__allocate(cells, 1) : NULL;
  if (!density->u || (arrays->active && !density->active)) {
    fg_density_destroy(density);
    return fg__fail_memory(context, "a density", nodes * sizeof(float) + cells);
  }
  memcpy(density->u, arrays->u, nodes * sizeof *density->u);
  if (arrays->active)
    memcpy(density->active, arrays->active, cells);
  density->arrays.u = density->u;
  density->arrays.active = density->active;
  *out = density;
  return FG_STATUS_OK;
}

void fg_density_destroy(fg_density *density)
{
  if (!density)
    return;
  free(density->u);
  free(density->active);
  fg__density_share_destroy(density->share);
  free(density);
}

fg_status fg__density_create_shared(fg_density **out, fg_context *context,
                                    const fg_density_arrays *arrays,
                                    fg__density_share *share)
{
  fg_density *density = *out = fg__allocate(1, sizeof *density);
  if (!density)
    return fg__fail_memory(context, "a density", sizeof *density);
  describe(density, arrays);
  density->arrays.u = NULL;
  density->arrays.active = NULL;
  density->share = share;
  return FG_STATUS_OK;
}

fg__density_share *fg__density_share_of(const fg_density *density)
{
  return density->share;
}

bool fg_density_is_shared(const fg_density *density)
{
  return density->share != NULL;
}

/* The whole grid as one region for rank 0. */
static fg_status gather(fg__density_share *share, fg_context *context, float *u,
                        unsigned char *active)
{
  fg__region nodes = {.nodes = {{0, 0, 0}, {1, 1, 1}}}, cells = nodes;
  for (int k = 0; k < share->partition.dimension; ++k) {
    nodes.nodes.nodes[k] = share->partition.nodes[k];
    cells.nodes.nodes[k] = share->partition.cells[k];
  }
  void *values[] = {u}, *flags[] = {active};
  fg__traffic_book *book = share->partition.ranks->book;
  fg_activity before = fg__traffic_continue(book, FG_ACTIVITY_SNAPSHOTS);
  fg_status status =
      fg__density_share_fill(share, context, FG__SHARE_U, &nodes, 1, values);
  if (!status && share->masked)
    status = fg__density_share_fill(share, context, FG__SHARE_ACTIVE, &cells, 1, flags);
  fg__traffic_return(book, before);
  return status;
}

fg_status fg_density_gather(fg_density **out, fg_context *context,
                            const fg_density *density)
{
  if (!out || !density || !density->share)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: %s",
                    out && density ? "all of it is here" : "a NULL argument");
  *out = NULL;
  fg__density_share *share = density->share;
  const fg__ranks *ranks = share->partition.ranks;
  fg_density *whole = NULL;
  fg_status status = FG_STATUS_OK;
  if (ranks->rank == 0) {
    size_t nodes = node_count(&density->arrays), cells = cell_count(&density->arrays);
    whole = fg__allocate(1, sizeof *whole);
    if (whole) {
      whole->arrays = density->arrays;
      whole->u = fg__allocate(nodes, sizeof *whole->u);
      whole->active = share->masked ? fg__allocate(cells, 1) : NULL;
      whole->arrays.u = whole->u;
      whole->arrays.active = whole->active;
    }
    if (!whole || !whole->u || (share->masked && !whole->active))
      status = fg__fail_memory(context, "a density", nodes * sizeof(float) + cells);
  }
  status = fg__ranks_agree(ranks, context, status);
  if (!status)
    status =
        gather(share, context, whole ? whole->u : NULL, whole ? whole->active : NULL);
  if (status) {
    fg_density_destroy(whole);
    return status;
  }
  *out = whole;
  return FG_STATUS_OK;
}

const fg_density_arrays *fg_density_contents(const fg_density *density)
{
  return &density->arrays;
}
