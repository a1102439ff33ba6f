/* XDMF files as a format. */
#include "decode/hdf/hdf.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {.name = "XDMF",
                                          .is_mine = fg__is_xdmf,
                                          .open_chosen = fg__xdmf_open,
                                          .alone = "XDMF files"};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_xdmf = {.name = "XDMF",
                                    .files = "XDMF grids and meshes (.xdmf, .xmf)",
                                    .is_mine = fg__is_xdmf,
                                    .inventory = inventory_hook,
                                    .sphere = sphere_hook,
                                    .read = read_hook};
