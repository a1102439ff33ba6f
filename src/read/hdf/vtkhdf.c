/* VTKHDF files as a format. */
#include "decode/hdf/hdf.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "VTKHDF",
                                          .is_mine = fg__is_vtkhdf,
                                          .open_chosen = fg__vtkhdf_open,
                                          .alone = "VTKHDF files"};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_vtkhdf = {
    .name = "VTKHDF",
    .files = "VTKHDF images, unstructured grids and polygons (.vtkhdf, .hdf)",
    .is_mine = fg__is_vtkhdf,
    .inventory = inventory_hook,
    .sphere = sphere_hook,
    .read = read_hook};
