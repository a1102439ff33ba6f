/* In builds without GRIB: its files are known, and refused. */
#include "read/format.h"
#include "read/signature.h"

const fg__format fg__format_grib = {.name = "GRIB",
                                    .is_absent = true,
                                    .feature = FG_FEATURE_GRIB,
                                    .is_mine = fg__is_grib};
