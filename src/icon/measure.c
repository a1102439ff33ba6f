#include "icon/measure.h"

#include "base/vector.h"
#include "icon/arrow.h"

#include <math.h>
#include <string.h>

/* An arrow round more than seven tenths of a turn is a ring, less is a horseshoe. */
static const double RING_TURNING = 4.4;

void fg__icon_set_width(fg_icon *icon, int dimension, double width)
{
  bool flat = dimension == 2;
  icon->width = width;
  icon->tail_width = (flat ? FG__TAIL_WIDTH : FG__SOLID_TAIL_WIDTH) * width;
  icon->head_length = (flat ? FG__HEAD_LENGTH : FG__SOLID_HEAD_LENGTH) * width;
  icon->head_width = (flat ? FG__HEAD_WIDTH : FG__SOLID_HEAD_WIDTH) * width;
}

static double hypot3(const double a[3])
{
  return hypot(hypot(a[0], a[1]), a[2]);
}

void fg__icon_set_center(fg_icon *icon, const double center[3])
{
  double nearest = HUGE_VAL;
  for (int i = 0; i + 1 < icon->point_count; i++) {
    const double *p = icon->points[i], *q = icon->points[i + 1];
    double along[3], to[3], on[3], off[3];
    fg__subtract(q, p, along);
    fg__subtract(center, p, to);
    double t = fmin(fmax(fg__dot(to, along) / fg__dot(along, along), 0), 1);
    fg__add_scaled(p, t, along, on);
    fg__subtract(center, on, off);
    double distance = hypot3(off);
    if (distance < nearest) {
      nearest = distance;
      memcpy(icon->center, on, sizeof on);
    }
  }
}

static double piece_of(const fg_icon *icon, int n)
{
  double along[3];
  fg__subtract(icon->points[n], icon->points[n - 1], along);
  return hypot3(along);
}

double fg__icon_length(const fg_icon *icon)
{
  double length = 0.0;
  for (int i = 1; i < icon->point_count; i++)
    length += piece_of(icon, i);
  return length;
}

double fg__icon_mean_speed(const fg_field *field, const fg_icon *icon)
{
  double sum = 0, length = 0, before = 0;
  for (int i = 0; i < icon->point_count; i++) {
    double velocity[3] = {0}, speed = before;
    if (fg_field_velocity(field, icon->points[i], velocity))
      speed = hypot3(velocity);
    if (i > 0) {
      double piece = piece_of(icon, i);
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
