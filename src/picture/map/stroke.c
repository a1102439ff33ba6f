#include "picture/map/stroke.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/polygons.h"

/* One array for the four, which the others follow in quarters. */
static bool make_room(fg__stroke *s)
{
  if (s->count < s->capacity)
    return true;
  const size_t capacity = s->capacity ? 2 * s->capacity : 256;
  double *array = fg__allocate(capacity, 4 * sizeof *array);
  if (!array)
    return false;
  for (size_t n = 0; n < s->count; ++n) {
    array[n] = s->longitude[n];
    array[capacity + n] = s->latitude[n];
  }
  free(s->longitude);
  *s = (fg__stroke){.longitude = array,
                    .latitude = array + capacity,
                    .x = array + 2 * capacity,
                    .y = array + 3 * capacity,
                    .count = s->count,
                    .capacity = capacity};
  return true;
}

void fg__stroke_add(fg__stroke *s, double longitude, double latitude)
{
  s->failed = s->failed || !make_room(s);
  if (s->failed)
    return;
  s->longitude[s->count] = longitude;
  s->latitude[s->count++] = latitude;
}

void fg__stroke_add_straight(fg__stroke *s, double longitude, double latitude,
                             double step)
{
  if (s->count) {
    const double from[2] = {s->longitude[s->count - 1], s->latitude[s->count - 1]};
    const double d[2] = {longitude - from[0], latitude - from[1]};
    const double pieces = ceil(fmax(fabs(d[0]), fabs(d[1])) / step);
    for (double k = 1.0; k < pieces; k += 1.0)
      fg__stroke_add(s, from[0] + d[0] * k / pieces, from[1] + d[1] * k / pieces);
  }
  fg__stroke_add(s, longitude, latitude);
}

static size_t points_of_last(const fg__polygons *out)
{
  return out->start[out->count] - out->start[out->count - 1];
}

void fg__stroke_end(fg__stroke *s, fg__polygons *out, const fg__plane *plane, bool closed)
{
  bool begun = false;
  if (!s->failed && s->count)
    fg__plane_forward(plane, s->count, s->longitude, s->latitude, s->x, s->y);
  for (size_t n = 0; n < s->count && !s->failed; ++n) {
    const double at[2] = {s->x[n], s->y[n]};
    if (!isfinite(at[0]) || !isfinite(at[1])) {
      if (begun && !closed && points_of_last(out) < 2)
        fg__polygons_drop_last(out);
      begun = begun && closed;
      continue;
    }
    s->failed = (!begun && !fg__polygons_begin(out)) || !fg__polygons_add(out, at);
    begun = true;
  }
  if (begun && !s->failed && points_of_last(out) < (closed ? 3 : 2))
    fg__polygons_drop_last(out);
  s->count = 0;
}

void fg__clip_edge(double share[2], const double a[2], const double b[2],
                   const double low[2], const double high[2])
{
  share[0] = 0.0, share[1] = 1.0;
  for (int k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    if (d == 0.0 && (a[k] < low[k] || a[k] > high[k]))
      share[1] = -1.0;
    if (d == 0.0)
      continue;
    const double one = (low[k] - a[k]) / d, other = (high[k] - a[k]) / d;
    share[0] = fmax(share[0], fmin(one, other));
    share[1] = fmin(share[1], fmax(one, other));
  }
}

void fg__stroke_clear(fg__stroke *s)
{
  free(s->longitude);
  *s = (fg__stroke){0};
}
