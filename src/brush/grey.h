/* Grey values of an image, and blurred copies of it, for strokes. */
#ifndef FG__GREY_H
#define FG__GREY_H

#include "base/context.h"
#include "flowgrain/brush.h"

/* The grey values (luma of Rec. 709, on white where the image is transparent), rows from
 * the top. To be freed; NULL without memory. */
float *fg__image_grey(const fg_image_arrays *image);

/* Averages rows and columns of a plane over a Gaussian of standard deviation `width` in
 * pixels, in place; beyond the boundary the plane is mirrored. False without memory. */
bool fg__image_blur(float *plane, int width, int height, double deviation);

#endif
