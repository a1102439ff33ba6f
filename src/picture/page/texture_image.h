/* A texture's pixels in colour. */
#ifndef FG__TEXTURE_IMAGE_H
#define FG__TEXTURE_IMAGE_H

#include <cairo.h>

#include "flowgrain/texture.h"
#include "picture/palette.h"

/* Makes an image of a texture's size, its first row uppermost; missing pixels have the
 * colour of the nearest others. The style's palette, range of speeds and fade count. End
 * with cairo_surface_destroy. ARGUMENT, MEMORY. */
fg_status fg__texture_image(cairo_surface_t **out, fg_context *context,
                            const fg_texture_arrays *texture,
                            const fg_texture_style *style);

/* The same of the speeds alone in a palette's colours, for what lies behind arrows.
 * range: speeds at the palette's ends. MEMORY. */
fg_status fg__texture_image_speeds(cairo_surface_t **out, fg_context *context,
                                   const fg_texture_arrays *texture,
                                   const fg__palette *palette, const double range[2]);

/* The speeds at the ends of the colour map: the style's, or from 0 to what 99 % of the
 * pixels are slower than. MEMORY. */
fg_status fg__texture_range(double range[2], fg_context *context,
                            const fg_texture_arrays *texture,
                            const fg_texture_style *style);

/* Sets those of *beyond that hold: some pixels are slower, or faster, than the range. */
void fg__texture_beyond(bool beyond[2], const fg_texture_arrays *texture,
                        const double range[2]);

#endif
