#include "mesh/exchange_plan.h"

#include <stdlib.h>

#include "base/memory.h"

/* Ghosts of a box on the side side[k] of it along each axis (-1, 0 within, 1), in local
 * indices, and the nodes of the whole grid that they stand for. */
static void find_sources(const fg__partition *level, const fg__box *box,
                         const int side[3], fg__box *ghosts, fg__box *sources)
{
  for (int k = 0; k < 3; ++k) {
    int nodes = box->nodes[k], last = level->nodes[k] - 1;
    ghosts->first[k] = side[k] < 0 ? -1 : side[k] > 0 ? nodes : 0;
    ghosts->nodes[k] = sources->nodes[k] = side[k] == 0 ? nodes : 1;
    int first = box->first[k] + ghosts->first[k];
    if (first < 0)
      first = level->periodic[k] ? last : 1;
    else if (first > last)
      first = level->periodic[k] ? 0 : last - 1;
    sources->first[k] = first;
  }
}

/* The brick of ghosts whose sources are `part` of `sources`. */
static fg__box ghosts_of(const fg__box *part, const fg__box *sources,
                         const fg__box *ghosts)
{
  fg__box out = *part;
  for (int k = 0; k < 3; ++k)
    out.first[k] = ghosts->first[k] + part->first[k] - sources->first[k];
  return out;
}

static fg__brick brick_of(int box, const fg__box *nodes, const fg__box *sources)
{
  fg__brick out = {.box = box, .nodes = *nodes};
  for (int k = 0; k < 3; ++k)
    out.odd[k] = sources->first[k] & 1;
  return out;
}

static bool add_piece(fg__pieces *list, const fg__piece *added)
{
  void *memory = list->piece;
  bool grown = fg__grow(&memory, &list->capacity, list->count + 1, sizeof *list->piece);
  list->piece = memory;
  if (grown)
    list->piece[list->count++] = *added;
  return grown;
}

static bool add_uncovered(fg__exchange *e, int box, const fg__box *ghosts)
{
  void *memory = e->uncovered;
  bool grown = fg__grow(&memory, &e->uncovered_capacity, e->uncovered_count + 1,
                        sizeof *e->uncovered);
  e->uncovered = memory;
  if (grown)
    e->uncovered[e->uncovered_count++] = (fg__uncovered){box, *ghosts};
  return grown;
}

typedef struct box_list {
  fg__box *box;
  size_t count, capacity;
} box_list;

/* Takes `hole` out of every box of the list. */
static bool take_out(box_list *list, const fg__box *hole)
{
  size_t count = list->count;
  for (size_t n = 0; n < count; ++n) {
    fg__box common = fg__box_intersection(&list->box[n], hole), rest[6];
    if (fg__box_is_empty(&common))
      continue;
    int parts = fg__box_without(rest, &list->box[n], &common);
    void *memory = list->box;
    if (!fg__grow(&memory, &list->capacity, list->count + 6, sizeof *list->box))
      return false;
    list->box = memory;
    list->box[n].nodes[0] = 0; /* empty: dropped below */
    for (int p = 0; p < parts; ++p)
      list->box[list->count++] = rest[p];
  }
  size_t kept = 0;
  for (size_t n = 0; n < list->count; ++n)
    if (!fg__box_is_empty(&list->box[n]))
      list->box[kept++] = list->box[n];
  list->count = kept;
  return true;
}

/* A box whose ghosts are filled: of this rank, or of another that may ask this one. */
typedef struct target {
  const fg__box *box;
  int rank, own; /* own: index among this rank's boxes, or -1 */
} target;

/* Pieces of one side of a target that the boxes of `rank` own. */
static bool add_sources(fg__exchange *e, const fg__partition *level, const target *to,
                        int rank, const fg__box *ghosts, const fg__box *sources,
                        box_list *left)
{
  int here = level->ranks->rank;
  for (int n = level->first_of_rank[rank]; n < level->first_of_rank[rank + 1]; ++n) {
    fg__box common = fg__box_intersection(sources, &level->box[n]);
    if (fg__box_is_empty(&common))
      continue;
    fg__box filled = ghosts_of(&common, sources, ghosts), read = common;
    for (int k = 0; k < 3; ++k)
      read.first[k] -= level->box[n].first[k];
    fg__piece found = {.to = brick_of(to->own, &filled, &common),
                       .from = brick_of(n - level->first_of_rank[rank], &read, &common),
                       .rank = to->own < 0 ? to->rank : rank};
    fg__pieces *list = to->own < 0 ? &e->sent : rank == here ? &e->copied : &e->received;
    if (!add_piece(list, &found) || (to->own >= 0 && !take_out(left, &common)))
      return false;
  }
  return true;
}

static bool add_target(fg__exchange *e, const fg__partition *level, const target *to,
                       box_list *left)
{
  int depth = level->dimension == 3 ? 1 : 0, here = level->ranks->rank;
  for (int z = -depth; z <= depth; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        if (x == 0 && y == 0 && z == 0)
          continue;
        fg__box ghosts, sources;
        find_sources(level, to->box, (int[3]){x, y, z}, &ghosts, &sources);
        left->count = 0;
        if (to->own < 0) {
          if (!add_sources(e, level, to, here, &ghosts, &sources, left))
            return false;
          continue;
        }
        left->box[left->count++] = sources;
        for (int rank = 0; rank < level->ranks->count && left->count > 0; ++rank)
          if (!add_sources(e, level, to, rank, &ghosts, &sources, left))
            return false;
        for (size_t n = 0; n < left->count; ++n) {
          fg__box uncovered = ghosts_of(&left->box[n], &sources, &ghosts);
          if (!add_uncovered(e, to->own, &uncovered))
            return false;
        }
      }
  return true;
}

