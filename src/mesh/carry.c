#include "mesh/carry.h"

#include <stdlib.h>

#include "base/memory.h"
#include "mesh/refinement.h"

/* Arrays over the halves of a level's boxes. */
typedef struct halves {
  fg__partition partition;
  int boxes;
  float **node;         /* [count][boxes] */
  float *const **array; /* [count] */
  float *memory;
} halves;

static void halves_clear(halves *h)
{
  fg__partition_clear(&h->partition);
  free(h->node);
  free(h->array);
  free(h->memory);
  *h = (halves){0};
}

static fg_status halves_create(halves *out, fg_context *context,
                               const fg__partition *level, int count)
{
  *out = (halves){0};
  fg_status status = fg__partition_coarsen(&out->partition, context, level);
  if (status)
    return status;
  const fg__box *own = fg__own_boxes(&out->partition, &out->boxes);
  size_t size = 0, next = 0, boxes = (size_t)out->boxes, arrays = (size_t)count;
  for (int b = 0; b < out->boxes; ++b)
    size += fg__layout_of(level->dimension, own[b].nodes).array_size;
  out->node = fg__allocate(boxes * arrays, sizeof *out->node);
  out->array = fg__allocate(arrays, sizeof *out->array);
  out->memory = fg__allocate_aligned(size * arrays, sizeof *out->memory);
  if (!out->node || !out->array || !out->memory) {
    halves_clear(out);
    return fg__fail_memory(context, "values of an adapted mesh",
                           size * arrays * sizeof *out->memory);
  }
  for (int a = 0; a < count; ++a) {
    out->array[a] = out->node + (size_t)a * boxes;
    for (int b = 0; b < out->boxes; ++b) {
      fg__layout layout = fg__layout_of(level->dimension, own[b].nodes);
      out->node[(size_t)a * boxes + (size_t)b] = out->memory + next + layout.first;
      next += layout.array_size;
    }
  }
  return FG_STATUS_OK;
}

static void interpolate(const fg__partition *level, const halves *from, int count,
                        const fg__uncovered *nodes, float *const *const target[])
{
  int own_count;
  const fg__box *own = fg__own_boxes(level, &own_count), *box = &nodes->nodes;
  const fg__box *half = fg__own_boxes(&from->partition, &own_count) + nodes->box;
  fg__layout layout = fg__layout_of(level->dimension, own[nodes->box].nodes);
  fg__layout half_layout = fg__layout_of(level->dimension, half->nodes);
  for (int a = 0; a < count; ++a)
    for (int k = box->first[2]; k < box->first[2] + box->nodes[2]; ++k)
      for (int j = box->first[1]; j < box->first[1] + box->nodes[1]; ++j)
        for (int i = box->first[0]; i < box->first[0] + box->nodes[0]; ++i)
          target[a][nodes->box][fg__node_at(&layout, i, j, k)] = fg__interpolated(
              &half_layout, from->array[a][nodes->box], (int[3]){i, j, k});
}

/* Interpolates the nodes of a level that the old mesh did not have. */
static fg_status fill_in(fg_context *context, const fg__partition *level,
                         const fg__partition *coarser, int count,
                         const fg__uncovered *nodes, int node_count,
                         float *const *const source[], float *const *const target[])
{
  halves half;
  fg__exchange *exchange = NULL;
  fg_status status = halves_create(&half, context, level, count);
  status = fg__ranks_agree(level->ranks, context, status);
  if (!status)
    status = fg__exchange_create_between(&exchange, context, coarser, &half.partition,
                                         FG__NODES_AND_GHOSTS, count);
  if (!status) {
    fg__exchange_fill_between(exchange, count, source, half.array, FG__ALL_COLOURS);
    for (int n = 0; n < node_count; ++n)
      interpolate(level, &half, count, &nodes[n], target);
  }
  fg__exchange_destroy(exchange);
  halves_clear(&half);
  return status;
}

fg_status fg__mesh_carry(fg_context *context, const fg__mesh *from, const fg__mesh *to,
                         int count, float *const *const *const source[],
                         float *const *const *const target[])
{
  fg_status status = FG_STATUS_OK;
  for (int n = to->level_count - 1; !status && n >= 0; --n) {
    fg__exchange *exchange;
    int missing;
    status = fg__exchange_create_between(&exchange, context, &from->level[n],
                                         &to->level[n], FG__NODES, count);
    if (status)
      break;
    fg__exchange_fill_between(exchange, count, source[n], target[n], FG__ALL_COLOURS);
    const fg__uncovered *nodes = fg__exchange_uncovered(exchange, &missing);
    if (n + 1 < to->level_count)
      status = fill_in(context, &to->level[n], &to->level[n + 1], count, nodes, missing,
                       target[n + 1], target[n]);
    fg__exchange_destroy(exchange);
  }
  return status;
}
