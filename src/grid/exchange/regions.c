#include "grid/exchange/regions.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* What one block holds of a region, or of its image a period on. */
typedef struct piece {
  fg__box nodes; /* as the block counts them in the grid */
  int shift[3];  /* from there to the region's own count */
} piece;

/* All images of a region that can meet the grid: a period on and back. */
enum { IMAGES = 27 };

/* False when this image has nothing of the block. */
static bool find_piece(piece *out, const fg__partition *partition,
                       const fg__region *region, const fg__box *block, int image)
{
  fg__box moved = region->nodes;
  for (int k = 0, rest = image; k < 3; ++k, rest /= 3) {
    int turns = rest % 3 - 1;
    if (turns != 0 && !partition->periodic[k])
      return false;
    out->shift[k] = turns * partition->nodes[k];
    moved.first[k] -= out->shift[k];
  }
  out->nodes = fg__box_intersection(&moved, block);
  return !fg__box_is_empty(&out->nodes);
}

/* The pieces that go from a rank to another, in the order in which both take them. */
typedef void piece_action(void *closure, int region, const piece *found);

static void for_pieces(const fg__partition *partition, const fg__region *region,
                       int count, int from, int to, piece_action *action, void *closure)
{
  piece found;
  for (int n = 0; n < count; ++n)
    for (int image = 0; region[n].rank == to && image < IMAGES; ++image)
      if (find_piece(&found, partition, &region[n], &partition->block[from], image))
        action(closure, n, &found);
}

static void add_up(void *closure, int region, const piece *found)
{
  (void)region;
  *(size_t *)closure += (size_t)fg__box_count(&found->nodes);
}

typedef struct packing {
  const fg__partition *partition;
  const fg__region *region;
  const fg__region_source *source;
  void *const *out;
  unsigned char *at;
} packing;

static void pack(void *closure, int region, const piece *found)
{
  (void)region;
  packing *p = closure;
  const fg__region_source *source = p->source;
  const fg__box *own = fg__own_block(p->partition);
  const fg__box *nodes = &found->nodes;
  size_t bytes = (size_t)nodes->nodes[0] * source->size;
  for (int k = 0; k < nodes->nodes[2]; ++k)
    for (int j = 0; j < nodes->nodes[1]; ++j, p->at += bytes) {
      ptrdiff_t node = nodes->first[0] - own->first[0] +
                       (nodes->first[1] - own->first[1] + j) * source->row +
                       (nodes->first[2] - own->first[2] + k) * source->plane;
      memcpy(p->at, (const unsigned char *)source->first + node * (ptrdiff_t)source->size,
             bytes);
    }
}

static void unpack(void *closure, int region, const piece *found)
{
  packing *p = closure;
  const fg__box *whole = &p->region[region].nodes, *nodes = &found->nodes;
  size_t size = p->source->size, bytes = (size_t)nodes->nodes[0] * size;
  size_t place[3];
  for (int k = 0; k < 3; ++k)
    place[k] = (size_t)(nodes->first[k] + found->shift[k] - whole->first[k]);
  for (int k = 0; k < nodes->nodes[2]; ++k)
    for (int j = 0; j < nodes->nodes[1]; ++j, p->at += bytes) {
      size_t row =
          (place[2] + (size_t)k) * (size_t)whole->nodes[1] + place[1] + (size_t)j;
      memcpy((unsigned char *)p->out[region] +
                 (row * (size_t)whole->nodes[0] + place[0]) * size,
             p->at, bytes);
    }
}

/* Elements to (or from) each rank and where they begin; false: more than MPI counts. */
static bool count_pieces(int *counts, int *offsets, size_t *total,
                         const fg__partition *partition, const fg__region *region,
                         int count, bool sending)
{
  int self = partition->ranks->rank;
  *total = 0;
  for (int r = 0; r < partition->ranks->count; ++r) {
    size_t elements = 0;
    for_pieces(partition, region, count, sending ? self : r, sending ? r : self, add_up,
               &elements);
    if (*total + elements > INT_MAX)
      return false;
    offsets[r] = (int)*total;
    counts[r] = (int)elements;
    *total += elements;
  }
  return true;
}

/* Counts and offsets of what goes to and comes from each rank: of [ranks] each. */
static void exchange(const fg__ranks *ranks, size_t size, const void *to_send,
                     const int *sent, void *to_receive, const int *received)
{
  for (int r = 0; r < ranks->count; ++r)
    if (r != ranks->rank && sent[r] > 0)
      fg__count_message(ranks->counters, (size_t)sent[r] * size);
  fg__count_exchange(ranks->counters);
  fg__ranks_deal(ranks, size, to_send, sent, sent + ranks->count, to_receive, received,
                 received + ranks->count);
}

fg_status fg__regions_fill(fg_context *context, const fg__partition *partition,
                           const fg__region *region, int count,
                           const fg__region_source *source, void *const out[])
{
  const fg__ranks *ranks = partition->ranks;
  size_t all = (size_t)ranks->count, sent = 0, received = 0;
  int *table = fg__allocate(4 * all, sizeof *table);
  unsigned char *to_send = NULL, *to_receive = NULL;
  fg_status status = FG_STATUS_OK;
  if (!table)
    status = fg__fail_memory(context, "regions of the mesh", 4 * all * sizeof *table);
  else if (!count_pieces(table, table + all, &sent, partition, region, count, true) ||
           !count_pieces(table + 2 * all, table + 3 * all, &received, partition, region,
                         count, false))
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "more than %d nodes for one rank at a time", INT_MAX);
  bool alone = ranks->count == 1;
  if (!status) {
    to_send = fg__allocate(sent, source->size);
    to_receive = alone ? NULL : fg__allocate(received, source->size);
    if (!to_send || !(to_receive || alone))
      status = fg__fail_memory(context, "regions of the mesh",
                               (sent + received) * source->size);
  }
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    packing p = {partition, region, source, out, to_send};
    for (int r = 0; r < ranks->count; ++r)
      for_pieces(partition, region, count, ranks->rank, r, pack, &p);
    if (!alone)
      exchange(ranks, source->size, to_send, table, to_receive, table + 2 * all);
    p.at = alone ? to_send : to_receive;
    for (int r = 0; r < ranks->count; ++r)
      for_pieces(partition, region, count, r, ranks->rank, unpack, &p);
  }
  free(table);
  free(to_send);
  free(to_receive);
  return status;
}
