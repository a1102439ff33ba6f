#include "mesh/gather.h"

#include <stdlib.h>

#include "base/memory.h"
#include "mesh/brick.h"
#include "mesh/communicator.h"

struct fg__gather {
  const fg__ranks *ranks;
  int box_count;
  fg__brick *own, *place, *ring; /* [box_count] of all ranks: in the box's arrays, in the
                                    whole's, and there with the ghosts */
  fg__layout *layout;            /* [box_count] */
  fg__layout whole;
  int first, end; /* this rank's boxes */
  int *rank_of;   /* [box_count] */
  int *nodes;     /* [ranks] */
  int *count, *offset;
  float *sent, *received;
};

static bool make_plan(fg__gather *g, const fg__partition *partition, int most_arrays)
{
  size_t boxes = (size_t)partition->count, ranks = (size_t)partition->ranks->count;
  g->own = fg__allocate(boxes, sizeof *g->own);
  g->place = fg__allocate(boxes, sizeof *g->place);
  g->ring = fg__allocate(boxes, sizeof *g->ring);
  g->layout = fg__allocate(boxes, sizeof *g->layout);
  g->rank_of = fg__allocate(boxes, sizeof *g->rank_of);
  g->nodes = fg__allocate(ranks, sizeof *g->nodes);
  g->count = fg__allocate(ranks, sizeof *g->count);
  g->offset = fg__allocate(ranks, sizeof *g->offset);
  if (!g->own || !g->place || !g->ring || !g->layout || !g->rank_of || !g->nodes ||
      !g->count || !g->offset)
    return false;
  g->whole = fg__layout_of(partition->dimension, partition->nodes);
  size_t all = 0;
  for (int rank = 0; rank < partition->ranks->count; ++rank)
    for (int n = partition->first_of_rank[rank]; n < partition->first_of_rank[rank + 1];
         ++n) {
      const fg__box *box = &partition->box[n];
      fg__brick place = {.box = n, .nodes = *box}, own = place, ring = place;
      for (int k = 0; k < 3; ++k) {
        place.odd[k] = own.odd[k] = ring.odd[k] = box->first[k] & 1;
        own.nodes.first[k] = 0;
        if (k >= partition->dimension)
          continue;
        ring.odd[k] ^= 1;
        ring.nodes.first[k] -= 1;
        ring.nodes.nodes[k] += 2;
      }
      g->own[n] = own;
      g->place[n] = place;
      g->ring[n] = ring;
      g->layout[n] = fg__layout_of(partition->dimension, box->nodes);
      g->rank_of[n] = rank;
      g->nodes[rank] += (int)fg__box_count(box);
      all += (size_t)fg__box_count(box);
    }
  g->first = partition->first_of_rank[partition->ranks->rank];
  g->end = partition->first_of_rank[partition->ranks->rank + 1];
  size_t mine = (size_t)g->nodes[partition->ranks->rank];
  g->sent = fg__allocate(mine * (size_t)most_arrays, sizeof *g->sent);
  g->received = fg__allocate(all * (size_t)most_arrays, sizeof *g->received);
  return g->sent && g->received;
}

fg_status fg__gather_create(fg__gather **out, fg_context *context,
                            const fg__partition *partition, int most_arrays)
{
  fg__gather *g = *out = fg__allocate(1, sizeof *g);
  fg_status status = FG_STATUS_OK;
  if (g) {
    g->ranks = partition->ranks;
    g->box_count = partition->count;
  }
  if (!g || !make_plan(g, partition, most_arrays))
    status = fg__fail_memory(context, "a replicated level", sizeof *g);
  status = fg__ranks_agree(partition->ranks, context, status);
  if (status) {
    fg__gather_destroy(g);
    *out = NULL;
  }
  return status;
}

void fg__gather_destroy(fg__gather *gather)
{
  if (!gather)
    return;
  free(gather->own);
  free(gather->place);
  free(gather->ring);
  free(gather->layout);
  free(gather->rank_of);
  free(gather->nodes);
  free(gather->count);
  free(gather->offset);
  free(gather->sent);
  free(gather->received);
  free(gather);
}

void fg__gather_fill(fg__gather *gather, int count, float *const *const array[],
                     float *const whole[])
{
  fg__gather *g = gather;
  float *end = g->sent;
  for (int a = 0; a < count; ++a)
    for (int n = g->first; n < g->end; ++n)
      end = fg__brick_pack(&g->own[n], &g->layout[n], array[a][n - g->first],
                           FG__ALL_COLOURS, end);
  int offset = 0;
  for (int rank = 0; rank < g->ranks->count; ++rank) {
    g->offset[rank] = offset;
    g->count[rank] = g->nodes[rank] * count;
    offset += g->count[rank];
  }
  fg__traffic_add_gather(g->ranks->book, (size_t)(offset - g->count[g->ranks->rank]) *
                                             sizeof *g->received);
  MPI_Allgatherv(g->sent, g->count[g->ranks->rank], MPI_FLOAT, g->received, g->count,
                 g->offset, MPI_FLOAT, fg__communicator(g->ranks));
  const float *next = g->received;
  for (int rank = 0, first = 0; rank < g->ranks->count; ++rank) {
    int last = first;
    while (last < g->box_count && g->rank_of[last] == rank)
      ++last;
    for (int a = 0; a < count; ++a)
      for (int n = first; n < last; ++n)
        next = fg__brick_unpack(&g->place[n], &g->whole, whole[a], FG__ALL_COLOURS, next);
    first = last;
  }
}

void fg__gather_return(const fg__gather *gather, int count, float *const whole[],
                       float *const *const array[])
{
  const fg__gather *g = gather;
  for (int n = g->first; n < g->end; ++n) {
    fg__brick to = g->ring[n];
    for (int k = 0; k < 3; ++k)
      to.nodes.first[k] -= g->place[n].nodes.first[k];
    for (int a = 0; a < count; ++a)
      fg__brick_copy(&to, &g->layout[n], array[a][n - g->first], &g->ring[n], &g->whole,
                     whole[a], FG__ALL_COLOURS);
  }
}
