#include "read/image/image.h"

static const fg__image_format *const formats[] = {&fg__image_png, &fg__image_jpeg,
                                                  &fg__image_pnm};

fg_status fg__image_read(fg_image **out, fg_context *context, const fg__source *source)
{
  *out = NULL;
  for (size_t k = 0; k < sizeof formats / sizeof formats[0]; ++k)
    if (formats[k]->is_mine(source->bytes, source->size))
      return formats[k]->read(out, context, source);
  return fg__fail(context, FG_STATUS_UNSUPPORTED,
                  "%s: is no image that can be read: PNG, JPEG, PGM and PPM can",
                  source->path);
}
