#include "read/image/image.h"

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
  status = fg__source_close(&source, context, status);
  if (status) {
    fg_image_destroy(*out);
    *out = NULL;
  }
  return status;
}
