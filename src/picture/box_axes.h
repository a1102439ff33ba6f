/* Numbers round the box of a picture in 3D, and the key of its colours. */
#ifndef FG__BOX_AXES_H
#define FG__BOX_AXES_H

#include <cairo.h>

#include "picture/palette.h"
#include "picture/stage.h"
#include "picture/ticks.h"

/* Axes with their ticks, which are at least so far apart that their numbers fit. */
typedef struct fg__box_axes {
  fg__axis axis[3];
  fg__ticks ticks[3];
  int edge[3][3]; /* of axis k: the sides, -1 or 1, of the two others on which the edge
                     with the numbers lies; [k][k]: 0 when it is seen too short for any */
  double em;      /* font size, pixels */
} fg__box_axes;

/* Chooses edges of the box's outline: below for x and y, at the left for z. */
void fg__box_axes_of(fg__box_axes *out, const fg_field_arrays *field,
                     const fg__stage *stage, const fg__camera *camera, double em,
                     cairo_t *ruler);

/* Returns how low the numbers and names reach, in pixels from above. */
double fg__box_axes_draw(cairo_t *cairo, const fg__box_axes *axes, const fg__stage *stage,
                         const fg__camera *camera);

/* An upright bar in a pane, with numbers at its right and the speed's name above; its end
 * is a point where there are speeds below or above. */
void fg__color_bar_draw(cairo_t *cairo, const fg__pane *pane, double em,
                        const fg__palette *palette, const fg__axis *speed,
                        const bool beyond[2]);

#endif
