/* GRIB as a format. */
#include "decode/grib/grib.h"

#include "read/dataset.h"

static const fg__dataset_format FORMAT = {
    .name = "GRIB", .is_mine = fg__is_grib, .open = fg__grib_open};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_grib = {.name = "GRIB",
                                    .has_dimensions = true,
                                    .files = "GRIB (editions 1 and 2)",
                                    .is_mine = fg__is_grib,
                                    .inventory = inventory_hook,
                                    .sphere = sphere_hook,
                                    .read = read_hook};
