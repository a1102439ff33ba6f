/* In builds without NetCDF. */
#include "base/feature.h"
#include "write/netcdf/netcdf.h"

fg_status fg__netcdf_write(fg_context *context, const char *path,
                           const fg_field_arrays *field)
{
  (void)field;
  return fg__fail_absent(context, path, FG_FEATURE_NETCDF);
}
