/* Arrows in a box, rendered: triangles are sorted into bands of rows, and in each band
 * the nearest is found at the middle of each pixel and, where the picture is uneven, at
 * 16 points of it. */
#ifndef FG__RENDER_H
#define FG__RENDER_H

#include <stdint.h>

#include "picture/camera.h"
#include "picture/palette.h"

typedef struct fg__rendering {
  int width, height; /* pixels */
  fg__view_box view_box;
  fg__camera camera;
  const fg_icons *icons;
  const fg_field *field; /* where an arrow's colour follows the speed; NULL: each has the
                            colour of its mean */
  const fg__palette *palette;
  double range[2];              /* speeds at the ends of the palette */
  const fg_surface *surface;    /* transparent; NULL: none */
  const fg_surface *silhouette; /* almost seen as an outline alone; NULL: none */
  bool walls;                   /* the box: its sides behind the arrows, and its edges */
  double halo;                  /* of white round each arrow, pixels; 0: none */
  double least_head;            /* heads are no shorter in the box's middle, pixels */
  bool transparent;             /* nothing behind arrows and walls; else white */
  int threads;                  /* at least 1 */
} fg__rendering;

/* Fills an image of rows of `stride` pixels, premultiplied ARGB as Cairo has it. A pixel
 * depends on nothing but its place: any number of threads gives the same. MEMORY,
 * STOPPED. */
fg_status fg__render(fg_context *context, const fg__rendering *rendering, uint32_t *image,
                     int stride);

#endif
