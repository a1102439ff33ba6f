#include "icon/measure.h"

#include "icon/arrow.h"

#include <math.h>

/* An arrow round more than seven tenths of a turn is a ring, less is a horseshoe. */
static const double RING_TURNING = 4.4;

void fg__icon_set_width(fg_icon *icon, double width)
{
  icon->width = width;
  icon->tail_width = FG__TAIL_WIDTH * width;
  icon->head_length = FG__HEAD_LENGTH * width;
  icon->head_width = FG__HEAD_WIDTH * width;
}

void fg__icon_set_center(fg_icon *icon, const double center[2])
{
  double nearest = HUGE_VAL;
  for (int i = 0; i + 1 < icon->point_count; i++) {
    const double *p = icon->points[i], *q = icon->points[i + 1];
    double dx = q[0] - p[0], dy = q[1] - p[1];
    double t = ((center[0] - p[0]) * dx + (center[1] - p[1]) * dy) / (dx * dx + dy * dy);
    t = fmin(fmax(t, 0), 1);
    double x = p[0] + t * dx, y = p[1] + t * dy;
    double distance = hypot(center[0] - x, center[1] - y);
    if (distance < nearest) {
      nearest = distance;
      icon->center[0] = x;
      icon->center[1] = y;
    }
  }
}

double fg__icon_length(const fg_icon *icon)
{
  double length = 0.0;
  for (int i = 1; i < icon->point_count; i++) {
    const double *a = icon->points[i - 1], *b = icon->points[i];
    length += hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
  }
  return length;
}

double fg__icon_mean_speed(const fg_field *field, const fg_icon *icon)
{
  double sum = 0, length = 0, before = 0;
  for (int i = 0; i < icon->point_count; i++) {
    double velocity[3] = {0}, speed = before;
    if (fg_field_velocity(field, icon->points[i], velocity))
      speed = hypot(velocity[0], velocity[1]);
    if (i > 0) {
      double piece = hypot(icon->points[i][0] - icon->points[i - 1][0],
                           icon->points[i][1] - icon->points[i - 1][1]);
      sum += piece * (speed + before) / 2;
      length += piece;
    }
    before = speed;
  }
  return length > 0 ? sum / length : 0;
}

fg_icon_kind fg__icon_kind_of(double turning)
{
  return turning >= RING_TURNING ? FG_ICON_RING : FG_ICON_ARROW;
}
