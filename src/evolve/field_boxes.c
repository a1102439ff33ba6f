#include "evolve/field_boxes.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* With the cells beside: a law may look half a cell round each centre. */
static fg__region region_of(const fg__tensor_recipe *recipe, const fg__box *box, int rank)
{
  fg__region out = {.nodes = {{0, 0, 0}, {1, 1, 1}}, .rank = rank};
  fg__cells cells = fg__cells_asked(recipe, box);
  for (int k = 0; k < recipe->dimension; ++k) {
    fg__field_points centers = {.origin = cells.origin[k] + 0.5 * cells.spacing[k],
                                .spacing = cells.spacing[k],
                                .first = cells.first[k] - 1,
                                .count = cells.count[k] + 2,
                                .all = fg__domain_count(&cells, k)};
    fg__field_span(&out.nodes.first[k], &out.nodes.nodes[k], recipe->field, k, &centers);
  }
  return out;
}

fg_status fg__field_of_boxes(fg_field ***out, fg_context *context,
                             const fg__tensor_recipe *recipe,
                             const fg__partition *partition)
{
  *out = NULL;
  if (!recipe->field->part)
    return FG_STATUS_OK;
  const fg__ranks *ranks = partition->ranks;
  const int *first = partition->first_of_rank;
  const int own = first[ranks->rank + 1] - first[ranks->rank];
  size_t count = (size_t)partition->count;
  fg__region *region = fg__allocate(count, sizeof *region);
  fg_field **window = fg__allocate(count, sizeof *window);
  fg_field **kept = fg__allocate((size_t)own, sizeof *kept);
  fg_status status = FG_STATUS_OK;
  if (!region || !window || !kept)
    status = fg__fail_memory(context, "windows of the field", count * sizeof *region);
  status = fg__ranks_agree(ranks, context, status);
  for (int r = 0; r < ranks->count && !status; ++r)
    for (int n = first[r]; n < first[r + 1]; ++n)
      region[n] = region_of(recipe, &partition->box[n], r);
  if (!status)
    status = fg__field_windows(window, context, ranks, recipe->field, region,
                               partition->count);
  if (!status) {
    memcpy(kept, window + first[ranks->rank], (size_t)own * sizeof(fg_field *));
    *out = kept;
  } else {
    free(kept);
  }
  free(region);
  free(window);
  return status;
}
