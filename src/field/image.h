/* An image's own representation: samples of grey or colours, as a field has samples of
 * vectors. */
#ifndef FG__IMAGE_H
#define FG__IMAGE_H

#include "base/context.h"
#include "flowgrain/brush.h"

struct fg_image {
  fg_image_arrays contents;
  float *sample, *alpha; /* owned; alpha may be NULL */
};

/* More pixels are refused before memory is allocated: 2^26 are 67 million. */
enum { FG__MOST_PIXELS = 1 << 26 };

/* Makes an image whose arrays are to be filled, opaque unless `has_alpha`. `name` goes
 * before messages. ARGUMENT (fewer than 2 pixels a side, too many in all), MEMORY. */
fg_status fg__image_begin(fg_image **out, fg_context *context, const char *name,
                          size_t width, size_t height, int channels, bool has_alpha);

#endif
