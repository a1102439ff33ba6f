#include "evolution/coarsened.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "grid/exchange/regions.h"
#include "solver/passes.h"

static const double weight[3] = {0.25, 0.5, 0.25};

/* The mean round a node of a block, by the nodes' masses; NaN where there is no mass. The
 * order of the sums is the same wherever the node stands. */
static float mean_round(const fg__level *level, int dimension, const float *u, int i,
                        int j, int k)
{
  double sum = 0.0, mass = 0.0;
  for (int z = dimension == 3 ? -1 : 0; z <= (dimension == 3 ? 1 : 0); ++z) {
    double along_z = dimension == 3 ? weight[z + 1] : 1.0;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        ptrdiff_t at = fg__node_at(&level->layout, i + x, j + y, k + z);
        double part = along_z * weight[y + 1] * weight[x + 1];
        if (level->mass)
          part *= (double)level->mass[at];
        mass += part;
        sum += part * (double)u[at];
      }
  }
  return (float)(level->mass ? sum / mass : sum);
}

static fg_status coarsen_block(float **out, fg_context *context, const fg__level *level,
                               const fg__box *fine, int dimension, const float *u)
{
  const fg__box even = fg__box_halved(fine);
  size_t count = (size_t)fg__box_count(&even);
  float *to = *out = fg__allocate(count, sizeof *to);
  if (!to)
    return fg__fail_memory(context, "a coarser density", count * sizeof *to);
  for (int k = 0; k < even.nodes[2]; ++k)
    for (int j = 0; j < even.nodes[1]; ++j)
      for (int i = 0; i < even.nodes[0]; ++i)
        *to++ = mean_round(level, dimension, u, 2 * (even.first[0] + i) - fine->first[0],
                           2 * (even.first[1] + j) - fine->first[1],
                           2 * (even.first[2] + k) - fine->first[2]);
  return FG_STATUS_OK;
}

fg_status fg__coarsened_create(fg__coarsened *out, fg_context *context,
                               const fg__multigrid *multigrid, const fg__partition *fine,
                               const float *u)
{
  *out = (fg__coarsened){.values = NULL};
  fg_status status = fg__partition_coarsen(&out->partition, context, fine);
  if (!status)
    status = coarsen_block(&out->values, context, fg__multigrid_finest(multigrid),
                           fg__own_block(fine), fine->dimension, u);
  status = fg__ranks_agree(fine->ranks, context, status);
  if (status)
    fg__coarsened_clear(out);
  return status;
}

void fg__coarsened_clear(fg__coarsened *coarsened)
{
  free(coarsened->values);
  fg__partition_clear(&coarsened->partition);
  *coarsened = (fg__coarsened){.values = NULL};
}

fg_status fg__coarsened_deliver(const fg__coarsened *coarsened, fg_context *context,
                                const fg__partition *to, float *out)
{
  const fg__ranks *ranks = to->ranks;
  size_t count = (size_t)ranks->count;
  fg__region *region = fg__allocate(count, sizeof *region);
  void **array = fg__allocate(count, sizeof *array);
  fg_status status = FG_STATUS_OK;
  if (!region || !array)
    status = fg__fail_memory(context, "a coarser density", count * sizeof *region);
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    const int *own = fg__own_block(&coarsened->partition)->nodes;
    const fg__region_source source = {.size = sizeof(float),
                                      .first = coarsened->values,
                                      .row = own[0],
                                      .plane = (ptrdiff_t)own[0] * own[1]};
    for (int rank = 0; rank < ranks->count; ++rank)
      region[rank] = (fg__region){.nodes = to->block[rank], .rank = rank};
    array[ranks->rank] = out;
    status = fg__regions_fill(context, &coarsened->partition, region, ranks->count,
                              &source, array);
  }
  free(region);
  free(array);
  return status;
}

/* The mean of the neighbours that have a value; NaN: none has. */
static float mean_of_neighbours(const fg__level *level, const float *u, int i, int j,
                                int k)
{
  double sum = 0.0;
  int count = 0, deep = level->layout.dimension == 3;
  for (int z = -deep; z <= deep; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        float value = u[fg__node_at(&level->layout, i + x, j + y, k + z)];
        if (isnan(value))
          continue;
        sum += (double)value;
        ++count;
      }
  return count > 0 ? (float)(sum / count) : NAN;
}

/* Takes u to `to` with values for the nodes next to those that have one; nodes without
 * mass have none. Returns the number of nodes with mass that still lack a value. */
static uint64_t spread(const fg__level *level, const float *u, float *to)
{
  const int *nodes = level->layout.nodes;
  uint64_t without = 0;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i) {
        ptrdiff_t at = fg__node_at(&level->layout, i, j, k);
        float value = u[at];
        if (!(level->mass[at] > 0.0F))
          value = NAN;
        else if (isnan(value))
          value = mean_of_neighbours(level, u, i, j, k);
        without += level->mass[at] > 0.0F && isnan(value);
        to[at] = value;
      }
  return without;
}

void fg__coarsened_fill_holes(const fg__multigrid *multigrid, double mean)
{
  const fg__level *level = fg__multigrid_finest(multigrid);
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  float *u = fg__multigrid_u(multigrid), *w = fg__multigrid_w(multigrid);
  if (!level->mass)
    return;
  for (uint64_t last = UINT64_MAX, without = last - 1; without > 0 && without < last;) {
    last = without;
    spread(level, u, w); /* takes away what nodes without mass have */
    fg__pass_fill_ghosts(multigrid, w);
    without = spread(level, w, u);
    fg__ranks_add(multigrid->ranks, &without, 1);
    fg__pass_fill_ghosts(multigrid, u);
  }
  for (size_t n = 0; n < shape.size; ++n)
    if (isnan((u - shape.first)[n]))
      (u - shape.first)[n] = (level->mass - shape.first)[n] > 0.0F ? (float)mean : 0.0F;
}
