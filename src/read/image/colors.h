/* Colours of image files as screens take them (sRGB), by their ICC profiles. */
#ifndef FG__COLORS_H
#define FG__COLORS_H

#include "base/context.h"

typedef struct fg__colors fg__colors;

/* For pixels of 1 (grey), 3 (red, green, blue) or 4 components (cyan, magenta, yellow and
 * black ink). profile: `size` bytes of an ICC profile; NULL: grey and RGB are sRGB
 * already, and inks absorb light one after the other. *out is NULL where nothing is to be
 * done. `path` goes before messages. FILE_FORMAT (no profile, or of other components),
 * MEMORY. */
fg_status fg__colors_create(fg__colors **out, fg_context *context, const char *path,
                            const void *profile, size_t size, int components);
void fg__colors_destroy(fg__colors *colors);

/* Turns `count` pixels, their components side by side, from 0 to 1 (of inks 1 is most),
 * into one channel for grey, else three. Copies where `colors` is NULL. */
void fg__colors_convert(const fg__colors *colors, float *to, const float *from,
                        size_t count, int components);

#endif
