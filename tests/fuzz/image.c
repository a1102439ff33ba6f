/* Any bytes as an image: what is read has the promised shape. */
#include "fuzz.h"

#include <assert.h>

#include "read/image/image.h"

bool fg__fuzz_was_read;

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  fg_context *context;
  fg_image *image = NULL;
  fg__fuzz_was_read = false;
  if (fg_context_create(&context))
    return 0;
  const fg__source source = {.path = "fuzz.img", .bytes = bytes, .size = size};
  const fg_status status = fg__image_read(&image, context, &source);
  assert((status == FG_STATUS_OK) == (image != NULL));
  assert(status == FG_STATUS_OK || fg_context_message(context)[0]);
  if (image) {
    const fg_image_arrays *a = fg_image_contents(image);
    assert(a->width >= 2 && a->height >= 2 && (a->channels == 1 || a->channels == 3));
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    for (size_t n = 0; n < pixels * (size_t)a->channels; ++n)
      assert(a->sample[n] >= 0.0F && a->sample[n] <= 1.0F);
    for (size_t n = 0; n < pixels && a->alpha; ++n)
      assert(a->alpha[n] >= 0.0F && a->alpha[n] <= 1.0F);
  }
  fg__fuzz_was_read = image != NULL;
  fg_image_destroy(image);
  fg_context_destroy(context);
  return 0;
}
