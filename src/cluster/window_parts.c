#include "cluster/parts.h"

#include <string.h>

/* Copies a rectangle of the window. */
static fg_status take(fg__window *out, fg_context *context,
                      const fg_density_arrays *density, const fg__window *whole,
                      const fg__stretch range[2])
{
  *out = *whole;
  for (int k = 0; k < 2; ++k)
    fg__stretch_cut(&range[k], density, k, &out->nodes[k], &out->origin[k],
                    &out->at_border[2 * k]);
  size_t wide = (size_t)out->nodes[0], high = (size_t)out->nodes[1];
  size_t row = (size_t)whole->nodes[0];
  fg_status status = fg__window_allocate(out, context);
  if (status)
    return status;
  for (size_t y = 0; y < high; ++y) {
    size_t from = (size_t)range[1].first + y, x = (size_t)range[0].first;
    memcpy(out->level + y * wide, whole->level + from * row + x,
           wide * sizeof *out->level);
    if (y + 1 < high)
      memcpy(out->active + y * (wide - 1), whole->active + from * (row - 1) + x,
             wide - 1);
  }
  return fg__window_keep_largest(out, context);
}

fg_status fg__window_divide(fg__window_part part[FG__WINDOW_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__window *whole)
{
  const fg__window_view view = {.cluster = whole->cluster,
                                .nodes = {whole->nodes[0], whole->nodes[1], 1},
                                .origin = whole->origin,
                                .level = whole->level};
  fg__piece piece[FG__WINDOW_PARTS];
  int found = fg__pieces_find(piece, density, labels, &view);
  fg_status status = FG_STATUS_OK;
  *count = 0;
  if (found == 0) {
    part[(*count)++] = (fg__window_part){*whole, 1.0};
    *whole = (fg__window){0};
  }
  for (; *count < found && !status; ++*count) {
    fg__window_part *next = &part[*count];
    next->share = piece[*count].share;
    status = take(&next->window, context, density, whole, piece[*count].range);
  }
  fg__window_clear(whole);
  return status;
}
