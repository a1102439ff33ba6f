/* In builds without GRIB: its files are known, and refused. */
#include "decode/signature.h"
#include "read/format.h"

const fg__format fg__format_grib = {.name = "GRIB",
                                    .is_absent = true,
                                    .feature = FG_FEATURE_GRIB,
                                    .is_mine = fg__is_grib};
