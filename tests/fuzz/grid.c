/* Any bytes as a VTK file, XML or legacy: libFuzzer's target. What is described can be
 * told, and what is read has the promised shape. */
#include <assert.h>

#include "read/format.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void describe(const fg__format *format, fg_context *context,
                     const fg__source *source)
{
  fg_inventory *inventory = NULL;
  if (fg__inventory_create(&inventory, context, format->name))
    return;
  const fg_status status = format->inventory(inventory, context, source);
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  fg_inventory_destroy(inventory);
  fg_context_clear(context);
}

static void read_part(const fg__format *format, fg_context *context,
                      const fg__source *source, fg__dealt dealt)
{
  static const fg_read_options options = {0};
  fg_field *field = NULL;
  const fg_status status = format->read(&field, context, source, &options, dealt);
  assert((status == FG_STATUS_OK) == (field != NULL));
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  if (field) {
    const fg_field_arrays *a = fg_field_contents(field);
    assert(a->dimension == 2 || a->dimension == 3);
    for (int k = 0; k < a->dimension; ++k)
      for (int i = 1; i < a->size[k]; ++i)
        assert(a->axis[k][i - 1] < a->axis[k][i]);
  }
  fg_field_destroy(field);
  fg_context_clear(context);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  static const fg__format *const formats[] = {&fg__format_vti, &fg__format_vtk_legacy};
  fg_context *context;
  if (fg_context_create(&context))
    return 0;
  const fg__source source = {.path = "fuzz.vtk", .bytes = bytes, .size = size};
  for (size_t n = 0; n < sizeof formats / sizeof formats[0]; ++n)
    if (formats[n]->is_mine(bytes, size)) {
      describe(formats[n], context, &source);
      read_part(formats[n], context, &source, (fg__dealt){0, 1});
      read_part(formats[n], context, &source, (fg__dealt){1, 3});
    }
  fg_context_destroy(context);
  return 0;
}
