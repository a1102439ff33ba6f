/* In builds without NetCDF its files are recognised and refused. */
#include "decode/signature.h"
#include "read/format.h"

static bool is_mine(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

const fg__format fg__format_netcdf = {.name = "NetCDF",
                                      .is_absent = true,
                                      .feature = FG_FEATURE_NETCDF,
                                      .is_mine = is_mine};
