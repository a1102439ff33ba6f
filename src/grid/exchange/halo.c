#include "grid/exchange/halo.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

fg_status fg__halo_create(fg__halo *out, fg_context *context,
                          const fg__partition *partition)
{
  const int *nodes = fg__own_block(partition)->nodes;
  bool solid = partition->dimension == 3;
  *out = (fg__halo){.partition = partition,
                    .nodes = {nodes[0], nodes[1], nodes[2]},
                    .ghost_rows = solid && partition->blocks[1] > 1,
                    .row = nodes[0]};
  out->slice = solid ? out->row * (nodes[1] + 2 * out->ghost_rows) : out->row;
  out->size = (size_t)out->slice * (size_t)(nodes[partition->dimension - 1] + 2);
  out->first = out->slice + out->row * out->ghost_rows;
  if (!out->ghost_rows)
    return FG_STATUS_OK;
  size_t face = (size_t)nodes[0] * (size_t)nodes[2];
  out->side[0] = fg__allocate(4 * face, sizeof **out->side);
  if (!out->side[0])
    return fg__fail_memory(context, "the halo", 4 * face * sizeof **out->side);
  for (size_t n = 1; n < 4; ++n)
    out->side[n] = out->side[0] + n * face;
  return FG_STATUS_OK;
}

void fg__halo_clear(fg__halo *halo)
{
  free(halo->side[0]);
  *halo = (fg__halo){0};
}

/* Copies row j of all planes to a face, or back. */
static void copy_face(const fg__halo *halo, float *array, int j, float *face, bool back)
{
  size_t bytes = (size_t)halo->nodes[0] * sizeof *face;
  for (int k = 0; k < halo->nodes[2]; ++k, face += halo->nodes[0]) {
    float *row = array + halo->first + k * halo->slice + j * halo->row;
    memcpy(back ? row : face, back ? face : row, bytes);
  }
}

static void fill_ghost_rows(const fg__halo *halo, float *array)
{
  fg__slabs along = fg__slabs_along(halo->partition, 1);
  size_t face = (size_t)halo->nodes[0] * (size_t)halo->nodes[2];
  const fg__run run[2] = {{halo->side[0], halo->side[1], face, false},
                          {halo->side[2], halo->side[3], face, true}};
  copy_face(halo, array, 0, halo->side[0], false);
  copy_face(halo, array, halo->nodes[1] - 1, halo->side[2], false);
  fg__slabs_exchange(&along, run, 2);
  if (along.above != FG__NOBODY)
    copy_face(halo, array, halo->nodes[1], halo->side[1], true);
  if (along.below != FG__NOBODY)
    copy_face(halo, array, -1, halo->side[3], true);
}

void fg__halo_fill(const fg__halo *halo, void *array)
{
  const fg__partition *partition = halo->partition;
  int last = partition->dimension - 1;
  size_t slice = (size_t)halo->slice;
  float *low = (float *)array + slice,
        *high = low + (halo->nodes[last] - 1) * halo->slice;
  if (halo->ghost_rows)
    fill_ghost_rows(halo, array);
  if (partition->blocks[last] > 1) {
    fg__slabs along = fg__slabs_along(partition, last);
    const fg__run run[2] = {{low, high + slice, slice, false},
                            {high, low - slice, slice, true}};
    fg__slabs_exchange(&along, run, 2);
  } else if (partition->periodic[last]) {
    memcpy(high + slice, low, slice * sizeof *low);
    memcpy(low - slice, high, slice * sizeof *low);
  }
}
