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
 * them apart. Messages of one tag keep their order. */
void fg__slabs_exchange(const fg__slabs *slabs, const fg__run run[], int count)
{
  enum { UP = 2, DOWN = 3 };
  MPI_Comm communicator = fg__communicator(slabs->ranks);
  MPI_Request request[2 * FG__MOST_RUNS];
  int requests = 0;
  fg__traffic_add_exchange(slabs->ranks->book);
  for (int n = 0; n < count; ++n) {
    int from = run[n].up ? slabs->below : slabs->above;
    if (from != FG__NOBODY)
      MPI_Irecv(run[n].received, (int)run[n].count, MPI_FLOAT, from,
                run[n].up ? UP : DOWN, communicator, &request[requests++]);
  }
  for (int n = 0; n < count; ++n) {
    int to = run[n].up ? slabs->above : slabs->below;
    if (to == FG__NOBODY)
      continue;
    MPI_Isend(run[n].sent, (int)run[n].count, MPI_FLOAT, to, run[n].up ? UP : DOWN,
              communicator, &request[requests++]);
    fg__traffic_add_message(slabs->ranks->book, run[n].count * sizeof(float));
  }
  MPI_Waitall(requests, request, MPI_STATUSES_IGNORE);
}
