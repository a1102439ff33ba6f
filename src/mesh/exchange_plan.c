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

/* A box to fill: of this rank, or of another that may ask this one. */
typedef struct target {
  const fg__box *box;
  int rank, own; /* own: index among this rank's boxes, or -1 */
} target;

/* A box that may have what a target needs. */
typedef struct source {
  const fg__box *box;
  int rank, index; /* among the rank's boxes */
} source;

typedef struct search {
  const fg__partition *level;
  source *source;
  size_t source_count, source_capacity;
} search;

/* Mirror images lie within one node of a box as well as neighbours do. */
static bool reaches(const fg__partition *level, const fg__box *filled, const fg__box *box)
{
  for (int k = 0; k < level->dimension; ++k) {
    int first = filled->first[k] - 1, end = filled->first[k] + filled->nodes[k] + 1;
    int box_end = box->first[k] + box->nodes[k], nodes = level->nodes[k];
    bool near = box->first[k] < end && box_end > first;
    bool round = level->periodic[k] &&
                 ((first < 0 && box_end == nodes) || (end > nodes && box->first[k] == 0));
    if (!near && !round)
      return false;
  }
  return true;
}

/* Boxes of ranks first_rank ... last_rank near a target, in order. */
static bool find_near(search *s, const fg__box *box, int first_rank, int last_rank)
{
  s->source_count = 0;
  for (int rank = first_rank; rank <= last_rank; ++rank) {
    int first = s->level->first_of_rank[rank], end = s->level->first_of_rank[rank + 1];
    for (int n = first; n < end; ++n) {
      if (!reaches(s->level, box, &s->level->box[n]))
        continue;
      void *memory = s->source;
      if (!fg__grow(&memory, &s->source_capacity, s->source_count + 1, sizeof *s->source))
        return false;
      s->source = memory;
      s->source[s->source_count++] = (source){&s->level->box[n], rank, n - first};
    }
  }
  return true;
}

/* Pieces of one side of a target, found among the sources near it. */
static bool add_pieces(fg__exchange *e, search *s, const target *to,
                       const fg__box *ghosts, const fg__box *sources)
{
  for (size_t n = 0; n < s->source_count; ++n) {
    const source *from = &s->source[n];
    fg__box common = fg__box_intersection(sources, from->box);
    if (fg__box_is_empty(&common))
      continue;
    fg__box filled = ghosts_of(&common, sources, ghosts), read = common;
    for (int k = 0; k < 3; ++k)
      read.first[k] -= from->box->first[k];
    fg__piece found = {.to = brick_of(to->own, &filled, &common),
                       .from = brick_of(from->index, &read, &common),
                       .rank = to->own < 0 ? to->rank : from->rank};
    fg__pieces *list = to->own < 0                           ? &e->sent
                       : from->rank == s->level->ranks->rank ? &e->copied
                                                             : &e->received;
    if (!add_piece(list, &found))
      return false;
  }
  return true;
}

static bool add_target(fg__exchange *e, search *s, const target *to)
{
  int depth = s->level->dimension == 3 ? 1 : 0, here = s->level->ranks->rank;
  int last = s->level->ranks->count - 1;
  if (!find_near(s, to->box, to->own < 0 ? here : 0, to->own < 0 ? here : last))
    return false;
  for (int z = -depth; z <= depth; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int side[3] = {x, y, z};
        fg__box ghosts, sources;
        if (x == 0 && y == 0 && z == 0)
          continue;
        find_sources(s->level, to->box, side, &ghosts, &sources);
        if (!add_pieces(e, s, to, &ghosts, &sources))
          return false;
      }
  return true;
}

/* Both sides of a message list its pieces by target, then side, then owner's box. */
static bool find_pieces(fg__exchange *e, search *s)
{
  bool done = true;
  const fg__partition *level = s->level;
  for (int rank = 0; rank < level->ranks->count; ++rank) {
    int first = level->first_of_rank[rank], end = level->first_of_rank[rank + 1];
    for (int n = first; done && n < end; ++n) {
      target to = {&level->box[n], rank, rank == level->ranks->rank ? n - first : -1};
      done = add_target(e, s, &to);
    }
  }
  free(s->source);
  return done;
}

/* Stable: pieces of one rank stay in their order. */
static bool sort_by_rank(fg__pieces *list, int ranks)
{
  size_t *place = fg__allocate((size_t)ranks + 1, sizeof *place);
  fg__piece *sorted = fg__allocate(list->count, sizeof *sorted);
  if (!place || !sorted) {
    free(place);
    free(sorted);
    return false;
  }
  for (size_t n = 0; n < list->count; ++n)
    ++place[list->piece[n].rank + 1];
  for (int r = 0; r < ranks; ++r)
    place[r + 1] += place[r];
  for (size_t n = 0; n < list->count; ++n)
    sorted[place[list->piece[n].rank]++] = list->piece[n];
  free(place);
  free(list->piece);
  list->piece = sorted;
  list->capacity = list->count;
  return true;
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

static fg__layout *layouts_of(const fg__partition *level)
{
  int count;
  const fg__box *own = fg__own_boxes(level, &count);
  fg__layout *out = fg__allocate((size_t)count, sizeof *out);
  for (int n = 0; out && n < count; ++n)
    out[n] = fg__layout_of(level->dimension, own[n].nodes);
  return out;
}

static bool make_plan(fg__exchange *e, const fg__partition *level)
{
  int ranks = level->ranks->count;
  search s = {.level = level};
  e->layout = layouts_of(level);
  return e->layout && find_pieces(e, &s) && sort_by_rank(&e->sent, ranks) &&
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
    e->ranks = partition->ranks;
    e->most_arrays = most_arrays;
  }
  if (!e || !make_plan(e, partition))
    status = fg__fail_memory(context, "an exchange of nodes", sizeof *e);
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
  free(exchange->buffers);
  free(exchange);
}
