/* In builds without a reader of VTK files. */
#include "base/feature.h"
#include "read/vtk/density.h"

fg_status fg__density_file_read(fg__density_file *out, fg_context *context,
                                const fg__source *source, const fg_field_arrays *field)
{
  (void)field;
  *out = (fg__density_file){0};
  return fg__fail_absent(context, source->path, FG_FEATURE_VTK);
}

void fg__density_file_clear(fg__density_file *file)
{
  *file = (fg__density_file){0};
}
