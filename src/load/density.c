/* A density that fg_density_write has left. */
#include "read/vtk/density.h"

fg_status fg_density_read(fg_density **out, fg_context *context, const char *path,
                          const fg_field *field)
{
  if (!out || !path || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: a NULL argument");
  *out = NULL;
  fg__source source;
  fg__density_file file = {0};
  fg_status status = fg__source_open(&source, context, path);
  if (!status)
    status = fg__density_file_read(&file, context, &source, fg_field_contents(field));
  status = fg__source_close(&source, context, status);
  if (!status)
    status = fg_density_create_from_arrays(out, context, &file.arrays);
  fg__density_file_clear(&file);
  return status;
}
