/* Legacy VTK files as a format. */
#include "decode/vtk/vtk.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "VTK legacy",
                                          .is_mine = fg__is_vtk_legacy,
                                          .open_chosen = fg__vtk_open_legacy,
                                          .alone = "VTK files"};

FG__DATASET_HOOKS(FORMAT)

static fg_status tensors_hook(fg_field *row[2], bool *found, fg_context *context,
                              const fg__source *source)
{
  return fg__dataset_tensors(row, found, context, &FORMAT, source);
}

const fg__format fg__format_vtk_legacy = {.name = "VTK legacy",
                                          .is_mine = fg__is_vtk_legacy,
                                          .inventory = inventory_hook,
                                          .sphere = sphere_hook,
                                          .read = read_hook,
                                          .tensors = tensors_hook};
