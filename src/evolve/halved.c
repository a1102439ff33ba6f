#include "evolve/halved.h"

#include <stdlib.h>

#include "base/memory.h"
#include "mesh/regions.h"

static const double weight[3] = {0.25, 0.5, 0.25};

/* The mean round a node of a box; the order of the sum is the same wherever it stands. */
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

static fg_status halve_box(float **out, fg_context *context, const fg__level *level,
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

static fg_status halve_boxes(fg__halved *out, fg_context *context,
                             const fg__multigrid *multigrid, const fg__partition *fine,
                             const float *u)
{
  int count;
  const ptrdiff_t *offset;
  const fg__level *level = fg__multigrid_boxes(multigrid, &count, &offset);
  const fg__box *box = fg__own_boxes(fine, &(int){0});
  out->box = fg__allocate((size_t)count, sizeof *out->box);
  if (!out->box)
    return fg__fail_memory(context, "a coarser density",
                           (size_t)count * sizeof *out->box);
  fg_status status = FG_STATUS_OK;
  for (int b = 0; b < count && !status; ++b) {
    const fg__box even = fg__box_halved(&box[b]);
    if (!fg__box_is_empty(&even)) /* as fg__partition_coarsen leaves boxes out */
      status = halve_box(&out->box[out->count++], context, &level[b], &box[b],
                         fine->dimension, u + offset[b]);
  }
  return status;
}

fg_status fg__halved_create(fg__halved *out, fg_context *context,
                            const fg__multigrid *multigrid, const fg__partition *fine,
                            const float *u)
{
  *out = (fg__halved){.count = 0};
  fg_status status = fg__partition_coarsen(&out->partition, context, fine);
  if (!status)
    status = halve_boxes(out, context, multigrid, fine, u);
  status = fg__ranks_agree(fine->ranks, context, status);
  if (status)
    fg__halved_clear(out);
  return status;
}

void fg__halved_clear(fg__halved *halved)
{
  for (int b = 0; b < halved->count; ++b)
    free(halved->box[b]);
  free(halved->box);
  fg__partition_clear(&halved->partition);
  *halved = (fg__halved){.count = 0};
}

/* What fg__halved_deliver tells regions.h. */
typedef struct delivery {
  fg__region *region; /* [to->count] */
  void **out;         /* [to->count] */
  const void **first; /* [own boxes of the source] */
  ptrdiff_t *row, *plane;
} delivery;

static fg_status plan_delivery(delivery *d, fg_context *context, const fg__halved *halved,
                               const fg__partition *to, float *const out[])
{
  size_t regions = (size_t)to->count, boxes = (size_t)halved->count;
  *d = (delivery){.region = fg__allocate(regions, sizeof *d->region),
                  .out = fg__allocate(regions, sizeof *d->out),
                  .first = fg__allocate(boxes, sizeof *d->first),
                  .row = fg__allocate(boxes, sizeof *d->row),
                  .plane = fg__allocate(boxes, sizeof *d->plane)};
  if (!d->region || !d->out || !d->first || !d->row || !d->plane)
    return fg__fail_memory(context, "a coarser density", regions * sizeof *d->region);
  int rank = 0;
  for (int n = 0; n < to->count; ++n) {
    while (n >= to->first_of_rank[rank + 1])
      ++rank;
    d->region[n] = (fg__region){.nodes = to->box[n], .rank = rank};
    if (rank == to->ranks->rank)
      d->out[n] = out[n - to->first_of_rank[rank]];
  }
  const fg__box *own = fg__own_boxes(&halved->partition, &(int){0});
  for (int b = 0; b < halved->count; ++b) {
    d->first[b] = halved->box[b];
    d->row[b] = own[b].nodes[0];
    d->plane[b] = d->row[b] * own[b].nodes[1];
  }
  return FG_STATUS_OK;
}

fg_status fg__halved_deliver(const fg__halved *halved, fg_context *context,
                             const fg__partition *to, float *const out[])
{
  delivery d;
  fg_status status =
      fg__ranks_agree(to->ranks, context, plan_delivery(&d, context, halved, to, out));
  if (!status) {
    const fg__region_source source = {
        .size = sizeof(float), .first = d.first, .row = d.row, .plane = d.plane};
    status = fg__regions_fill(context, &halved->partition, d.region, to->count, &source,
                              d.out);
  }
  free(d.region);
  free(d.out);
  free(d.first);
  free(d.row);
  free(d.plane);
  return status;
}
