#include "solid/shaft.h"

#include "base/memory.h"
#include "solid/vector.h"

#include <math.h>
#include <stdlib.h>

/* A station every half spacing; long paths have this many at most. */
enum { MOST_STATIONS = 400 };

/* Kept free between arrow and border, in spacings: what linear interpolation of the
 * distance hides. */
static const double MARGIN = 0.15;

/* Of the length: thicker looks like a drop, thinner like a thread. */
static const double WIDEST = 0.09, SLIMMEST = 0.028;

/* Widths are tried from the widest down in such steps. */
static const double NARROWER = 0.88;

static const double WIDTH_WORTH = 0.4;

/* Least length, and least width of the head, in spacings: as in 2D. */
static const double SHORTEST = 3.0, LEAST_HEAD = 1.2;

/* The body's radius in radii of curvature: beyond 1 its sections would cross. */
static const double LARGEST_BEND = 0.7;

/* The line under a head turns by no more, radians: a cone bent further is a claw. */
static const double HEAD_TURNING = 0.6;

/* Parts of an arrow that are farther apart along it than this many head widths must be
 * APART head widths apart in space: the gap between two turns shows. */
static const double SEPARATE = 3.0, APART = 1.5;

struct fg__shaft_station {
  double position[3], turning;
  double room; /* radius of the ball that is free here */
};

double fg__shaft_widest(double length)
{
  return WIDEST * length;
}

static fg_status place(fg__shaft_stations *stations, fg_context *context,
                       const fg__path *path, const fg__solid_room *room)
{
  double length = fg__path_length(path);
  int pieces = (int)ceil(2 * length / room->spacing);
  pieces = pieces < 4 ? 4 : pieces > MOST_STATIONS ? MOST_STATIONS : pieces;
  size_t count = (size_t)pieces + 1;
  if (!fg__grow((void **)&stations->station, &stations->capacity, count,
                sizeof *stations->station))
    return fg__fail_memory(context, "a streamline", count * sizeof *stations->station);
  stations->count = pieces + 1;
  stations->step = length / pieces;
  int hint = 0;
  for (int i = 0; i <= pieces; i++) {
    struct fg__shaft_station *at = &stations->station[i];
    double tangent[3];
    at->turning = fg__path_at(path, length * i / pieces, &hint, at->position, tangent);
    at->room = fg__volume_value(room->volume, room->distance, at->position) -
               MARGIN * room->spacing;
  }
  for (int i = 1; i < pieces; i++) {
    struct fg__shaft_station *at = &stations->station[i];
    double bend = at[1].turning - at[-1].turning;
    if (bend > 0)
      at->room = fmin(at->room, LARGEST_BEND * 2 * stations->step / bend);
  }
  return FG_STATUS_OK;
}

/* Whether a cone ending at station `tip` fits; *base is the last station before it. */
static bool head_fits(const fg__shaft_stations *stations, int tip, double width,
                      int *base)
{
  double head = FG__SOLID_HEAD_LENGTH * width;
  *base = tip - (int)ceil(head / stations->step);
  if (*base < 0 ||
      stations->station[tip].turning - stations->station[*base].turning > HEAD_TURNING)
    return false;
  for (int i = tip; i >= *base; i--) {
    double behind = fmin((tip - i) * stations->step, head);
    if (stations->station[i].room < FG__SOLID_HEAD_WIDTH / 2 * width * behind / head)
      return false;
  }
  return true;
}

/* The first station of the longest body that ends at `base`: the body's radius grows
 * linearly from tail a to base b, and r(s) <= room(s) bounds a from below by
 * (s - share b) / (1 - share), share being the part of the growth that fits at s. */
static int find_tail(const fg__shaft_stations *stations, int base, int tip, double width)
{
  double bound = 0, limit = stations->station[tip].turning - FG__SOLID_TURNING;
  int i = base;
  for (; i >= 0 && i >= bound && stations->station[i].turning >= limit; i--) {
    double share = (2 * stations->station[i].room / width - FG__SOLID_TAIL_WIDTH) /
                   (1 - FG__SOLID_TAIL_WIDTH);
    if (share < 0)
      break;
    if (share < 1)
      bound = fmax(bound, (i - share * base) / (1 - share));
  }
  int tail = i + 1;
  return tail < bound ? (int)ceil(bound) : tail;
}

/* Moves the tail on until no part of the arrow is near another. */
static int clear_itself(const fg__shaft_stations *stations, int tail, int tip,
                        double width)
{
  double head = FG__SOLID_HEAD_WIDTH * width, wanted = APART * head;
  int apart = (int)ceil(SEPARATE * head / stations->step);
  for (int i = tip; i - apart >= tail; i--)
    for (int j = i - apart; j >= tail; j--)
      if (fg__apart(stations->station[i].position, stations->station[j].position) <
          wanted) {
        tail = j + 1;
        break;
      }
  return tail;
}

fg_status fg__shaft_fit(fg__shaft *out, fg_context *context, const fg__path *path,
                        const fg__solid_room *room, fg__shaft_stations *stations)
{
  *out = (fg__shaft){0};
  double length = fg__path_length(path), best = 0, deepest = 0;
  if (path->count < 2 || length < SHORTEST * room->spacing)
    return FG_STATUS_OK;
  fg_status status = place(stations, context, path, room);
  if (status != FG_STATUS_OK)
    return status;
  for (int i = 0; i < stations->count; i++)
    deepest = fmax(deepest, stations->station[i].room);
  double least = LEAST_HEAD * room->spacing / FG__SOLID_HEAD_WIDTH;
  double width = fmin(WIDEST * length, 2 * deepest / FG__SOLID_HEAD_WIDTH);
  for (; width >= least; width *= NARROWER) {
    if (length * pow(width, WIDTH_WORTH) <= best)
      break;
    for (int tip = stations->count - 1; tip > 0; tip--) {
      int base;
      if (tip * stations->step * pow(width, WIDTH_WORTH) <= best)
        break;
      if (!head_fits(stations, tip, width, &base))
        continue;
      int tail = find_tail(stations, base, tip, width);
      int longest = (int)(width / (SLIMMEST * stations->step));
      tail = tip - tail > longest ? tip - longest : tail;
      double value = (tip - tail) * stations->step * pow(width, WIDTH_WORTH);
      if (tail >= base || value <= best)
        continue;
      tail = clear_itself(stations, tail, tip, width);
      double taken = (tip - tail) * stations->step;
      value = taken * pow(width, WIDTH_WORTH);
      if (value <= best || tail >= base || taken < SHORTEST * room->spacing ||
          width > WIDEST * taken)
        continue;
      best = value;
      *out =
          (fg__shaft){tail * stations->step, tip * stations->step, width,
                      stations->station[tip].turning - stations->station[tail].turning};
    }
  }
  return FG_STATUS_OK;
}

void fg__shaft_stations_clear(fg__shaft_stations *stations)
{
  free(stations->station);
  *stations = (fg__shaft_stations){0};
}
