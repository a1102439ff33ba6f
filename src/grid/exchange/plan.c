#include "grid/exchange/plan.h"

#include <stdlib.h>

#include "base/memory.h"

/* Ghosts of a block on the side side[k] of it along each axis (-1, 0 within, 1), in local
 * indices, and the nodes of the whole grid that they stand for. */
static void find_sources(const fg__partition *level, const fg__box *block,
                         const int side[3], fg__box *ghosts, fg__box *sources)
{
  for (int k = 0; k < 3; ++k) {
    int nodes = block->nodes[k], last = level->nodes[k] - 1;
    ghosts->first[k] = side[k] < 0 ? -1 : side[k] > 0 ? nodes : 0;
    ghosts->nodes[k] = sources->nodes[k] = side[k] == 0 ? nodes : 1;
    int first = block->first[k] + ghosts->first[k];
    if (first < 0)
      first = level->periodic[k] ? last : 1;
    else if (first > last)
      first = level->periodic[k] ? 0 : last - 1;
    sources->first[k] = first;
  }
}

/* The rank that owns these sources: mirror images lie in the same block. */
static int owner_of(const fg__partition *level, int rank, const int side[3])
{
  int steps[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    steps[k] = side[k];
    if (fg__block_neighbour(level, rank, steps) == FG__NOBODY)
      steps[k] = 0;
  }
  return fg__block_neighbour(level, rank, steps);
}

static fg__brick brick_of(const fg__box *nodes, const fg__box *sources)
{
  fg__brick out = {.nodes = *nodes};
  for (int k = 0; k < 3; ++k)
    out.odd[k] = sources->first[k] & 1;
  return out;
}

static bool add_piece(fg__pieces *list, const fg__exchange_piece *added)
{
  void *memory = list->piece;
  bool grown = fg__grow(&memory, &list->capacity, list->count + 1, sizeof *list->piece);
  list->piece = memory;
  if (grown)
    list->piece[list->count++] = *added;
  return grown;
}

/* Adds the ghosts on the sides of a rank's block whose sources another, or the same, rank
 * owns; `other` is of these two the one that this rank exchanges them with. */
static bool add_ghosts(fg__pieces *list, const fg__partition *level, int rank, int owner,
                       int other)
{
  int depth = level->dimension == 3 ? 1 : 0;
  for (int z = -depth; z <= depth; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int side[3] = {x, y, z};
        fg__box ghosts, sources;
        if ((x == 0 && y == 0 && z == 0) || owner_of(level, rank, side) != owner)
          continue;
        find_sources(level, &level->block[rank], side, &ghosts, &sources);
        fg__box read = sources;
        for (int k = 0; k < 3; ++k)
          read.first[k] -= level->block[owner].first[k];
        fg__exchange_piece found = {.to = brick_of(&ghosts, &sources),
                                    .from = brick_of(&read, &sources),
                                    .rank = other};
        if (!add_piece(list, &found))
          return false;
      }
  return true;
}

/* Both sides of a message list its pieces by side of the block that is filled. */
static bool find_pieces(fg__exchange *e, const fg__partition *level)
{
  int here = level->ranks->rank;
  bool done = add_ghosts(&e->copied, level, here, here, here);
  for (int rank = 0; rank < level->ranks->count && done; ++rank)
    if (rank != here)
      done = add_ghosts(&e->received, level, here, rank, rank) &&
             add_ghosts(&e->sent, level, rank, here, rank);
  return done;
}

static bool add_neighbours(fg__neighbours *out, const fg__ranks *ranks,
                           const fg__pieces *list, bool sent)
{
  int count = 0;
  for (size_t n = 0; n < list->count; ++n)
    count += n == 0 || list->piece[n].rank != list->piece[n - 1].rank;
  out->neighbour = fg__allocate((size_t)count, sizeof *out->neighbour);
  out->requests = fg__requests_create(ranks, count);
  if (!out->neighbour || !out->requests)
    return false;
  for (size_t n = 0; n < list->count; ++n) {
    const fg__exchange_piece *p = &list->piece[n];
    if (n == 0 || p->rank != list->piece[n - 1].rank)
      out->neighbour[out->count++] = (fg__neighbour){.rank = p->rank, .first = n};
    fg__neighbour *l = &out->neighbour[out->count - 1];
    l->end = n + 1;
    for (int colour = 0; colour < 8; ++colour)
      l->count[colour] += fg__brick_count(sent ? &p->from : &p->to, 1U << colour);
  }
  return true;
}

int64_t fg__neighbour_nodes(const fg__neighbour *l, unsigned colours)
{
  int64_t sum = 0;
  for (int colour = 0; colour < 8; ++colour)
    if (colours >> colour & 1U)
      sum += l->count[colour];
  return sum;
}

static bool take_buffers(fg__exchange *e)
{
  fg__neighbours *both[2] = {&e->senders, &e->receivers};
  int64_t size = 0;
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
  e->layout = fg__layout_of(level->dimension, fg__own_block(level)->nodes);
  return find_pieces(e, level) && add_neighbours(&e->senders, e->ranks, &e->sent, true) &&
         add_neighbours(&e->receivers, e->ranks, &e->received, false) && take_buffers(e);
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
  free(exchange->copied.piece);
  free(exchange->sent.piece);
  free(exchange->received.piece);
  free(exchange->senders.neighbour);
  free(exchange->senders.requests);
  free(exchange->receivers.neighbour);
  free(exchange->receivers.requests);
  free(exchange->buffers);
  free(exchange);
}
