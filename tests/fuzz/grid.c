/* Any bytes as a VTK file, XML or legacy, and as XDMF. */
#include "fuzz.h"

#include "fields.h"

bool fg__fuzz_was_read;

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  fg__fuzz_was_read = try_format(&fg__format_vti, "fuzz.vtk", bytes, size) ||
                      try_format(&fg__format_vtk_legacy, "fuzz.vtk", bytes, size) ||
                      try_format(&fg__format_xdmf, "fuzz.xdmf", bytes, size);
  return 0;
}
