#include "grid/partition.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static fg_status take_blocks(fg__partition *out, fg_context *context)
{
  size_t count = (size_t)out->ranks->count;
  out->block = fg__allocate(count, sizeof *out->block);
  if (out->block)
    return FG_STATUS_OK;
  *out = (fg__partition){0};
  return fg__fail_memory(context, "the partition", count * sizeof *out->block);
}

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

static int block_count(const fg__partition *partition)
{
  return partition->blocks[1] * partition->blocks[2];
}

/* Where a rank's block lies among the others. */
static void find_place(const fg__partition *partition, int rank, int place[3])
{
  const int *blocks = partition->blocks;
  place[0] = 0;
  place[1] = rank % blocks[1];
  place[2] = rank / blocks[1];
}

/* The first node of block `place` along an axis; the end of the last block. */
static int first_node(const fg__partition *partition, int axis, int place, int unit)
{
  int count = partition->blocks[axis];
  if (place == count)
    return partition->nodes[axis];
  return (int)((int64_t)(partition->cells[axis] / unit) * place / count) * unit;
}

fg_status fg__partition_create(fg__partition *out, fg_context *context,
                               const fg__ranks *ranks, int dimension, const int cells[3],
                               const bool periodic[3], const int blocks[3], int unit)
{
  *out = (fg__partition){.ranks = ranks};
  fg_status status = take_blocks(out, context);
  if (status)
    return status;
  set_grid(out, dimension, cells, periodic);
  memcpy(out->blocks, blocks, sizeof out->blocks);
  for (int rank = 0; rank < ranks->count && rank < block_count(out); ++rank) {
    fg__box *block = &out->block[rank];
    int place[3];
    find_place(out, rank, place);
    for (int k = 0; k < 3; ++k) {
      block->first[k] = first_node(out, k, place[k], unit);
      block->nodes[k] = first_node(out, k, place[k] + 1, unit) - block->first[k];
    }
  }
  return FG_STATUS_OK;
}

fg_status fg__partition_copy(fg__partition *out, fg_context *context,
                             const fg__partition *from)
{
  *out = *from;
  fg_status status = take_blocks(out, context);
  if (!status)
    memcpy(out->block, from->block, (size_t)from->ranks->count * sizeof *out->block);
  return status;
}

fg_status fg__partition_coarsen(fg__partition *out, fg_context *context,
                                const fg__partition *fine)
{
  *out = *fine;
  fg_status status = take_blocks(out, context);
  if (status)
    return status;
  int cells[3];
  for (int k = 0; k < 3; ++k)
    cells[k] = fine->cells[k] / 2;
  set_grid(out, fine->dimension, cells, fine->periodic);
  for (int rank = 0; rank < fine->ranks->count; ++rank)
    out->block[rank] = fg__box_halved(&fine->block[rank]);
  return FG_STATUS_OK;
}

bool fg__partition_is_workable(const fg__partition *partition, int least_nodes)
{
  for (int k = 0; k < partition->dimension; ++k) {
    if (partition->cells[k] % 2 != 0)
      return false;
    for (int n = 0; n < partition->ranks->count; ++n) {
      const fg__box *block = &partition->block[n];
      if (fg__box_is_empty(block))
        continue;
      if (block->first[k] % 2 != 0 || block->nodes[k] < least_nodes)
        return false;
    }
  }
  return true;
}

fg__box fg__block_cells(const fg__partition *partition, const fg__box *block)
{
  fg__box out = *block;
  for (int k = 0; k < partition->dimension; ++k)
    if (out.first[k] + out.nodes[k] > partition->cells[k])
      out.nodes[k] = partition->cells[k] - out.first[k];
  return out;
}

int fg__block_neighbour(const fg__partition *partition, int rank, const int steps[3])
{
  const int *blocks = partition->blocks;
  int place[3];
  if (rank >= block_count(partition))
    return FG__NOBODY;
  find_place(partition, rank, place);
  for (int k = 0; k < 3; ++k) {
    place[k] += steps[k];
    if (partition->periodic[k])
      place[k] = (place[k] + blocks[k]) % blocks[k];
    if (place[k] < 0 || place[k] >= blocks[k])
      return FG__NOBODY;
  }
  return place[1] + blocks[1] * place[2];
}

void fg__partition_clear(fg__partition *partition)
{
  free(partition->block);
  *partition = (fg__partition){0};
}
