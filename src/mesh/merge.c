#include "mesh/merge.h"

#include <stdlib.h>

#include "base/memory.h"

/* The nodes that a patch owns. */
static fg__box nodes_of(const fg__mesh *mesh, const fg__leaf *leaf)
{
  fg__box box = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < mesh->dimension; ++k) {
    box.first[k] = leaf->first[k] * mesh->patch_cells;
    box.nodes[k] = mesh->patch_cells;
    box.nodes[k] += !mesh->periodic[k] && box.first[k] + box.nodes[k] == mesh->cells[k];
  }
  return box;
}

static fg_status set_tiles(fg__mesh *mesh, fg_context *context)
{
  const fg__box *own = fg__own_boxes(&mesh->partition, &mesh->tile_count);
  mesh->tile = fg__allocate((size_t)mesh->tile_count, sizeof *mesh->tile);
  if (!mesh->tile)
    return fg__fail_memory(context, "the tiles",
                           (size_t)mesh->tile_count * sizeof *mesh->tile);
  for (int n = 0; n < mesh->tile_count; ++n) {
    fg__box cells = fg__box_cells(&mesh->partition, &own[n]);
    for (int k = 0; k < 3; ++k) {
      mesh->tile[n].first[k] = cells.first[k];
      mesh->tile[n].cells[k] = cells.nodes[k];
    }
  }
  return FG_STATUS_OK;
}

fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context,
                                const fg__leaf leaf[], int count)
{
  fg_status status = FG_STATUS_OK;
  fg__box *box = fg__allocate((size_t)count, sizeof *box);
  if (!box)
    status = fg__fail_memory(context, "the boxes", (size_t)count * sizeof *box);
  status = fg__ranks_agree(mesh->ranks, context, status);
  if (!status) {
    for (int n = 0; n < count; ++n)
      box[n] = nodes_of(mesh, &leaf[n]);
    count = fg__boxes_merge(box, count);
    status = fg__partition_create(&mesh->partition, context, mesh->ranks, mesh->dimension,
                                  mesh->cells, mesh->periodic, box, count);
  }
  if (!status) {
    status = set_tiles(mesh, context);
    status = fg__ranks_agree(mesh->ranks, context, status);
  }
  free(box);
  return status;
}
