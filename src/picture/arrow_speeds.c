#include "picture/arrow_speeds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/vector.h"
#include "base/weighted.h"
#include "solid/tube.h"

/* Of the arrows' length, slower and faster than the ends of the colours. */
static const double left_out = 0.02;

/* Speeds that differ by less than this share are the same, but for interpolation. */
static const double equal = 1e-4;

fg_status fg__arrow_speeds(double **out, fg_context *context, const fg_field *field,
                           const fg_icon *icon)
{
  int count = icon->point_count, first = -1;
  double *speed = *out = fg__allocate((size_t)count, sizeof **out);
  if (!speed)
    return fg__fail_memory(context, "an arrow's speeds", (size_t)count * sizeof *speed);
  bool known = field && !fg_field_is_slab(field, NULL, NULL);
  for (int n = 0; n < count; ++n) {
    double velocity[3];
    if (known && fg_field_velocity(field, icon->points[n], velocity)) {
      speed[n] = fg__length(velocity);
      first = first < 0 ? n : first;
    } else {
      speed[n] = first < 0 ? icon->speed : speed[n - 1];
    }
  }
  for (int n = 0; n < first; ++n)
    speed[n] = speed[first];
  return FG_STATUS_OK;
}

fg_status fg__arrow_solid(fg_surface **out, float **at_vertex, fg_context *context,
                          const fg_field *field, const fg_icon *icon)
{
  double *speed;
  *out = NULL;
  *at_vertex = NULL;
  fg_status status = fg__arrow_speeds(&speed, context, field, icon);
  if (!status)
    status = fg__solid_with_values(out, at_vertex, context, icon, speed);
  free(speed);
  return status;
}

/* Speeds of the pieces of an arrow, weighted by their lengths. */
static fg_status add_pieces(fg__weighted *out, size_t *count, fg_context *context,
                            const fg_field *field, const fg_icon *icon)
{
  double *speed;
  fg_status status = fg__arrow_speeds(&speed, context, field, icon);
  for (int n = 0; n + 1 < icon->point_count && !status; ++n)
    out[(*count)++] = (fg__weighted){(speed[n] + speed[n + 1]) / 2.0,
                                     fg__distance(icon->points[n], icon->points[n + 1])};
  free(speed);
  return status;
}

fg_status fg_solid_speed_range(double range[2], fg_context *context,
                               const fg_field *field, const fg_icons *icons)
{
  if (!range || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "a range of speeds: no %s given",
                    icons ? "place for it" : "icons");
  range[0] = range[1] = 0.0;
  size_t room = 0, count = 0;
  for (int n = 0; n < fg_icons_count(icons); ++n)
    room += (size_t)fg_icons_at(icons, n)->point_count;
  fg__weighted *pieces = fg__allocate(room, sizeof *pieces);
  fg_status status =
      pieces ? FG_STATUS_OK
             : fg__fail_memory(context, "the arrows' speeds", room * sizeof *pieces);
  for (int n = 0; n < fg_icons_count(icons) && !status; ++n)
    status = add_pieces(pieces, &count, context, field, fg_icons_at(icons, n));
  if (!status)
    fg__weighted_range(range, pieces, count, left_out);
  if (range[1] - range[0] < equal * range[1])
    range[0] = range[1];
  free(pieces);
  return status;
}
