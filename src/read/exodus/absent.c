/* In builds without NetCDF: Exodus files are NetCDF files like others. */
#include "read/format.h"

static bool is_mine(const unsigned char *bytes, size_t size)
{
  (void)bytes;
  (void)size;
  return false;
}

const fg__format fg__format_exodus = {.name = "Exodus",
                                      .is_absent = true,
                                      .feature = FG_FEATURE_NETCDF,
                                      .is_mine = is_mine};
