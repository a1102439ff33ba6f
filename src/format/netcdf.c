#include "format/format.h"

#include <string.h>

static bool is_netcdf(const unsigned char *bytes, size_t size)
{
  return size >= 4 && memcmp(bytes, "CDF", 3) == 0;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  (void)inventory;
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: NetCDF is not read yet",
                  source->path);
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options)
{
  (void)out;
  (void)options;
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: NetCDF is not read yet",
                  source->path);
}

const fg__format fg__format_netcdf = { "NetCDF", is_netcdf, describe, read_field };
