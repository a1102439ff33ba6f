/* In builds without a reader of images. */
#include "base/feature.h"
#include "flowgrain/brush.h"

fg_status fg_image_read(fg_image **out, fg_context *context, const char *path)
{
  if (!out || !path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "image: a NULL argument");
  *out = NULL;
  return fg__fail_absent(context, path, FG_FEATURE_IMAGES);
}
