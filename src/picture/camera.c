#include "picture/camera.h"

#include <math.h>

#include "base/angle.h"
#include "base/vector.h"

/* The viewer's distance in half diagonals of the box: near enough that what is behind
 * looks smaller, far enough that parallels look so. */
static const double viewing_distance = 5.0;

void fg__view_box_of(fg__view_box *out, const fg_field_arrays *field)
{
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    out->low[k] = field->axis[k][0];
    out->high[k] = field->period[k] > 0.0 ? out->low[k] + field->period[k]
                                          : field->axis[k][field->size[k] - 1];
    out->middle[k] = (out->low[k] + out->high[k]) / 2.0;
    longest = fmax(longest, out->high[k] - out->low[k]);
  }
  out->scale = 1.0 / longest;
  for (int k = 0; k < 3; ++k) {
    out->half[k] = (out->high[k] - out->low[k]) / 2.0 * out->scale;
    out->period[k] = field->period[k] * out->scale;
  }
}

/* Right over forward and up over forward: where a point lies before the eye. */
static void see(const fg__camera *camera, const double point[3], double out[2])
{
  double to[3];
  fg__subtract(point, camera->eye, to);
  double depth = fg__dot(to, camera->forward);
  out[0] = fg__dot(to, camera->right) / depth;
  out[1] = fg__dot(to, camera->up) / depth;
}

void fg__camera_look(fg__camera *out, const fg__view_box *view_box, double azimuth,
                     double elevation, const fg__pane *pane)
{
  double a = azimuth * FG__RADIANS, e = elevation * FG__RADIANS;
  double distance = viewing_distance * fg__length(view_box->half);
  const double to_viewer[3] = {sin(a) * cos(e), -cos(a) * cos(e), sin(e)};
  for (int k = 0; k < 3; ++k) {
    out->eye[k] = distance * to_viewer[k];
    out->forward[k] = -to_viewer[k];
  }
  out->right[0] = cos(a);
  out->right[1] = sin(a);
  out->right[2] = 0.0;
  fg__cross(out->right, out->forward, out->up);
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int c = 0; c < 8; ++c) {
    double corner[3], at[2];
    for (int k = 0; k < 3; ++k)
      corner[k] = c >> k & 1 ? view_box->half[k] : -view_box->half[k];
    see(out, corner, at);
    for (int k = 0; k < 2; ++k) {
      /* with fmin and fmax here GCC 12 for arm64 breaks down */
      low[k] = at[k] < low[k] ? at[k] : low[k];
      high[k] = at[k] > high[k] ? at[k] : high[k];
    }
  }
  out->factor = fmin((pane->x1 - pane->x0) / (high[0] - low[0]),
                     (pane->y1 - pane->y0) / (high[1] - low[1]));
  out->x = (pane->x0 + pane->x1) / 2.0 - out->factor * (low[0] + high[0]) / 2.0;
  out->y = (pane->y0 + pane->y1) / 2.0 + out->factor * (low[1] + high[1]) / 2.0;
}

void fg__camera_project(const fg__camera *camera, const double point[3], double pixel[2])
{
  double at[2];
  see(camera, point, at);
  pixel[0] = camera->x + camera->factor * at[0];
  pixel[1] = camera->y - camera->factor * at[1];
}

void fg__camera_ray(const fg__camera *camera, double x, double y, double direction[3])
{
  fg__add_scaled(camera->forward, (x - camera->x) / camera->factor, camera->right,
                 direction);
  fg__add_scaled(direction, (camera->y - y) / camera->factor, camera->up, direction);
  fg__normalise(direction);
}

bool fg__camera_sees_inside(const fg__camera *camera, const fg__view_box *view_box,
                            int axis, int side)
{
  return camera->eye[axis] * side < view_box->half[axis];
}
