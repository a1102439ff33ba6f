#include "icon/stations.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Stations a line. The head of an arrow at least a thirtieth as wide as long is a tenth
 * of it long: 16 stations on the longest lines. */
enum { FEWEST_STATIONS = 40, MOST_STATIONS = 160, CLEARANCE_BISECTIONS = 4 };
static const double STATION_SPACING = 0.5; /* in spacings of the density */

double fg__distance_at(const fg__window *window, const double *distance,
                       const double position[2])
{
  int cell[2];
  double share[2];
  for (int a = 0; a < 2; a++) {
    double x = (position[a] - window->origin[a]) / window->spacing[a];
    double last = window->nodes[a] - 1;
    x = x > 0 ? x < last ? x : last : 0;
    cell[a] = x < last ? (int)x : window->nodes[a] - 2;
    share[a] = x - cell[a];
  }
  const double *low = distance + cell[1] * window->nodes[0] + cell[0];
  const double *high = low + window->nodes[0];
  double bottom = low[0] + (low[1] - low[0]) * share[0];
  double top = high[0] + (high[1] - high[0]) * share[0];
  return bottom + (top - bottom) * share[1];
}

bool fg__room_has(const fg__room *room, double x, double y)
{
  double point[2] = {x, y};
  return fg__window_level(room->window, point) > 0;
}

/* Free way from a point along a direction, at most `reach`; the first `known` of it is.
 */
static double find_clearance(const fg__room *room, const double position[2], double dx,
                             double dy, double known, double reach)
{
  double inside = fmax(known, 0), outside = inside;
  while (inside < reach) {
    outside = inside + room->spacing / 2;
    if (!fg__room_has(room, position[0] + outside * dx, position[1] + outside * dy))
      break;
    inside = outside;
  }
  if (inside >= reach)
    return reach;
  for (int i = 0; i < CLEARANCE_BISECTIONS; i++) {
    double middle = (inside + outside) / 2;
    if (fg__room_has(room, position[0] + middle * dx, position[1] + middle * dy))
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

static double angle_between(const double a[2], const double b[2])
{
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

fg_status fg__stations_place(fg__stations *stations, fg_context *context,
                             const fg__streamline *line, const fg__room *room,
                             double reach)
{
  double length = fg__streamline_length(line);
  double wanted = ceil(length / (STATION_SPACING * room->spacing));
  int intervals = (int)fmin(fmax(wanted, FEWEST_STATIONS), MOST_STATIONS);
  if (!fg__grow((void **)&stations->station, &stations->capacity, (size_t)intervals + 1,
                sizeof *stations->station))
    return fg__fail_memory(context, "an arrow",
                           ((size_t)intervals + 1) * sizeof *stations->station);
  stations->count = intervals + 1;
  stations->step = length / intervals;
  int hint = 0;
  reach += room->margin;
  for (int i = 0; i < stations->count; i++) {
    fg__station *station = &stations->station[i];
    station->s = length * i / intervals;
    fg__streamline_at(line, station->s, &hint, station->position, station->tangent);
    station->turning =
        i > 0 ? station[-1].turning + angle_between(station[-1].tangent, station->tangent)
              : 0;
    double known = fg__distance_at(room->window, room->distance, station->position) -
                   FG__DISTANCE_ERROR * room->spacing;
    double free_way = reach;
    if (known < reach) {
      double dx = -station->tangent[1], dy = station->tangent[0];
      free_way = find_clearance(room, station->position, dx, dy, known, reach);
      free_way = find_clearance(room, station->position, -dx, -dy, known, free_way);
    }
    station->room = free_way - room->margin;
  }
  return FG_STATUS_OK;
}

void fg__stations_bend(fg__stations *stations, double width)
{
  fg__station *station = stations->station;
  int last = stations->count - 1;
  int reach = (int)lround(width / stations->step);
  reach = reach < 1 ? 1 : reach;
  stations->bend_window = 2 * reach * stations->step;
  double sum = 0;
  for (int i = 0; i <= last; i++) {
    int before = i > reach ? i - reach : 0, after = i + reach < last ? i + reach : last;
    station[i].bend = fabs(station[after].turning - station[before].turning);
    station[i].bend_sum = sum;
    sum += station[i].bend * station[i].bend;
  }
}

void fg__stations_clear(fg__stations *stations)
{
  free(stations->station);
  *stations = (fg__stations){0};
}
