/* VTK XML files as a format. */
#include "decode/vtk/vtk.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "VTK XML",
                                          .is_mine = fg__is_vtk_xml,
                                          .open_chosen = fg__vtk_open,
                                          .alone = "VTK files"};

FG__DATASET_HOOKS(FORMAT)

static fg_status tensors_hook(fg_field *row[2], bool *found, fg_context *context,
                              const fg__source *source)
{
  return fg__dataset_tensors(row, found, context, &FORMAT, source);
}

const fg__format fg__format_vti = {
    .name = "VTK XML",
    .files =
        "VTK XML images, rectilinear, curvilinear and unstructured grids and planes "
        "(.vti, .vtr, .vts, .vtu, .vtp), legacy files of them (.vtk), and files that "
        "name such in parallel, as blocks or over time (.pvti, ..., .vtm, .pvd, .series)",
    .is_mine = fg__is_vtk_xml,
    .inventory = inventory_hook,
    .sphere = sphere_hook,
    .read = read_hook,
    .tensors = tensors_hook};
