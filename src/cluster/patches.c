#include <stdlib.h>

#include "base/memory.h"
#include "cluster/patches.h"

enum { KINDS = 3 };

/* A patch's cells, or its nodes; cells end one before the nodes unless the patch goes
 * round. */
static fg__region region_of(const fg__wanted_patch *wanted,
                            const fg_density_arrays *density, bool cells)
{
  fg__region out = {.nodes = {{0, 0, 0}, {1, 1, 1}}, .rank = wanted->rank};
  for (int k = 0; k < density->dimension; ++k) {
    int nodes = wanted->patch.nodes[k];
    bool round = density->periodic[k] && nodes == density->nodes[k];
    out.nodes.first[k] = wanted->patch.first[k];
    out.nodes.nodes[k] = nodes - (cells && !round);
  }
  return out;
}

static bool allocate(fg__patch *patch, void *array[KINDS], const fg__region *nodes,
                     const fg__region *cells, bool masked)
{
  size_t count = (size_t)fg__box_count(&nodes->nodes);
  float *u = fg__allocate(count, sizeof *u);
  int *label = fg__allocate(count, sizeof *label);
  unsigned char *active =
      masked ? fg__allocate((size_t)fg__box_count(&cells->nodes), 1) : NULL;
  array[FG__DENSITY_U] = u;
  array[FG__DENSITY_LABEL] = label;
  array[FG__DENSITY_ACTIVE] = active;
  patch->u = u;
  patch->label = label;
  patch->active = active;
  patch->owned = true;
  return u && label && (active || !masked);
}

static fg_status fill(fg_context *context, const fg_density *density,
                      fg__wanted_patch *wanted, int count)
{
  const fg_density_arrays *arrays = fg_density_contents(density);
  const fg__density_block *block = fg__density_block_of(density);
  const fg__ranks *ranks = block->partition.ranks;
  size_t all = (size_t)count;
  fg__region *region = fg__allocate(2 * all, sizeof *region);
  void **array = fg__allocate(KINDS * all, sizeof *array);
  bool whole = region && array;
  for (int n = 0; n < count && whole; ++n) {
    region[n] = region_of(&wanted[n], arrays, false);
    region[count + n] = region_of(&wanted[n], arrays, true);
    void *own[KINDS] = {0};
    if (wanted[n].rank == ranks->rank)
      whole =
          allocate(&wanted[n].patch, own, &region[n], &region[count + n], block->masked);
    for (size_t kind = 0; kind < KINDS; ++kind)
      array[kind * all + (size_t)n] = own[kind];
  }
  fg_status status = FG_STATUS_OK;
  if (!whole)
    status = fg__fail_memory(context, "clusters' windows", all * sizeof *region);
  status = fg__ranks_agree(ranks, context, status);
  for (size_t kind = 0; kind < KINDS && !status; ++kind)
    if (kind != FG__DENSITY_ACTIVE || block->masked)
      status = fg__density_fill(density, context, (fg__density_kind)kind,
                                region + (kind == FG__DENSITY_ACTIVE ? count : 0), count,
                                array + kind * all);
  for (int n = 0; n < count && status; ++n)
    fg__patch_clear(&wanted[n].patch);
  free(region);
  free(array);
  return status;
}

fg_status fg__patches_fill(fg_context *context, const fg_density *density,
                           fg__wanted_patch *wanted, int count)
{
  if (fg_density_is_distributed(density))
    return fill(context, density, wanted, count);
  const fg__labels labels = {.label = fg__density_block_of(density)->label};
  for (int n = 0; n < count; ++n)
    wanted[n].patch = fg__patch_of(fg_density_contents(density), &labels);
  return FG_STATUS_OK;
}

void fg__patch_clear(fg__patch *patch)
{
  if (patch->owned) {
    free((void *)(uintptr_t)patch->u);
    free((void *)(uintptr_t)patch->label);
    free((void *)(uintptr_t)patch->active);
  }
  patch->u = NULL;
  patch->label = NULL;
  patch->active = NULL;
}
