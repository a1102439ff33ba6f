/* A density at the pixels of a picture, and the evolution that leads to one. */
#ifndef FG__EVOLVED_H
#define FG__EVOLVED_H

#include "texture/texture.h"

/* Writes u at every pixel, between the density's nodes by cubics. The density must not be
 * shared. MEMORY. */
fg_status fg__density_paint(float *value, fg_context *context, const fg__raster *raster,
                            const fg_density_arrays *density, fg__threads *threads);

#endif
