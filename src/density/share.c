#include "density/share.h"

#include <stdlib.h>

#include "base/memory.h"

fg_status fg__density_share_create(fg__density_share **out, fg_context *context,
                                   const fg__spread *finest, const float *u,
                                   float *scratch, double debris_cells, bool masked)
{
  const fg__partition *grid = &finest->partition;
  fg__density_share *share = *out = fg__allocate(1, sizeof *share);
  fg_status status = share ? fg__partition_copy(&share->partition, context, grid)
                           : fg__fail_memory(context, "a density", sizeof *share);
  status = fg__ranks_agree(grid->ranks, context, status);
  if (!status)
    status = fg__spread_clusters_find(&share->own, context, finest, u, scratch,
                                      debris_cells, true);
  if (status) {
    fg__density_share_destroy(share);
    *out = NULL;
    return status;
  }
  share->masked = masked;
  fg__spread_clusters_label(&share->own, share->own.number);
  fg__components_clear(&share->own.pieces);
  return FG_STATUS_OK;
}

void fg__density_share_destroy(fg__density_share *share)
{
  if (!share)
    return;
  fg__spread_clusters_clear(&share->own);
  fg__partition_clear(&share->partition);
  free(share);
}

/* Where the block has node (cell) (0, 0, 0), and how far rows and planes are apart. */
static fg__region_source source_of(const fg__density_share *share, fg__share_kind kind)
{
  const fg__component_box *grid = &share->own.grid;
  fg__region_source out = {
      .size = sizeof(float), .first = grid->u, .row = grid->row, .plane = grid->plane};
  if (kind == FG__SHARE_LABEL) {
    out.first = share->own.number;
    out.row = grid->nodes[0];
    out.plane = out.row * grid->nodes[1];
  } else if (kind == FG__SHARE_ACTIVE) {
    out = (fg__region_source){.size = 1,
                              .first = grid->active,
                              .row = grid->cell_row,
                              .plane = grid->cell_plane};
  }
  return out;
}

fg_status fg__density_share_fill(fg__density_share *share, fg_context *context,
                                 fg__share_kind kind, const fg__region *region, int count,
                                 void *const out[])
{
  fg__region_source source = source_of(share, kind);
  return fg__regions_fill(context, &share->partition, region, count, &source, out);
}