/* Both sides of a message list its pieces by target, then side, then owner's box. */
static bool find_pieces(fg__exchange *e, const fg__partition *level)
{
  box_list left = {0};
  void *memory = NULL;
  bool done = fg__grow(&memory, &left.capacity, 8, sizeof *left.box);
  left.box = memory;
  for (int rank = 0; rank < level->ranks->count; ++rank) {
    int first = level->first_of_rank[rank], end = level->first_of_rank[rank + 1];
    for (int n = first; done && n < end; ++n) {
      target to = {&level->box[n], rank, rank == level->ranks->rank ? n - first : -1};
      done = add_target(e, level, &to, &left);
    }
  }
  free(left.box);
  return done;
}

/* Stable: pieces of one rank stay in their order. */
static bool sort_by_rank(fg__pieces *list, int ranks)
{
  size_t *place = fg__allocate((size_t)ranks + 1, sizeof *place);
  fg__piece *sorted = fg__allocate(list->count, sizeof *sorted);
  if (place && sorted) {
    for (size_t n = 0; n < list->count; ++n)
      ++place[list->piece[n].rank + 1];
    for (int r = 0; r < ranks; ++r)
      place[r + 1] += place[r];
    for (size_t n = 0; n < list->count; ++n)
      sorted[place[list->piece[n].rank]++] = list->piece[n];
    free(list->piece);
    list->piece = sorted;
    sorted = NULL;
    list->capacity = list->count;
  }
  bool done = place && !sorted;
  free(place);
  free(sorted);
  return done;
}

static bool add_neighbours(fg__neighbours *out, const fg__pieces *list, bool sent)
{
  int count = 0;
  for (size_t n = 0; n < list->count; ++n)
    count += n == 0 || list->piece[n].rank != list->piece[n - 1].rank;
  out->neighbour = fg__allocate((size_t)count, sizeof *out->neighbour);
  out->request = fg__allocate((size_t)count, sizeof(MPI_Request));
  if (!out->neighbour || !out->request)
    return false;
  for (size_t n = 0; n < list->count; ++n) {
    const fg__piece *p = &list->piece[n];
    if (n == 0 || p->rank != list->piece[n - 1].rank)
      out->neighbour[out->count++] = (fg__neighbour){.rank = p->rank, .first = n};
    fg__neighbour *l = &out->neighbour[out->count - 1];
    l->end = n + 1;
    for (int colour = 0; colour < 8; ++colour)
      l->count[colour] += fg__brick_count(sent ? &p->from : &p->to, 1U << colour);
  }
  return true;
}

long fg__neighbour_nodes(const fg__neighbour *l, unsigned colours)
{
  long sum = 0;
  for (int colour = 0; colour < 8; ++colour)
    if (colours >> colour & 1U)
      sum += l->count[colour];
  return sum;
}

static bool take_buffers(fg__exchange *e)
{
  fg__neighbours *both[2] = {&e->senders, &e->receivers};
  long size = 0;
  for (int s = 0; s < 2; ++s)
    for (int n = 0; n < both[s]->count; ++n)
      size +=
          fg__neighbour_nodes(&both[s]->neighbour[n], FG__ALL_COLOURS) * e->most_arrays;
  e->buffers = fg__allocate((size_t)size, sizeof *e->buffers);
  if (!e->buffers)
    return false;
  float *next = e->buffers;
  for (int s = 0; s < 2; ++s)
    for (int n = 0; n < both[s]->count; ++n) {
      both[s]->neighbour[n].buffer = next;
      next +=
          fg__neighbour_nodes(&both[s]->neighbour[n], FG__ALL_COLOURS) * e->most_arrays;
    }
  return true;
}

static bool make_plan(fg__exchange *e, const fg__partition *level)
{
  const fg__box *own = fg__own_boxes(level, &e->own_count);
  e->layout = fg__allocate((size_t)e->own_count, sizeof *e->layout);
  if (!e->layout)
    return false;
  for (int n = 0; n < e->own_count; ++n)
    e->layout[n] = fg__layout_of(level->dimension, own[n].nodes);
  int ranks = level->ranks->count;
  return find_pieces(e, level) && sort_by_rank(&e->sent, ranks) &&
         sort_by_rank(&e->received, ranks) &&
         add_neighbours(&e->senders, &e->sent, true) &&
         add_neighbours(&e->receivers, &e->received, false) && take_buffers(e);
}

fg_status fg__exchange_create(fg__exchange **out, fg_context *context,
                              const fg__partition *partition, int most_arrays)
{
  fg__exchange *e = *out = fg__allocate(1, sizeof *e);
  fg_status status = FG_STATUS_OK;
  if (e) {
    e->communicator = fg__communicator(partition->ranks);
    e->most_arrays = most_arrays;
  }
  if (!e || !make_plan(e, partition))
    status = fg__fail_memory(context, "an exchange of ghosts", sizeof *e);
  status = fg__ranks_agree(partition->ranks, context, status);
  if (status) {
    fg__exchange_destroy(e);
    *out = NULL;
  }
  return status;
}

void fg__exchange_destroy(fg__exchange *exchange)
{
  if (!exchange)
    return;
  free(exchange->layout);
  free(exchange->copied.piece);
  free(exchange->sent.piece);
  free(exchange->received.piece);
  free(exchange->senders.neighbour);
  free(exchange->senders.request);
  free(exchange->receivers.neighbour);
  free(exchange->receivers.request);
  free(exchange->uncovered);
  free(exchange->buffers);
  free(exchange);
}
