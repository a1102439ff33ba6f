/* Any bytes as icons in GeoJSON. */
#include "fuzz.h"

#include <assert.h>

#include "read/geojson.h"

bool fg__fuzz_was_read;

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  fg_context *context;
  fg__fuzz_was_read = false;
  if (fg_context_create(&context))
    return 0;
  const fg__source source = {.path = "fuzz.geojson", .bytes = bytes, .size = size};
  fg__icon_list list;
  const fg_status status = fg__icon_list_read(&list, context, &source);
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  fg__fuzz_was_read = status == FG_STATUS_OK;
  fg__icon_list_clear(&list);
  fg_context_destroy(context);
  return 0;
}
