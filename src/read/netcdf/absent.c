/* In builds without NetCDF: its files are known, and refused. */
#include "base/feature.h"
#include "read/format.h"
#include "read/signature.h"

static bool is_mine(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

static fg_status refuse_to_describe(fg_inventory *inventory, fg_context *context,
                                    const fg__source *source)
{
  (void)inventory;
  return fg__fail_absent(context, source->path, FG_FEATURE_NETCDF);
}

static fg_status refuse_to_read(fg_field **out, fg_context *context,
                                const fg__source *source, const fg_read_options *options,
                                fg__slab_index slab)
{
  (void)options;
  (void)slab;
  *out = NULL;
  return fg__fail_absent(context, source->path, FG_FEATURE_NETCDF);
}

const fg__format fg__format_netcdf = {.name = "NetCDF",
                                      .is_mine = is_mine,
                                      .inventory = refuse_to_describe,
                                      .read = refuse_to_read};
