#include "solid/measure.h"

#include "solid/shaft.h"
#include "solid/vector.h"

#include <string.h>

/* From this turning on an arrow is a ring, as in icon/measure.c. */
static const double RING_TURNING = 4.4;

void fg__solid_set_width(fg_icon *icon, double width)
{
  icon->width = width;
  icon->tail_width = FG__SOLID_TAIL_WIDTH * width;
  icon->head_length = FG__SOLID_HEAD_LENGTH * width;
  icon->head_width = FG__SOLID_HEAD_WIDTH * width;
}

void fg__solid_set_center(fg_icon *icon, const double center[3])
{
  double nearest = HUGE_VAL;
  for (int i = 0; i + 1 < icon->point_count; i++) {
    const double *p = icon->points[i], *q = icon->points[i + 1];
    double along[3], to[3], on[3];
    fg__along(q, -1, p, along);
    fg__along(center, -1, p, to);
    double t = fmin(fmax(fg__dot(to, along) / fg__dot(along, along), 0), 1);
    fg__along(p, t, along, on);
    if (fg__apart(on, center) < nearest) {
      nearest = fg__apart(on, center);
      memcpy(icon->center, on, sizeof on);
    }
  }
}

double fg__solid_mean_speed(const fg_field *field, const fg_icon *icon)
{
  double sum = 0, length = 0, before = 0;
  for (int i = 0; i < icon->point_count; i++) {
    double velocity[3], speed = before;
    if (fg_field_velocity(field, icon->points[i], velocity))
      speed = fg__length(velocity);
    if (i > 0) {
      double piece = fg__apart(icon->points[i], icon->points[i - 1]);
      sum += piece * (speed + before) / 2;
      length += piece;
    }
    before = speed;
  }
  return length > 0 ? sum / length : 0;
}

fg_icon_kind fg__solid_kind_of(double turning)
{
  return turning >= RING_TURNING ? FG_ICON_RING : FG_ICON_ARROW;
}
