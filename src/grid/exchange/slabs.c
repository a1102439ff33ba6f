#include "grid/exchange/slabs.h"

fg__slabs fg__slabs_along(const fg__partition *partition, int axis)
{
  const fg__ranks *ranks = partition->ranks;
  int up[3] = {0, 0, 0}, down[3] = {0, 0, 0};
  up[axis] = 1;
  down[axis] = -1;
  return (fg__slabs){.ranks = ranks,
                     .below = fg__block_neighbour(partition, ranks->rank, down),
                     .above = fg__block_neighbour(partition, ranks->rank, up)};
}

bool fg__slabs_find(fg__slabs *out, const fg__partition *partition)
{
  int last = partition->dimension - 1;
  *out = fg__slabs_along(partition, last);
  return partition->blocks[last] > 1 && (last == 1 || partition->blocks[1] == 1);
}

/* With two ranks and a periodic axis the same neighbour is on both sides: tags tell
 * them apart. Begun all at once, messages took as long (65 nodes in 3D, two ranks). */
void fg__slabs_exchange(const fg__slabs *slabs, const fg__run run[], int count)
{
  enum { UP = 2, DOWN = 3 };
  fg__count_exchange(slabs->ranks->counters);
  for (int n = 0; n < count; ++n) {
    const fg__run *r = &run[n];
    int to = r->up ? slabs->above : slabs->below;
    int from = r->up ? slabs->below : slabs->above;
    fg__ranks_swap(slabs->ranks, r->up ? UP : DOWN, (int)r->count, r->sent, to,
                   r->received, from);
    if (to != FG__NOBODY)
      fg__count_message(slabs->ranks->counters, r->count * sizeof(float));
  }
}
