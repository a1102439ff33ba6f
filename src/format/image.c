#include "format/image.h"

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

fg_status fg_image_read(fg_image **out, fg_context *context, const char *path)
{
  if (!out || !path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "image: a NULL argument");
  *out = NULL;
  fg__source source;
  fg_status status = fg__source_open(&source, context, path);
  if (status)
    return status;
  status = fg__image_read(out, context, &source);
  fg__source_close(&source);
  return status;
}
