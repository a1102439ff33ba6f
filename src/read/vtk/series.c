/* Lists of VTK files over time as a format. */
#include "decode/vtk/vtk.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "VTK series",
                                          .is_mine = fg__is_vtk_series,
                                          .open_chosen = fg__vtk_open,
                                          .alone = "VTK files"};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_vtk_series = {.name = "VTK series",
                                          .is_mine = fg__is_vtk_series,
                                          .inventory = inventory_hook,
                                          .sphere = sphere_hook,
                                          .read = read_hook};
