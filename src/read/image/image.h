/* Readers of images: one file a format, one line in the list of image.c. */
#ifndef FG__READ_IMAGE_H
#define FG__READ_IMAGE_H

#include "field/image.h"
#include "read/format.h"

typedef struct fg__image_format {
  const char *name;
  bool (*is_mine)(const unsigned char *bytes, size_t size);
  /* From bytes alone. FILE_FORMAT, UNSUPPORTED, MEMORY. */
  fg_status (*read)(fg_image **out, fg_context *context, const fg__source *source);
} fg__image_format;

extern const fg__image_format fg__image_png;
extern const fg__image_format fg__image_jpeg;
extern const fg__image_format fg__image_pnm;

/* Reads whatever image the source holds. FILE_FORMAT, UNSUPPORTED, MEMORY. */
fg_status fg__image_read(fg_image **out, fg_context *context, const fg__source *source);

/* Puts an image upright that is stored in one of the eight orientations of Exif (CIPA
 * DC-008): 1 as it is to be seen, 3 upside down, 6 to be turned clockwise, 8 the other
 * way, 2, 4, 5, 7 mirrored. On failure the image stays. MEMORY. */
fg_status fg__image_turn(fg_image **image, fg_context *context, const char *name,
                         int orientation);

#endif
