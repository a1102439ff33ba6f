/* In builds without a reader of VTK files: they are known, and refused. */
#include "base/feature.h"
#include "read/signature.h"
#include "read/vtk/density.h"

static fg_status refuse_to_describe(fg_inventory *inventory, fg_context *context,
                                    const fg__source *source)
{
  (void)inventory;
  return fg__fail_absent(context, source->path, FG_FEATURE_VTK);
}

static fg_status refuse_to_read(fg_field **out, fg_context *context,
                                const fg__source *source, const fg_read_options *options,
                                fg__slab_index slab)
{
  (void)options;
  (void)slab;
  *out = NULL;
  return fg__fail_absent(context, source->path, FG_FEATURE_VTK);
}

static fg_status refuse_tensors(fg_field *row[2], bool *found, fg_context *context,
                                const fg__source *source)
{
  (void)row;
  *found = false;
  return fg__fail_absent(context, source->path, FG_FEATURE_VTK);
}

const fg__format fg__format_vti = {.name = "VTK XML",
                                   .is_mine = fg__is_vtk_xml,
                                   .inventory = refuse_to_describe,
                                   .read = refuse_to_read,
                                   .tensors = refuse_tensors};
const fg__format fg__format_vtk_legacy = {.name = "VTK legacy",
                                          .is_mine = fg__is_vtk_legacy,
                                          .inventory = refuse_to_describe,
                                          .read = refuse_to_read,
                                          .tensors = refuse_tensors};

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
