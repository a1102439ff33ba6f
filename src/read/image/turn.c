#include <stdlib.h>

#include "base/memory.h"
#include "read/image/image.h"

/* Where a pixel of the upright image lies in the stored one. */
static size_t stored_at(const fg_image_arrays *stored, int orientation, int i, int j)
{
  /* 5 to 8 have rows and columns exchanged */
  int x = orientation >= 5 ? j : i, y = orientation >= 5 ? i : j;
  bool from_right =
      orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  bool from_below =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  x = from_right ? stored->width - 1 - x : x;
  y = from_below ? stored->height - 1 - y : y;
  return (size_t)y * (size_t)stored->width + (size_t)x;
}

fg_status fg__image_turn(fg_image **image, fg_context *context, const char *name,
                         int orientation)
{
  const fg_image *stored = *image;
  const fg_image_arrays *a = &stored->contents;
  if (orientation <= 1 || orientation > 8)
    return FG_STATUS_OK;
  bool exchanged = orientation >= 5;
  fg_image *upright;
  fg_status status = fg__image_begin(
      &upright, context, name, (size_t)(exchanged ? a->height : a->width),
      (size_t)(exchanged ? a->width : a->height), a->channels, a->alpha != NULL);
  if (status)
    return status;
  size_t channels = (size_t)a->channels, to = 0;
  for (int j = 0; j < upright->contents.height; ++j)
    for (int i = 0; i < upright->contents.width; ++i, ++to) {
      size_t from = stored_at(a, orientation, i, j);
      for (size_t k = 0; k < channels; ++k)
        upright->sample[to * channels + k] = stored->sample[from * channels + k];
      if (a->alpha)
        upright->alpha[to] = stored->alpha[from];
    }
  fg_image_destroy(*image);
  *image = upright;
  return FG_STATUS_OK;
}
