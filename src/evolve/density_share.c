#include "evolve/density_share.h"

#include <stdlib.h>

#include "base/memory.h"

static fg_status allocate(fg__density_share **out, fg_context *context,
                          const fg__ranks *ranks, int boxes)
{
  size_t count = (size_t)boxes;
  fg_status status = FG_STATUS_OK;
  fg__density_share *share = *out = fg__allocate(1, sizeof *share);
  if (share) {
    share->first = fg__allocate(count, sizeof *share->first);
    share->row = fg__allocate(count, sizeof *share->row);
    share->plane = fg__allocate(count, sizeof *share->plane);
  }
  if (!share || !share->first || !share->row || !share->plane)
    status = fg__fail_memory(context, "a density", count * sizeof *share);
  return fg__ranks_agree(ranks, context, status);
}

fg_status fg__density_share_create(fg__density_share **out, fg_context *context,
                                   const fg__spread *finest, const float *u,
                                   float *scratch, double debris_cells, bool masked)
{
  const fg__partition *grid = &finest->partition;
  int boxes;
  const fg__box *own = fg__own_boxes(grid, &boxes);
  fg_status status = allocate(out, context, grid->ranks, boxes);
  if (!status)
    status =
        fg__partition_create(&(*out)->partition, context, grid->ranks, grid->dimension,
                             grid->cells, grid->periodic, own, boxes);
  if (!status)
    status = fg__spread_clusters_find(&(*out)->own, context, finest, u, scratch,
                                      debris_cells, true);
  if (status) {
    fg__density_share_destroy(*out);
    *out = NULL;
    return status;
  }
  (*out)->masked = masked;
  fg__spread_clusters *clusters = &(*out)->own;
  for (int b = 0; b < boxes; ++b)
    fg__spread_clusters_label(clusters, b, clusters->number[b]);
  for (int b = 0; b < boxes; ++b)
    fg__components_clear(&clusters->box[b]);
  return FG_STATUS_OK;
}

void fg__density_share_destroy(fg__density_share *share)
{
  if (!share)
    return;
  fg__spread_clusters_clear(&share->own);
  fg__partition_clear(&share->partition);
  free(share->first);
  free(share->row);
  free(share->plane);
  free(share);
}

/* Where a box has node (cell) (0, 0, 0), and how far rows and planes are apart. */
static void find_place(fg__density_share *share, fg__share_kind kind, int b)
{
  const fg__spread_clusters *own = &share->own;
  const fg__component_box *grid = &own->grid[b];
  share->row[b] = grid->row;
  share->plane[b] = grid->plane;
  switch (kind) {
  case FG__SHARE_U:
    share->first[b] = grid->u;
    break;
  case FG__SHARE_LABEL:
    share->first[b] = own->number[b];
    share->row[b] = grid->nodes[0];
    share->plane[b] = share->row[b] * grid->nodes[1];
    break;
  case FG__SHARE_ACTIVE:
    share->first[b] = grid->active;
    share->row[b] = grid->cell_row;
    share->plane[b] = grid->cell_plane;
    break;
  }
}

fg_status fg__density_share_fill(fg__density_share *share, fg_context *context,
                                 fg__share_kind kind, const fg__region *region, int count,
                                 void *const out[])
{
  for (int b = 0; b < share->own.count; ++b)
    find_place(share, kind, b);
  fg__region_source source = {.size = kind == FG__SHARE_ACTIVE ? 1 : sizeof(float),
                              .first = share->first,
                              .row = share->row,
                              .plane = share->plane};
  return fg__regions_fill(context, &share->partition, region, count, &source, out);
}
