#include "mesh/slabs.h"

#include "mesh/communicator.h"

static bool are_slabs(const fg__partition *partition)
{
  for (int rank = 0; rank < partition->ranks->count; ++rank)
    if (partition->first_of_rank[rank + 1] - partition->first_of_rank[rank] != 1)
      return false;
  for (int n = 0; n < partition->count; ++n)
    for (int k = 0; k + 1 < partition->dimension; ++k)
      if (partition->box[n].nodes[k] != partition->nodes[k])
        return false;
  return partition->count > 1;
}

/* The rank whose slab begins or ends at slice `at`; every rank has one. */
static int rank_at(const fg__partition *partition, int at, bool begins)
{
  int axis = partition->dimension - 1, nodes = partition->nodes[axis];
  if (partition->periodic[axis])
    at = begins ? at % nodes : at > 0 ? at : nodes;
  for (int n = 0; n < partition->count; ++n) {
    const fg__box *box = &partition->box[n];
    if (box->first[axis] + (begins ? 0 : box->nodes[axis]) == at)
      return n;
  }
  return FG__NOBODY;
}

bool fg__slabs_find(fg__slabs *out, const fg__partition *partition)
{
  *out = (fg__slabs){.ranks = partition->ranks, .below = FG__NOBODY, .above = FG__NOBODY};
  if (!are_slabs(partition))
    return false;
  int axis = partition->dimension - 1;
  const fg__box *own = &partition->box[partition->ranks->rank];
  out->below = rank_at(partition, own->first[axis], false);
  out->above = rank_at(partition, own->first[axis] + own->nodes[axis], true);
  return true;
}

/* With two ranks and a periodic axis the same neighbour is on both sides: tags tell
 * them apart. Begun all at once, messages took as long (65 nodes in 3D, two ranks). */
void fg__slabs_exchange(const fg__slabs *slabs, const fg__run run[], int count)
{
  enum { UP = 2, DOWN = 3 };
  MPI_Comm communicator = fg__communicator(slabs->ranks);
  int below = slabs->below == FG__NOBODY ? MPI_PROC_NULL : slabs->below;
  int above = slabs->above == FG__NOBODY ? MPI_PROC_NULL : slabs->above;
  fg__traffic_add_exchange(slabs->ranks->book);
  for (int n = 0; n < count; ++n) {
    const fg__run *r = &run[n];
    int to = r->up ? above : below, from = r->up ? below : above;
    int tag = r->up ? UP : DOWN;
    MPI_Sendrecv(r->sent, (int)r->count, MPI_FLOAT, to, tag, r->received, (int)r->count,
                 MPI_FLOAT, from, tag, communicator, MPI_STATUS_IGNORE);
    if (to != MPI_PROC_NULL)
      fg__traffic_add_message(slabs->ranks->book, r->count * sizeof(float));
  }
}
