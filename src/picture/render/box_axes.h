/* Numbers round the box of a picture in 3D, and the key of its colours. */
#ifndef FG__BOX_AXES_H
#define FG__BOX_AXES_H

#include <cairo.h>

#include "picture/camera.h"
#include "picture/palette.h"
#include "picture/render/write_text.h"
#include "picture/ticks.h"

/* A number or a name: its box, whose lower left corner is where it is drawn. */
typedef struct fg__box_text {
  fg__pane box;
  const char *text; /* of the axes */
  bool dispensable; /* its axis has other numbers */
  bool shared;      /* so it is where another axis has the same at the corner */
} fg__box_text;

enum { FG__BOX_TEXTS = 3 * (FG__TICK_LIMIT + 1) };

/* Axes with their ticks, which are at least so far apart that their numbers fit. */
typedef struct fg__box_axes {
  fg__tick_axis axis[3];
  fg__ticks ticks[3];
  int edge[3][3];   /* of axis k: the sides, -1 or 1, of the two others on which the edge
                       with the numbers lies; [k][k]: 0 when it is seen too short for any */
  double length[3]; /* of that edge, pixels */
  double em;        /* font size, pixels */
  fg__box_text text[FG__BOX_TEXTS];
  int texts;
} fg__box_axes;

/* Chooses edges of the box's outline: below for x and y, at the left for z. */
void fg__box_axes_of(fg__box_axes *out, const fg_field_arrays *field,
                     const fg__view_box *view_box, const fg__camera *camera, double em,
                     cairo_t *ruler);

/* Leaves an axis its name alone, for which an edge too short for numbers may have room.
 */
void fg__box_axes_bare(fg__box_axes *axes, const fg_field_arrays *field, int axis);

/* Chooses where the numbers and names go: one that would touch another stands farther off
 * the box, and is left out where that does not help. The first or the last of four or
 * more numbers is left out at once, and of three where another axis has the same at the
 * corner.
 * `bounds` grows to hold them. The axes must stay where they are. */
void fg__box_axes_place(fg__box_axes *axes, fg__pane *bounds,
                        const fg__view_box *view_box, const fg__camera *camera,
                        cairo_t *ruler);

void fg__box_axes_draw(const fg__writer *writer, const fg__box_axes *axes,
                       const fg__view_box *view_box, const fg__camera *camera);

/* How wide a colour bar of such a height is, with all that is written at it. */
double fg__color_bar_width(double height, double em, const fg__tick_axis *speed,
                           const fg__bar_label *label, cairo_t *ruler);

/* How far it reaches above its pane at most. */
double fg__color_bar_rise(double em, const fg__bar_label *label);

/* An upright bar at the left of a pane, with numbers at its right and the label above;
 * its end is a point where there are speeds below or above. */
void fg__color_bar_draw(const fg__writer *writer, const fg__pane *pane,
                        const fg__palette *palette, const fg__tick_axis *speed,
                        const fg__bar_label *label, const bool beyond[2]);

#endif
