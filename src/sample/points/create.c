/* A field of a caller's arrays of points. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "sample/points/points.h"

static fg_status check(fg_context *context, const fg_field_arrays *points)
{
  if (points->dimension != 2 && points->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: %d dimensions; 2 or 3 are known",
                    points->dimension);
  if (points->size[0] < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: %d points", points->size[0]);
  for (int k = 0; k < points->dimension && k < 3; ++k)
    if (!points->axis[k] || !points->velocity[k])
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: its points have no coordinate or component along %c",
                      "xyz"[k]);
  return FG_STATUS_OK;
}

static fg_status copy(fg__scatter *out, const fg_field_arrays *points)
{
  for (int k = 0; k < out->dimension && k < 3; ++k) {
    out->position[k] = fg__allocate(out->count, sizeof *out->position[k]);
    out->velocity[k] = fg__allocate(out->count, sizeof *out->velocity[k]);
    if (!out->position[k] || !out->velocity[k])
      return fg__fail_memory(out->context, "points",
                             out->count * (sizeof(double) + sizeof(float)));
    memcpy(out->position[k], points->axis[k], out->count * sizeof(double));
    memcpy(out->velocity[k], points->velocity[k], out->count * sizeof(float));
    for (size_t i = 0; i < out->count && points->valid; ++i)
      if (!points->valid[i])
        out->velocity[k][i] = NAN;
  }
  return FG_STATUS_OK;
}

fg_status fg_field_create_scattered(fg_field **out, fg_context *context,
                                    const fg_field_arrays *points)
{
  if (out)
    *out = NULL;
  if (!out || !points)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: no points to make it from");
  fg_status status = check(context, points);
  if (status != FG_STATUS_OK)
    return status;
  fg__scatter scatter = {.context = context,
                         .path = "field",
                         .count = (size_t)points->size[0],
                         .dimension = points->dimension,
                         .records = "point",
                         .geographic = points->scale == FG_SCALE_GEO};
  fg__scatter_between between;
  fg_field_arrays words = *points;
  words.valid = NULL;
  memset(words.period, 0, sizeof words.period);
  status = copy(&scatter, points);
  if (status == FG_STATUS_OK)
    status = fg__scatter_field(out, &between, &scatter, &words, (fg__slab_index){0, 1});
  fg__scatter_clear(&scatter);
  return status == FG_STATUS_FILE_FORMAT ? FG_STATUS_ARGUMENT : status;
}
