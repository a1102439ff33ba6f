/* The rows of a field that a part of it reads. */
#include "field/part.h"
#include "read/format.h"

fg__rows fg__rows_of(fg__dealt *dealt, int rows, bool periodic)
{
  if (dealt->count > rows)
    *dealt = (fg__dealt){0, 1};
  fg__rows out;
  fg__part_rows(&out.first, &out.own, rows, dealt->number, dealt->count);
  out.held = fg__part_rows_held(rows, out.first, out.own, periodic && dealt->count > 1);
  return out;
}

fg_status fg__field_of_rows(fg_field **out, fg_context *context,
                            const fg_field_arrays *arrays, float *velocity[3],
                            const fg__dealt *dealt)
{
  return dealt->count == 1 ? fg__field_take(out, context, arrays, velocity)
                           : fg__field_create_part(out, context, arrays, velocity,
                                                   dealt->number, dealt->count);
}
