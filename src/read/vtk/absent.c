/* In builds without a reader of VTK files: they are known, and refused. */
#include "base/feature.h"
#include "decode/signature.h"
#include "read/vtk/density.h"

const fg__format fg__format_vti = {.name = "VTK XML",
                                   .is_absent = true,
                                   .feature = FG_FEATURE_VTK,
                                   .is_mine = fg__is_vtk_xml};
const fg__format fg__format_vtk_legacy = {.name = "VTK legacy",
                                          .is_absent = true,
                                          .feature = FG_FEATURE_VTK,
                                          .is_mine = fg__is_vtk_legacy};

const fg__format fg__format_vtk_series = {.name = "VTK series",
                                          .is_absent = true,
                                          .feature = FG_FEATURE_VTK,
                                          .is_mine = fg__is_vtk_series};

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
