/* Any bytes as a NetCDF file, classic or NetCDF-4, and as one of Exodus or VTKHDF. */
#include "fuzz.h"

#include "fields.h"

bool fg__fuzz_was_read;

/* The same with a sample of a dimension chosen, by names that the corpus has. */
static void choose_sample(const uint8_t *bytes, size_t size)
{
  static const char *const samples[] = {"member=1", "member=7.", "x=1", "nCells=2,y=0"};
  fg_context *context;
  if (!fg__format_netcdf.is_mine(bytes, size) || fg_context_create(&context))
    return;
  const fg__source source = {.path = "fuzz.nc", .bytes = bytes, .size = size};
  const fg_read_options options = {.at = samples[size % 4]};
  read_part(&fg__format_netcdf, context, &source, &options, (fg__slab_index){0, 1});
  fg_context_destroy(context);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  const bool exodus = try_format(&fg__format_exodus, "fuzz.exo", bytes, size);
  const bool vtkhdf = try_format(&fg__format_vtkhdf, "fuzz.vtkhdf", bytes, size);
  fg__fuzz_was_read =
      try_format(&fg__format_netcdf, "fuzz.nc", bytes, size) || exodus || vtkhdf;
  choose_sample(bytes, size);
  return 0;
}
