#include "mesh/merge.h"

#include <stdlib.h>

#include "base/memory.h"
#include "mesh/closure.h"

/* The nodes of level n that a patch owns: the leaf, or the part of the mesh that begins
 * where the leaf does and has the side of level n. */
static fg__box nodes_of(const fg__mesh *mesh, const fg__leaf *leaf, int level)
{
  fg__box box = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < mesh->dimension; ++k) {
    int cells = mesh->cells[k] >> level;
    box.first[k] = (leaf->first[k] >> level) * mesh->patch_cells;
    box.nodes[k] = mesh->patch_cells;
    box.nodes[k] += !mesh->periodic[k] && box.first[k] + box.nodes[k] == cells;
  }
  return box;
}

static int level_of(const fg__leaf *leaf)
{
  int level = 0;
  while (1 << level < leaf->side)
    ++level;
  return level;
}

/* The level of the largest patch whose first leaf this is. */
static int last_level_of(const fg__mesh *mesh, const fg__leaf *leaf)
{
  int level = level_of(leaf);
  for (; level + 1 < mesh->level_count; ++level)
    for (int k = 0; k < mesh->dimension; ++k)
      if (leaf->first[k] % (2 << level) != 0)
        return level;
  return level;
}

static fg_status create_level(fg__mesh *mesh, fg_context *context, int level,
                              fg__box *box)
{
  int count = 0, cells[3];
  for (int n = 0; n < mesh->leaf_count; ++n)
    if (level_of(&mesh->leaf[n]) <= level && last_level_of(mesh, &mesh->leaf[n]) >= level)
      box[count++] = nodes_of(mesh, &mesh->leaf[n], level);
  count = fg__boxes_merge(box, count);
  for (int k = 0; k < 3; ++k)
    cells[k] = mesh->cells[k] >> (k < mesh->dimension ? level : 0);
  fg_status status =
      fg__partition_create(&mesh->cover[level], context, mesh->ranks, mesh->dimension,
                           cells, mesh->periodic, box, count);
  if (!status)
    status = fg__partition_close(&mesh->level[level], context, &mesh->cover[level]);
  return status;
}

static fg_status set_tiles(fg__mesh *mesh, fg_context *context)
{
  const fg__box *own = fg__own_boxes(&mesh->level[0], &mesh->tile_count);
  mesh->tile = fg__allocate((size_t)mesh->tile_count, sizeof *mesh->tile);
  if (!mesh->tile)
    return fg__fail_memory(context, "the tiles",
                           (size_t)mesh->tile_count * sizeof *mesh->tile);
  for (int n = 0; n < mesh->tile_count; ++n) {
    fg__box cells = fg__box_cells(&mesh->level[0], &own[n]);
    for (int k = 0; k < 3; ++k) {
      mesh->tile[n].first[k] = cells.first[k];
      mesh->tile[n].cells[k] = cells.nodes[k];
    }
  }
  return FG_STATUS_OK;
}

fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context)
{
  fg_status status = FG_STATUS_OK;
  size_t count = (size_t)mesh->kind->leaf_count(mesh->forest);
  mesh->leaf = fg__allocate(count, sizeof *mesh->leaf);
  fg__box *box = fg__allocate(count, sizeof *box);
  if (mesh->leaf && box) {
    mesh->leaf_count = (int)count;
    mesh->kind->leaves(mesh->forest, mesh->leaf);
  } else {
    status = fg__fail_memory(context, "the leaves", count * sizeof *mesh->leaf);
  }
  status = fg__ranks_agree(mesh->ranks, context, status);
  for (int n = 0; !status && n < mesh->level_count; ++n)
    status = create_level(mesh, context, n, box);
  if (!status) {
    status = set_tiles(mesh, context);
    status = fg__ranks_agree(mesh->ranks, context, status);
  }
  free(box);
  return status;
}

fg__leaf_place fg__mesh_place(const fg__mesh *mesh, const fg__leaf *leaf)
{
  fg__leaf_place place = {.level = level_of(leaf)};
  fg__box nodes = nodes_of(mesh, leaf, place.level);
  int count;
  const fg__box *own = fg__own_boxes(&mesh->level[place.level], &count);
  for (; place.box < count; ++place.box) {
    fg__box common = fg__box_intersection(&own[place.box], &nodes);
    if (!fg__box_is_empty(&common))
      break;
  }
  for (int k = 0; k < 3; ++k)
    place.first[k] = nodes.first[k] - own[place.box].first[k];
  return place;
}
