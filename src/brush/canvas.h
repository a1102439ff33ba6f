/* Colours by pixel: of an image that is copied, and of the painting so far. */
#ifndef FG__CANVAS_H
#define FG__CANVAS_H

#include "brush/grey.h"

/* Three planes, red, green and blue, rows from the top. */
typedef struct fg__brush_canvas {
  int width, height;
  float *plane[3];
  unsigned char *painted; /* a byte a pixel; NULL: of an image */
} fg__brush_canvas;

/* An image averaged over a Gaussian of that standard deviation in pixels, its pixels
 * weighted by their alpha. MEMORY. */
fg_status fg__canvas_of_image(fg__brush_canvas *out, fg_context *context,
                              const fg_image_arrays *image, double deviation);

/* One colour all over: the mean of the image. MEMORY. */
fg_status fg__canvas_blank(fg__brush_canvas *out, fg_context *context,
                           const fg_image_arrays *image);
void fg__canvas_clear(fg__brush_canvas *canvas);

/* The colour at a point in pixels from the upper left corner, bilinear. */
void fg__canvas_color(double color[3], const fg__brush_canvas *canvas,
                      const double at[2]);

/* Paints a disc. */
void fg__canvas_dab(fg__brush_canvas *canvas, const double at[2], double radius,
                    const double color[3]);

/* Whether the pixel at a point, if there is one, has not been painted. */
bool fg__canvas_is_bare(const fg__brush_canvas *canvas, const double at[2]);

/* The mean colour of an image, its pixels weighted by their alpha. */
void fg__image_mean(double color[3], const fg_image_arrays *image);

#endif
