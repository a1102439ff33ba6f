/* Grey values of the same mean and spread all over a picture. */
#ifndef FG__CONTRAST_H
#define FG__CONTRAST_H

#include "texture/raster.h"

/* Replaces the values at the picture's pixels (size[0] x size[1], not padded) by how far
 * they lie from the mean round them, in units of the spread round them, s, which is bent:
 * 1/2 + (3 r - r^3) / 4, r = s / cut, from 0 for -cut and less to 1 for cut and more. Of
 * a bell curve cut at 2 all greys occur about equally often, 4.6 % at the ends. "Round"
 * is a window of about `radius` pixels, which goes round periodic axes. MEMORY. */
fg_status fg__contrast_even(float *value, fg_context *context, const fg__raster *raster,
                            int radius, double cut, fg__threads *threads);

/* That bend, of numbers that are not to be evened. */
static inline float fg__contrast_bend(float r)
{
  r = r < -1.0F ? -1.0F : (r > 1.0F ? 1.0F : r);
  return 0.5F + 0.25F * r * (3.0F - r * r);
}

#endif
