#include "field/image.h"

#include <stdlib.h>

#include "base/memory.h"

fg_status fg__image_begin(fg_image **out, fg_context *context, const char *name,
                          size_t width, size_t height, int channels, bool has_alpha)
{
  *out = NULL;
  if (width < 2 || height < 2)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %zu x %zu pixels; at least 2 x 2 are needed", name, width,
                    height);
  if (width > FG__MOST_PIXELS || height > FG__MOST_PIXELS / width)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu x %zu pixels; at most %d are taken", name, width, height,
                    FG__MOST_PIXELS);
  size_t count = width * height;
  fg_image *image = fg__allocate(1, sizeof *image);
  if (image) {
    image->sample = fg__allocate(count, (size_t)channels * sizeof *image->sample);
    image->alpha = has_alpha ? fg__allocate(count, sizeof *image->alpha) : NULL;
  }
  if (!image || !image->sample || (has_alpha && !image->alpha)) {
    fg_image_destroy(image);
    return fg__fail_memory(context, "an image", count * sizeof(float) * 4);
  }
  image->contents = (fg_image_arrays){.width = (int)width,
                                      .height = (int)height,
                                      .channels = channels,
                                      .sample = image->sample,
                                      .alpha = image->alpha};
  *out = image;
  return FG_STATUS_OK;
}

static bool copy_values(float *to, const float *from, size_t count)
{
  for (size_t n = 0; n < count; ++n) {
    if (!(from[n] >= 0.0F && from[n] <= 1.0F))
      return false;
    to[n] = from[n];
  }
  return true;
}

fg_status fg_image_create(fg_image **out, fg_context *context,
                          const fg_image_arrays *arrays)
{
  if (!out || !arrays || !arrays->sample)
    return fg__fail(context, FG_STATUS_ARGUMENT, "image: a NULL argument");
  *out = NULL;
  if (arrays->channels != 1 && arrays->channels != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "image: %d channels; 1 or 3 are needed",
                    arrays->channels);
  if (arrays->width < 0 || arrays->height < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "image: %d x %d pixels; at least 2 x 2 are needed", arrays->width,
                    arrays->height);
  fg_image *image;
  fg_status status =
      fg__image_begin(&image, context, "image", (size_t)arrays->width,
                      (size_t)arrays->height, arrays->channels, arrays->alpha != NULL);
  if (status)
    return status;
  size_t count = (size_t)arrays->width * (size_t)arrays->height;
  if (!copy_values(image->sample, arrays->sample, count * (size_t)arrays->channels) ||
      (arrays->alpha && !copy_values(image->alpha, arrays->alpha, count))) {
    fg_image_destroy(image);
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "image: a sample or an alpha is outside 0 to 1");
  }
  *out = image;
  return FG_STATUS_OK;
}

void fg_image_destroy(fg_image *image)
{
  if (!image)
    return;
  free(image->sample);
  free(image->alpha);
  free(image);
}

const fg_image_arrays *fg_image_contents(const fg_image *image)
{
  return &image->contents;
}
