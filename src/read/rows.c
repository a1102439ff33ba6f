/* The rows of a field that a slab of it reads. */
#include "field/slab.h"
#include "read/format.h"

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
