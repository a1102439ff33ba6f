/* Any bytes as a table in text, or as NumPy's arrays. */
#include "fuzz.h"

#include "fields.h"

bool fg__fuzz_was_read;

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  fg__fuzz_was_read = try_format(&fg__format_npy, "fuzz.npy", bytes, size) ||
                      try_format(&fg__format_npz, "fuzz.npz", bytes, size) ||
                      try_format(&fg__format_table, "fuzz.txt", bytes, size);
  return 0;
}
