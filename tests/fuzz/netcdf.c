/* Any bytes as a NetCDF file, classic or NetCDF-4, and as one of Exodus. */
#include "fuzz.h"

#include "fields.h"

bool fg__fuzz_was_read;

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  const bool exodus = try_format(&fg__format_exodus, "fuzz.exo", bytes, size);
  fg__fuzz_was_read = try_format(&fg__format_netcdf, "fuzz.nc", bytes, size) || exodus;
  return 0;
}
