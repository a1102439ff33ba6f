/* What formats share: rows of a field that a slab of it reads, samples, options. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/slab.h"
#include "sample/rows.h"

fg__rows fg__rows_of(fg__slab_index *slab, int rows, bool periodic)
{
  if (slab->count > rows)
    *slab = (fg__slab_index){0, 1};
  fg__rows out;
  fg__slab_rows(&out.first, &out.own, rows, slab->number, slab->count);
  out.held = fg__slab_rows_held(rows, out.first, out.own, periodic && slab->count > 1);
  return out;
}

fg_status fg__field_of_rows(fg_field **out, fg_context *context,
                            const fg_field_arrays *arrays, float *velocity[3],
                            const fg__slab_index *slab)
{
  return slab->count == 1 ? fg__field_take(out, context, arrays, velocity)
                          : fg__field_create_slab(out, context, arrays, velocity,
                                                  slab->number, slab->count);
}

fg_status fg__field_slab_of(fg_field **out, fg_context *context, const fg_field *whole,
                            fg__slab_index slab)
{
  fg_field_arrays arrays = *fg_field_contents(whole);
  const int last = arrays.dimension - 1, all = arrays.size[last];
  const bool periodic = arrays.period[last] > 0.0;
  const fg__rows rows = fg__rows_of(&slab, all, periodic);
  if (slab.count == 1)
    return fg_field_create(out, context, &arrays);
  const size_t row = fg__field_held(whole) / (size_t)all;
  float *velocity[3] = {NULL, NULL, NULL};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < arrays.dimension && status == FG_STATUS_OK; ++k) {
    velocity[k] = fg__allocate(row * (size_t)rows.held, sizeof(float));
    if (!velocity[k])
      status = fg__fail_memory(context, "rows of a field",
                               row * (size_t)rows.held * sizeof(float));
    for (int j = 0; j < rows.held && velocity[k]; ++j)
      memcpy(velocity[k] + (size_t)j * row,
             arrays.velocity[k] + (size_t)((rows.first + j) % all) * row,
             row * sizeof(float));
    arrays.velocity[k] = velocity[k];
  }
  arrays.valid = NULL;
  if (status == FG_STATUS_OK)
    status = fg__field_of_rows(out, context, &arrays, velocity, &slab);
  for (int k = 0; k < 3; ++k)
    free(velocity[k]);
  return status;
}

float fg__as_velocity(double number)
{
  if (!isinf(number) && fabs(number) > (double)FLT_MAX)
    return number > 0.0 ? FLT_MAX : -FLT_MAX;
  return (float)number;
}
