#include "write/parts.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* A centimetre on the ground: finer digits do not change a line that is drawn. */
static const double DIGITS = 1e7;

static double turned(double longitude)
{
  return longitude - 360.0 * nearbyint(longitude / 360.0);
}

static double rounded(double value)
{
  return nearbyint(value * DIGITS) / DIGITS + 0.0; /* no minus zero */
}

/* Degrees of a point, longitude in some turn, not rounded. */
static void find_degrees(double out[2], const fg__map *map, const double point[3])
{
  if (map) {
    fg__map_inverse(map, 1, &point[0], &point[1], &out[0], &out[1]);
    return;
  }
  out[0] = point[0];
  out[1] = fmin(fmax(point[1], -90.0), 90.0);
}

void fg__parts_position(double out[2], const fg__map *map, const double point[3])
{
  find_degrees(out, map, point);
  if (map || fabs(out[0]) > 180.0) {
    out[0] = rounded(turned(out[0]));
    out[1] = rounded(out[1]);
  }
}

static void add(fg__line_parts *out, double longitude, double latitude)
{
  out->position[out->count][0] = longitude;
  out->position[out->count++][1] = latitude;
}

static void begin_part(fg__line_parts *out, double longitude, double latitude)
{
  out->first[out->parts++] = out->count;
  add(out, longitude, latitude);
}

/* Goes from the last position to one within half a turn of it, longitude in the turn of
 * `*turn` degrees. */
static void go_on(fg__line_parts *out, double *turn, const double last[2],
                  const double to[2])
{
  const double longitude = to[0] - *turn;
  if (fabs(longitude) <= 180.0) {
    add(out, longitude, to[1]);
    return;
  }
  const double side = longitude > 0.0 ? 180.0 : -180.0, from = last[0] - *turn;
  const double share = (side - from) / (longitude - from);
  const double latitude = last[1] + (to[1] - last[1]) * share;
  const bool alone = out->count - out->first[out->parts - 1] == 1;
  if (share > 0.0) /* else it was on the antimeridian already */
    add(out, side, latitude);
  else if (alone) {
    --out->count;
    --out->parts;
  }
  begin_part(out, -side, latitude);
  *turn += 2.0 * side;
  add(out, to[0] - *turn, to[1]);
}

static void round_all(fg__line_parts *out)
{
  for (int i = 0; i < out->count; ++i)
    for (int k = 0; k < 2; ++k)
      out->position[i][k] = rounded(out->position[i][k]);
}

static fg_status make_room(fg__line_parts *out, fg_context *context, int count)
{
  const size_t most = 3 * (size_t)count + 1; /* each step may cross once */
  if (out->position && (size_t)out->capacity >= most)
    return FG_STATUS_OK;
  fg__parts_clear(out);
  out->position = fg__allocate(most, sizeof *out->position);
  out->first = fg__allocate(most, sizeof *out->first);
  out->capacity = (int)most;
  return out->position && out->first
             ? FG_STATUS_OK
             : fg__fail_memory(context, "a line", most * sizeof *out->position);
}

fg_status fg__parts_find(fg__line_parts *out, fg_context *context, const fg__map *map,
                         const double (*point)[3], int count)
{
  fg_status status = make_room(out, context, count);
  if (status != FG_STATUS_OK)
    return status;
  out->count = out->parts = 0;
  out->moved = map != NULL;
  double turn = 0.0, last[2] = {0.0, 0.0};
  for (int i = 0; i < count; ++i) {
    double at[2];
    find_degrees(at, map, point[i]);
    if (!isfinite(at[0]) || !isfinite(at[1]))
      continue;
    if (out->parts == 0) {
      turn = at[0] - (fabs(at[0]) > 180.0 ? turned(at[0]) : at[0]);
      out->moved = out->moved || fabs(turn) > 0.0;
      begin_part(out, at[0] - turn, at[1]);
    } else {
      at[0] = fabs(at[0] - last[0]) > 180.0 ? last[0] + turned(at[0] - last[0]) : at[0];
      go_on(out, &turn, last, at);
    }
    last[0] = at[0];
    last[1] = at[1];
  }
  out->moved = out->moved || out->parts > 1 || out->count != count;
  if (out->count == 1)
    add(out, out->position[0][0], out->position[0][1]);
  if (out->moved)
    round_all(out);
  return FG_STATUS_OK;
}

void fg__parts_clear(fg__line_parts *lines)
{
  free(lines->position);
  free(lines->first);
  *lines = (fg__line_parts){0};
}
