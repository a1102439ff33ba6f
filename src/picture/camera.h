/* The box of a field in 3D and the camera that looks at it. */
#ifndef FG__CAMERA_H
#define FG__CAMERA_H

#include "base/context.h"

/* The field's box: input coordinates are moved and scaled so that its middle is 0 and its
 * longest side 1. */
typedef struct fg__view_box {
  double low[3], high[3]; /* input coordinates */
  double middle[3], scale;
  double half[3];   /* of the sides, in the view box */
  double period[3]; /* in the view box; 0: none */
} fg__view_box;

void fg__view_box_of(fg__view_box *out, const fg_field_arrays *field);

/* Where an input coordinate lies in the view box. */
static inline double fg__view_box_place(const fg__view_box *view_box, int axis,
                                        double coordinate)
{
  return (coordinate - view_box->middle[axis]) * view_box->scale;
}

/* Pixels, from the picture's upper left corner. */
typedef struct fg__pane {
  double x0, y0, x1, y1;
} fg__pane;

/* A viewer at some distance, looking at the middle: a central projection. */
typedef struct fg__camera {
  double eye[3], right[3], up[3], forward[3];
  double factor, x, y; /* pixels: x + factor * (right / forward), y - ... */
} fg__camera;

/* Places the viewer `azimuth` degrees counter-clockwise from the front (the side of least
 * y) and `elevation` above the horizon, and fits the box into a pane. */
void fg__camera_look(fg__camera *out, const fg__view_box *view_box, double azimuth,
                     double elevation, const fg__pane *pane);

/* Pixel of a point in the view box. */
void fg__camera_project(const fg__camera *camera, const double point[3], double pixel[2]);

/* Unit direction of the ray through a pixel. */
void fg__camera_ray(const fg__camera *camera, double x, double y, double direction[3]);

/* Whether the viewer sees the inside of the box's side at half[axis] * side. */
bool fg__camera_sees_inside(const fg__camera *camera, const fg__view_box *view_box,
                            int axis, int side);

#endif
