/* In builds without GRIB: its files are known, and refused. */
#include "base/feature.h"
#include "read/format.h"
#include "read/signature.h"

static fg_status refuse_to_describe(fg_inventory *inventory, fg_context *context,
                                    const fg__source *source)
{
  (void)inventory;
  return fg__fail_absent(context, source->path, FG_FEATURE_GRIB);
}

static fg_status refuse_to_read(fg_field **out, fg_context *context,
                                const fg__source *source, const fg_read_options *options,
                                fg__slab_index slab)
{
  (void)options;
  (void)slab;
  *out = NULL;
  return fg__fail_absent(context, source->path, FG_FEATURE_GRIB);
}

const fg__format fg__format_grib = {.name = "GRIB",
                                    .is_mine = fg__is_grib,
                                    .inventory = refuse_to_describe,
                                    .read = refuse_to_read};
