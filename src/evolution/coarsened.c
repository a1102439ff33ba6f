#include "evolution/coarsened.h"

#include <stdlib.h>

#include "base/memory.h"
#include "grid/exchange/regions.h"

static const double weight[3] = {0.25, 0.5, 0.25};

/* The mean round a node of a block; the order of the sum is the same wherever it stands.
 */
static float mean_round(const fg__layout *layout, int dimension, const float *u, int i,
                        int j, int k)
{
  double sum = 0.0;
  for (int z = dimension == 3 ? -1 : 0; z <= (dimension == 3 ? 1 : 0); ++z) {
    double along_z = dimension == 3 ? weight[z + 1] : 1.0;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        sum += along_z * weight[y + 1] * weight[x + 1] *
               (double)u[fg__node_at(layout, i + x, j + y, k + z)];
  }
  return (float)sum;
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
        *to++ = mean_round(&level->layout, dimension, u,
                           2 * (even.first[0] + i) - fine->first[0],
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
