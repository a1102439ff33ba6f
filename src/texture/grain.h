/* White noise that belongs to the picture's pixels. */
#ifndef FG__GRAIN_H
#define FG__GRAIN_H

#include "texture/raster.h"

/* Fills a padded array with noise of mean 0 that is smoothed over one pixel's neighbours,
 * so that what is drawn with it has soft edges. Round a periodic axis it repeats.
 * MEMORY. */
fg_status fg__grain_fill(float *grain, fg_context *context, const fg__raster *raster,
                         uint64_t seed, fg__threads *threads);

#endif
