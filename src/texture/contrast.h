/* Grey values of the same mean and spread all over a picture. */
#ifndef FG__CONTRAST_H
#define FG__CONTRAST_H

#include "texture/raster.h"

/* Replaces the values at the picture's pixels (size[0] x size[1], not padded) by how far
 * they lie from the mean round them, in units of the spread round them, and brings that
 * to 0 ... 1, so that greys occur about equally often. "Round" is a window of about
 * `radius` pixels, which goes round periodic axes. MEMORY. */
fg_status fg__contrast_even(float *value, fg_context *context, const fg__raster *raster,
                            int radius, fg__team *team);

#endif
