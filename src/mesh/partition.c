#include "mesh/partition.h"

#include <stdlib.h>

#include "base/memory.h"
#include "mesh/communicator.h"

static void set_grid(fg__partition *out, int dimension, const int cells[3],
                     const bool periodic[3])
{
  out->dimension = dimension;
  for (int k = 0; k < 3; ++k) {
    bool used = k < dimension;
    out->cells[k] = used ? cells[k] : 1;
    out->periodic[k] = used && periodic[k];
    out->nodes[k] = out->cells[k] + (used && !periodic[k]);
  }
}

static fg_status take_boxes(fg__partition *out, fg_context *context,
                            const fg__ranks *ranks, int count)
{
  out->ranks = ranks;
  out->count = count;
  out->box = fg__allocate((size_t)count, sizeof *out->box);
  if (!out->first_of_rank)
    out->first_of_rank =
        fg__allocate((size_t)ranks->count + 1, sizeof *out->first_of_rank);
  if (out->box && out->first_of_rank)
    return FG_STATUS_OK;
  fg__partition_clear(out);
  return fg__fail_memory(context, "the partition", (size_t)count * sizeof *out->box);
}

/* first_of_rank from the number of boxes of each rank. */
static void sum_up_counts(int *first_of_rank, int ranks)
{
  int first = 0;
  for (int r = 0; r <= ranks; ++r) {
    int count = r < ranks ? first_of_rank[r] : 0;
    first_of_rank[r] = first;
    first += count;
  }
}

fg_status fg__partition_create(fg__partition *out, fg_context *context,
                               const fg__ranks *ranks, int dimension, const int cells[3],
                               const bool periodic[3], const fg__box *own, int own_count)
{
  *out = (fg__partition){0};
  int *first = out->first_of_rank = fg__allocate((size_t)ranks->count + 1, sizeof *first);
  fg_status status = FG_STATUS_OK;
  if (!first)
    status =
        fg__fail_memory(context, "the partition", (size_t)ranks->count * sizeof *first);
  status = fg__ranks_agree(ranks, context, status);
  if (status) {
    fg__partition_clear(out);
    return status;
  }
  MPI_Comm communicator = fg__communicator(ranks);
  fg__traffic_add_gather(ranks->book, (size_t)(ranks->count - 1) * sizeof own_count);
  MPI_Allgather(&own_count, 1, MPI_INT, first, 1, MPI_INT, communicator);
  sum_up_counts(first, ranks->count);
  int *count = fg__allocate((size_t)ranks->count, sizeof *count);
  status = take_boxes(out, context, ranks, first[ranks->count]);
  if (!status && !count)
    status =
        fg__fail_memory(context, "the partition", (size_t)ranks->count * sizeof *count);
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    MPI_Datatype type;
    MPI_Type_contiguous(sizeof(fg__box) / sizeof(int), MPI_INT, &type);
    MPI_Type_commit(&type);
    for (int r = 0; r < ranks->count; ++r)
      count[r] = first[r + 1] - first[r];
    fg__traffic_add_gather(ranks->book,
                           (size_t)(first[ranks->count] - own_count) * sizeof *own);
    MPI_Allgatherv(own, own_count, type, out->box, count, first, type, communicator);
    MPI_Type_free(&type);
    set_grid(out, dimension, cells, periodic);
  } else {
    fg__partition_clear(out);
  }
  free(count);
  return status;
}

fg_status fg__partition_coarsen(fg__partition *out, fg_context *context,
                                const fg__partition *fine)
{
  *out = (fg__partition){0};
  fg_status status = take_boxes(out, context, fine->ranks, fine->count);
  if (status)
    return status;
  int cells[3];
  for (int k = 0; k < 3; ++k)
    cells[k] = fine->cells[k] / 2;
  set_grid(out, fine->dimension, cells, fine->periodic);
  out->count = 0;
  for (int r = 0; r < fine->ranks->count; ++r) {
    out->first_of_rank[r] = out->count;
    for (int n = fine->first_of_rank[r]; n < fine->first_of_rank[r + 1]; ++n) {
      const fg__box box = fg__box_halved(&fine->box[n]);
      if (!fg__box_is_empty(&box))
        out->box[out->count++] = box;
    }
  }
  out->first_of_rank[fine->ranks->count] = out->count;
  return FG_STATUS_OK;
}

bool fg__partition_is_workable(const fg__partition *partition, int least_nodes)
{
  for (int k = 0; k < partition->dimension; ++k)
    if (partition->cells[k] % 2 != 0)
      return false;
  for (int n = 0; n < partition->count; ++n)
    for (int k = 0; k < partition->dimension; ++k)
      if (partition->box[n].first[k] % 2 != 0 || partition->box[n].nodes[k] < least_nodes)
        return false;
  return true;
}

fg__box fg__box_cells(const fg__partition *partition, const fg__box *box)
{
  fg__box out = *box;
  for (int k = 0; k < partition->dimension; ++k)
    if (out.first[k] + out.nodes[k] > partition->cells[k])
      out.nodes[k] = partition->cells[k] - out.first[k];
  return out;
}

void fg__partition_clear(fg__partition *partition)
{
  free(partition->box);
  free(partition->first_of_rank);
  *partition = (fg__partition){0};
}
