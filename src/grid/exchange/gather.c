#include "grid/exchange/gather.h"

#include <stdlib.h>

#include "base/memory.h"
#include "grid/exchange/brick.h"

struct fg__gather {
  const fg__ranks *ranks;
  fg__brick own, ring; /* this rank's block: in its arrays; in the whole's with ghosts */
  fg__brick *place;    /* [ranks] each rank's block in the whole's arrays */
  fg__layout layout, whole;
  int *nodes; /* [ranks] */
  int *count, *offset;
  float *sent, *received;
};

static bool make_plan(fg__gather *g, const fg__partition *partition, int most_arrays)
{
  size_t ranks = (size_t)partition->ranks->count, all = 0;
  const fg__box *own = fg__own_block(partition);
  g->place = fg__allocate(ranks, sizeof *g->place);
  g->nodes = fg__allocate(ranks, sizeof *g->nodes);
  g->count = fg__allocate(ranks, sizeof *g->count);
  g->offset = fg__allocate(ranks, sizeof *g->offset);
  if (!g->place || !g->nodes || !g->count || !g->offset)
    return false;
  g->layout = fg__layout_of(partition->dimension, own->nodes);
  g->whole = fg__layout_of(partition->dimension, partition->nodes);
  for (size_t rank = 0; rank < ranks; ++rank) {
    const fg__box *block = &partition->block[rank];
    g->place[rank].nodes = *block;
    for (int k = 0; k < 3; ++k)
      g->place[rank].odd[k] = block->first[k] & 1;
    g->nodes[rank] = (int)fg__box_count(block);
    all += (size_t)fg__box_count(block);
  }
  g->own = g->ring = g->place[partition->ranks->rank];
  for (int k = 0; k < 3; ++k)
    g->own.nodes.first[k] = 0;
  for (int k = 0; k < partition->dimension; ++k) {
    g->ring.odd[k] ^= 1;
    g->ring.nodes.first[k] -= 1;
    g->ring.nodes.nodes[k] += 2;
  }
  size_t mine = (size_t)fg__box_count(own);
  g->sent = fg__allocate(mine * (size_t)most_arrays, sizeof *g->sent);
  g->received = fg__allocate(all * (size_t)most_arrays, sizeof *g->received);
  return g->sent && g->received;
}

fg_status fg__gather_create(fg__gather **out, fg_context *context,
                            const fg__partition *partition, int most_arrays)
{
  fg__gather *g = *out = fg__allocate(1, sizeof *g);
  fg_status status = FG_STATUS_OK;
  if (g)
    g->ranks = partition->ranks;
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
  free(gather->place);
  free(gather->nodes);
  free(gather->count);
  free(gather->offset);
  free(gather->sent);
  free(gather->received);
  free(gather);
}

void fg__gather_fill(fg__gather *gather, int count, float *const array[],
                     float *const whole[])
{
  fg__gather *g = gather;
  float *end = g->sent;
  for (int a = 0; a < count; ++a)
    end = fg__brick_pack(&g->own, &g->layout, array[a], FG__ALL_COLOURS, end);
  int offset = 0;
  for (int rank = 0; rank < g->ranks->count; ++rank) {
    g->offset[rank] = offset;
    g->count[rank] = g->nodes[rank] * count;
    offset += g->count[rank];
  }
  fg__count_gather(g->ranks->counters,
                   (size_t)(offset - g->count[g->ranks->rank]) * sizeof *g->received);
  fg__ranks_gather(g->ranks, g->sent, g->received, g->count, g->offset);
  const float *next = g->received;
  for (int rank = 0; rank < g->ranks->count; ++rank)
    for (int a = 0; a < count; ++a)
      next =
          fg__brick_unpack(&g->place[rank], &g->whole, whole[a], FG__ALL_COLOURS, next);
}

void fg__gather_return(const fg__gather *gather, int count, float *const whole[],
                       float *const array[])
{
  const fg__gather *g = gather;
  fg__brick to = g->ring;
  for (int k = 0; k < 3; ++k)
    to.nodes.first[k] -= g->place[g->ranks->rank].nodes.first[k];
  for (int a = 0; a < count; ++a)
    fg__brick_copy(&to, &g->layout, array[a], &g->ring, &g->whole, whole[a],
                   FG__ALL_COLOURS);
}
