#include "grid/exchange/plan.h"

static void post_receives(fg__exchange *e)
{
  for (int n = 0; n < e->receivers.count; ++n) {
    const fg__neighbour *l = &e->receivers.neighbour[n];
    int64_t nodes = fg__neighbour_nodes(l, e->colours) * e->arrays;
    fg__request_receive(e->ranks, e->receivers.requests, n, l->buffer, (int)nodes,
                        l->rank);
  }
}

static void post_sends(fg__exchange *e)
{
  for (int n = 0; n < e->senders.count; ++n) {
    const fg__neighbour *l = &e->senders.neighbour[n];
    float *end = l->buffer;
    for (int a = 0; a < e->arrays; ++a)
      for (size_t p = l->first; p < l->end; ++p) {
        const fg__brick *from = &e->sent.piece[p].from;
        end = fg__brick_pack(from, &e->layout, e->array[a], e->colours, end);
      }
    ptrdiff_t nodes = end - l->buffer;
    fg__request_send(e->ranks, e->senders.requests, n, l->buffer, (int)nodes, l->rank);
    if (nodes > 0)
      fg__count_message(e->ranks->counters, (size_t)nodes * sizeof(float));
  }
}

void fg__exchange_begin(fg__exchange *exchange, int count, float *const array[],
                        unsigned colours)
{
  fg__exchange *e = exchange;
  e->arrays = count;
  e->array = array;
  e->colours = colours;
  fg__count_exchange(e->ranks->counters);
  post_receives(e);
  post_sends(e);
  for (size_t n = 0; n < e->copied.count; ++n) {
    const fg__brick *to = &e->copied.piece[n].to, *from = &e->copied.piece[n].from;
    for (int a = 0; a < count; ++a)
      fg__brick_copy(to, &e->layout, array[a], from, &e->layout, array[a], colours);
  }
}

void fg__exchange_finish(fg__exchange *exchange)
{
  fg__exchange *e = exchange;
  fg__requests_wait(e->ranks, e->receivers.requests, e->receivers.count);
  for (int n = 0; n < e->receivers.count; ++n) {
    const fg__neighbour *l = &e->receivers.neighbour[n];
    const float *next = l->buffer;
    for (int a = 0; a < e->arrays; ++a)
      for (size_t p = l->first; p < l->end; ++p) {
        const fg__brick *to = &e->received.piece[p].to;
        next = fg__brick_unpack(to, &e->layout, e->array[a], e->colours, next);
      }
  }
  fg__requests_wait(e->ranks, e->senders.requests, e->senders.count);
}
