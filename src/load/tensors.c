/* Tensors of a file as an energy's law. */
#include "flowgrain/energy.h"

#include "read/tensor_rows.h"
#include "tensor/tensor_field.h"

fg_status fg_tensors_read(fg_tensors **out, fg_context *context, const char *path,
                          const fg_field *field)
{
  if (!out || !path || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "tensors: a NULL argument");
  *out = NULL;
  fg_field *row[2];
  fg_status status =
      fg__tensor_rows_read(row, context, path, fg_field_contents(field)->dimension);
  return status ? status : fg__tensors_create(out, context, row, path, field);
}
