/* Writing fields as NetCDF. */
#ifndef FG__NETCDF_WRITE_H
#define FG__NETCDF_WRITE_H

#include "base/context.h"

/* Writes a field as NetCDF (64-bit offset) under the CF conventions. FILE_ACCESS, MEMORY.
 */
fg_status fg__netcdf_write(fg_context *context, const char *path,
                           const fg_field_arrays *field);

#endif
