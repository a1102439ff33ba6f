#include "cluster/volume.h"

#include <string.h>

#include "cluster/parts.h"

/* Copies a box of the window. */
static fg_status take(fg__volume *out, fg_context *context,
                      const fg_density_arrays *density, const fg__volume *whole,
                      const fg__stretch range[3])
{
  *out = *whole;
  for (int k = 0; k < 3; ++k)
    fg__stretch_cut(&range[k], density, k, &out->nodes[k], &out->origin[k],
                    &out->at_border[2 * k]);
  fg_status status = fg__volume_allocate(out, context);
  if (status)
    return status;
  size_t wide = (size_t)out->nodes[0];
  int first = range[0].first;
  for (int z = 0; z < out->nodes[2]; ++z)
    for (int y = 0; y < out->nodes[1]; ++y) {
      int from_y = range[1].first + y, from_z = range[2].first + z;
      memcpy(out->level + fg__volume_node(out, 0, y, z),
             whole->level + fg__volume_node(whole, first, from_y, from_z),
             wide * sizeof *out->level);
      if (y + 1 < out->nodes[1] && z + 1 < out->nodes[2])
        memcpy(out->active + fg__volume_cell(out, 0, y, z),
               whole->active + fg__volume_cell(whole, first, from_y, from_z), wide - 1);
    }
  return fg__volume_keep_largest(out, context);
}

fg_status fg__volume_divide(fg__volume_part part[FG__WINDOW_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__volume *whole)
{
  const fg__window_view view = {
      .cluster = whole->cluster,
      .nodes = {whole->nodes[0], whole->nodes[1], whole->nodes[2]},
      .origin = whole->origin,
      .level = whole->level};
  fg__piece piece[FG__WINDOW_PARTS];
  int found = fg__pieces_find(piece, density, labels, &view);
  fg_status status = FG_STATUS_OK;
  *count = 0;
  if (found == 0) {
    part[(*count)++] = (fg__volume_part){*whole, 1.0};
    *whole = (fg__volume){0};
  }
  for (; *count < found && !status; ++*count) {
    fg__volume_part *next = &part[*count];
    next->share = piece[*count].share;
    status = take(&next->volume, context, density, whole, piece[*count].range);
  }
  fg__volume_clear(whole);
  return status;
}
