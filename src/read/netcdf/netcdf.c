/* NetCDF as a format. */
#include "decode/netcdf/netcdf.h"

#include "read/dataset.h"

static bool is_netcdf(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

static const fg__dataset_format FORMAT = {
    .name = "NetCDF", .is_mine = is_netcdf, .open = fg__nc_open};

FG__DATASET_HOOKS(FORMAT)

const fg__format fg__format_netcdf = {
    .name = "NetCDF",
    .has_dimensions = true,
    .files = "NetCDF (classic, 64-bit offset, CDF-5, NetCDF-4)",
    .is_mine = is_netcdf,
    .inventory = inventory_hook,
    .sphere = sphere_hook,
    .read = read_hook};
