#include "icon/arrow.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Space between the outline and the cluster's border, in spacings: the zero set is known
 * to about a tenth of a cell, and a tip on the very border looks as if it poked out. */
static const double MARGIN = 0.35;

/* Readability (in spacings): shorter or narrower is a speck in print. */
static const double SHORTEST = 3.0;
static const double NARROWEST_HEAD = 1.2;

/* Largest width in lengths: with it the head takes 22 % of the length. Wider ones are
 * stubs; a fat cluster does not make a fat arrow. */
static const double LARGEST_WIDTH = 0.075;

/* The narrowest arrow may be wider in lengths than others: its head, a third of it, is
 * what a reader needs to see which way it points. */
static const double SMALL_ARROW_WIDTH = 0.11;

/* Shares of the free way to the border that a body's and a head's half width may take. */
static const double BODY_SHARE = 0.5;
static const double HEAD_SHARE = 0.85;

/* Largest half width in radii of curvature, of the body, of the narrowest body, and of
 * the head, and how far the head may bend (radians): beyond that a head looks like a
 * claw. */
static const double BODY_BEND = 0.25;
static const double NARROW_BODY_BEND = 0.5;
static const double HEAD_BEND = 0.6;
static const double HEAD_TURNING = 0.5;

/* Largest head length in radii of curvature at any of its points: the very tip, where it
 * is narrow, must not curl either. */
static const double HEAD_CURL = 1.2;

/* A turn between neighbouring stations (radians) that is a corner, not a bend. */
static const double CORNER = 0.9;

/* What a wider arrow is worth: that many times the relative loss of length. */
static const double WIDTH_WORTH = 0.4;

/* The distance map is of first order: that many spacings of it are not relied on. */
static const double DISTANCE_ERROR = 0.75;

/* Widths are tried downwards by this factor. */
static const double WIDTH_STEP = 0.91;

/* Parts closer together than this (in widths, between outlines) seem to touch. */
static const double SELF_GAP = 1.0;

/* Only parts that differ by a right angle or more can come near each other. */
static const double SELF_TURNING = 1.5707963267948966;

/* Stations a line: a head of the widest arrow then spans 9 of them. */
enum { FEWEST_STATIONS = 40, MOST_STATIONS = 400, CLEARANCE_BISECTIONS = 6 };
static const double STATION_SPACING = 0.5; /* in spacings of the density */

/* Turn between two points of the centreline, radians, and their distance in spacings. */
static const double POINT_TURN = 0.017;
static const double POINT_SPACING = 1.0;

typedef struct station_span {
  int first, last; /* stations */
} station_span;

double fg__distance_at(const fg__window *window, const double *distance,
                       const double position[2])
{
  int cell[2];
  double share[2];
  for (int a = 0; a < 2; a++) {
    double x = (position[a] - window->origin[a]) / window->spacing[a];
    x = fmin(fmax(x, 0), window->nodes[a] - 1);
    cell[a] = (int)fmin(x, window->nodes[a] - 2);
    share[a] = x - cell[a];
  }
  const double *low = distance + cell[1] * window->nodes[0] + cell[0];
  const double *high = low + window->nodes[0];
  double bottom = low[0] + (low[1] - low[0]) * share[0];
  double top = high[0] + (high[1] - high[0]) * share[0];
  return bottom + (top - bottom) * share[1];
}

double fg__arrow_widest(double length, double spacing)
{
  return fmax(LARGEST_WIDTH * length, NARROWEST_HEAD * spacing / FG__HEAD_WIDTH);
}

/* Free way from a point along a direction, at most `reach`; the first `known` of it is.
 */
static double find_clearance(const fg__window *window, const double position[2],
                             double dx, double dy, double step, double known,
                             double reach)
{
  double inside = fmax(known, 0), outside = inside;
  while (inside < reach) {
    outside = inside + step;
    double point[2] = {position[0] + outside * dx, position[1] + outside * dy};
    if (!(fg__window_level(window, point) > 0))
      break;
    inside = outside;
  }
  if (inside >= reach)
    return reach;
  for (int i = 0; i < CLEARANCE_BISECTIONS; i++) {
    double middle = (inside + outside) / 2;
    double point[2] = {position[0] + middle * dx, position[1] + middle * dy};
    if (fg__window_level(window, point) > 0)
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

static fg_status place_stations(fg__arrow_workspace *work, fg_context *context,
                                const fg__streamline *line, double spacing)
{
  double length = fg__streamline_length(line);
  double wanted = ceil(length / (STATION_SPACING * spacing));
  int intervals = (int)fmin(fmax(wanted, FEWEST_STATIONS), MOST_STATIONS);
  if (!fg__grow((void **)&work->station, &work->capacity, (size_t)intervals + 1,
                sizeof *work->station))
    return fg__fail_memory(context, "an arrow",
                           ((size_t)intervals + 1) * sizeof *work->station);
  work->count = intervals + 1;
  int hint = 0;
  for (int i = 0; i < work->count; i++) {
    fg__arrow_station *station = &work->station[i];
    station->s = length * i / intervals;
    fg__streamline_at(line, station->s, &hint, station->position, station->tangent);
  }
  return FG_STATUS_OK;
}

static double angle_between(const double a[2], const double b[2])
{
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

static void set_limits(fg__arrow_station *station, double clearance, double turn,
                       double length, double narrowest)
{
  station->curvature = turn / length;
  station->body_limit = station->head_limit = -1;
  if (turn > CORNER || clearance < 0)
    return;
  double curvature = station->curvature;
  station->body_limit = BODY_SHARE * clearance;
  station->head_limit = HEAD_SHARE * clearance;
  if (curvature * station->body_limit > BODY_BEND) {
    double narrow =
        fmin(fmin(NARROW_BODY_BEND / curvature, narrowest / 2), station->body_limit);
    station->body_limit = fmax(BODY_BEND / curvature, narrow);
  }
  if (curvature * station->head_limit > HEAD_BEND)
    station->head_limit = HEAD_BEND / curvature;
}

static void measure_stations(fg__arrow_workspace *work, const fg__window *window,
                             const double *distance, double spacing)
{
  fg__arrow_station *station = work->station;
  int n = work->count;
  double margin = MARGIN * spacing, delta = station[1].s - station[0].s;
  double widest = fg__arrow_widest(station[n - 1].s, spacing);
  double reach = FG__HEAD_WIDTH / 2 * widest / HEAD_SHARE + margin;
  station[0].turning = station[0].wiggle = 0;
  for (int i = 1; i < n; i++) {
    double turn = angle_between(station[i - 1].tangent, station[i].tangent);
    station[i].turning = station[i - 1].turning + turn;
    station[i].wiggle = station[i - 1].wiggle + fabs(turn);
  }
  for (int i = 0; i < n; i++) {
    const double *position = station[i].position, *tangent = station[i].tangent;
    double known = fg__distance_at(window, distance, position) - DISTANCE_ERROR * spacing;
    double left = find_clearance(window, position, -tangent[1], tangent[0], spacing / 2,
                                 known, reach);
    double right = find_clearance(window, position, tangent[1], -tangent[0], spacing / 2,
                                  known, fmin(reach, left));
    /* the sharper of the bends before and after: data cells leave jumps of curvature */
    double turn = 0;
    if (i > 0)
      turn = fabs(station[i].turning - station[i - 1].turning);
    if (i < n - 1)
      turn = fmax(turn, fabs(station[i + 1].turning - station[i].turning));
    set_limits(&station[i], right - margin, turn, delta,
               NARROWEST_HEAD * spacing / FG__HEAD_WIDTH);
  }
}

/* Distance of two stations less what the outlines there may need. */
static bool keeps_apart(const fg__arrow_station *a, const fg__arrow_station *b,
                        double width)
{
  if (fabs(a->turning - b->turning) < SELF_TURNING)
    return true;
  double least = (0.5 + FG__HEAD_WIDTH / 2 + SELF_GAP) * width;
  double dx = a->position[0] - b->position[0], dy = a->position[1] - b->position[1];
  return dx * dx + dy * dy > least * least;
}

/* Grows a span from the start to both sides, the shorter side first, until the line ends,
 * would turn by more than an arrow may, or would come near itself. */
static station_span grow_span(const fg__arrow_workspace *work, int start, double width,
                              double end_gap)
{
  const fg__arrow_station *station = work->station;
  double total = station[work->count - 1].s;
  station_span span = {start, start};
  double lowest = station[start].turning, highest = lowest;
  bool open[2] = {true, true};
  while (open[0] || open[1]) {
    int upstream = start - span.first, downstream = span.last - start;
    int side = open[0] && (!open[1] || upstream <= downstream) ? 0 : 1;
    int next = side == 0 ? span.first - 1 : span.last + 1;
    open[side] = false;
    if (next < 0 || next >= work->count || station[next].s < end_gap ||
        station[next].s > total - end_gap)
      continue;
    double low = fmin(lowest, station[next].turning);
    double high = fmax(highest, station[next].turning);
    if (high - low > FG__LARGEST_TURNING)
      continue;
    bool apart = true;
    if (high - low > SELF_TURNING)
      for (int i = span.first; i <= span.last && apart; i++)
        apart = keeps_apart(&station[i], &station[next], width);
    if (!apart)
      continue;
    lowest = low;
    highest = high;
    open[side] = true;
    if (side == 0)
      span.first = next;
    else
      span.last = next;
  }
  return span;
}

/* Whether the head fits with its tip at a station; *base is the station where it begins.
 */
static bool head_fits(const fg__arrow_workspace *work, int first, int tip, double width,
                      int *base)
{
  const fg__arrow_station *station = work->station;
  double length = FG__HEAD_LENGTH * width, whole = length * (1 + FG__HEAD_SWEEP);
  double slope = FG__HEAD_WIDTH * width / 2 / whole;
  int i = tip;
  for (; i >= first; i--) {
    double u = station[tip].s - station[i].s;
    /* the limits of one station past the barbs count too: the barbs are before it */
    if (u * slope > station[i].head_limit || station[i].curvature * length > HEAD_CURL)
      return false;
    if (u <= length)
      *base = i;
    if (u > whole)
      break;
  }
  return i >= first &&
         fabs(station[tip].turning - station[*base].turning) <= HEAD_TURNING;
}

/* The most upstream tail from which the body fits, or base when there is none. At a
 * station whose limit is a share t of the way from the tail's width to the full one, the
 * taper must not have come further than t: that bounds the tail from upstream. */
static int find_tail(const fg__arrow_workspace *work, int first, int base, double width)
{
  const fg__arrow_station *station = work->station;
  double end = station[base].s, bound = station[first].s;
  int tail = base;
  if (station[base].body_limit < width / 2)
    return base;
  for (int i = base - 1; i >= first; i--) {
    double t =
        (station[i].body_limit / (width / 2) - FG__TAIL_WIDTH) / (1 - FG__TAIL_WIDTH);
    if (t < 0)
      break;
    if (t < 1)
      bound = fmax(bound, (station[i].s - t * end) / (1 - t));
    if (station[i].s < bound)
      break;
    tail = i;
  }
  /* a bound found late may lie beyond stations already taken */
  while (tail < base && station[tail].s < bound)
    tail++;
  return tail;
}

/* Longest arrow of one width within a span; false when there is none long enough. */
static bool find_longest(const fg__arrow_workspace *work, station_span span, double width,
                         double shortest, int *tail, int *tip)
{
  const fg__arrow_station *station = work->station;
  double best = 0;
  for (int end = span.last; end > span.first; end--) {
    if (station[end].s - station[span.first].s <= best)
      break;
    int base = end;
    if (!head_fits(work, span.first, end, width, &base))
      continue;
    int begin = find_tail(work, span.first, base, width);
    double length = station[end].s - station[begin].s;
    if (begin < base && length > best) {
      best = length;
      *tail = begin;
      *tip = end;
    }
  }
  return best >= shortest && best > 0;
}

static double turning_range(const fg__arrow_workspace *work, int first, int last)
{
  double low = work->station[first].turning, high = low;
  for (int i = first; i <= last; i++) {
    low = fmin(low, work->station[i].turning);
    high = fmax(high, work->station[i].turning);
  }
  return high - low;
}

fg_status fg__arrow_fit(fg__arrow *out, fg_context *context,
                        const fg__streamline *streamline, const fg__window *window,
                        const double *distance, double spacing,
                        fg__arrow_workspace *workspace)
{
  *out = (fg__arrow){0};
  double length = fg__streamline_length(streamline);
  if (length < SHORTEST * spacing)
    return FG_STATUS_OK;
  fg_status status = place_stations(workspace, context, streamline, spacing);
  if (status != FG_STATUS_OK)
    return status;
  measure_stations(workspace, window, distance, spacing);

  const fg__arrow_station *station = workspace->station;
  int start = (int)lround(streamline->node[streamline->start].s / length *
                          (workspace->count - 1));
  double narrowest = NARROWEST_HEAD * spacing / FG__HEAD_WIDTH;
  double widest = fg__arrow_widest(length, spacing), best = 0;
  int steps = (int)ceil(log(widest / narrowest) / -log(WIDTH_STEP));
  for (int i = 0; i <= steps; i++) {
    double width = fmax(widest * pow(WIDTH_STEP, i), narrowest);
    /* no narrower arrow can be better than this one */
    if (length * pow(width / spacing, WIDTH_WORTH) <= best)
      break;
    station_span span = grow_span(workspace, start, width, MARGIN * spacing);
    double ratio = width > narrowest ? LARGEST_WIDTH : SMALL_ARROW_WIDTH;
    double shortest = fmax(SHORTEST * spacing, width / ratio);
    int tail = 0, tip = 0;
    if (!find_longest(workspace, span, width, shortest, &tail, &tip))
      continue;
    double worth = (station[tip].s - station[tail].s) * pow(width / spacing, WIDTH_WORTH);
    if (worth > best) {
      best = worth;
      double range = turning_range(workspace, tail, tip);
      double turned = station[tip].wiggle - station[tail].wiggle;
      *out = (fg__arrow){station[tail].s, station[tip].s, width, range, turned - range};
    }
  }
  return FG_STATUS_OK;
}

void fg__arrow_workspace_clear(fg__arrow_workspace *workspace)
{
  free(workspace->station);
  *workspace = (fg__arrow_workspace){0};
}

/* Number of straight pieces for a part of one segment of the streamline. */
static int count_pieces(const fg__streamline_node *from, const fg__streamline_node *to,
                        double length, double spacing)
{
  double turn = fabs(to->turning - from->turning) * length / (to->s - from->s);
  double pieces = fmax(turn / POINT_TURN, length / (POINT_SPACING * spacing));
  return (int)fmax(ceil(pieces - 1e-9), 1);
}

fg_status fg__arrow_centerline(double (**points)[3], int *count, fg_context *context,
                               const fg__streamline *streamline, const fg__arrow *arrow,
                               double spacing)
{
  const fg__streamline_node *node = streamline->node;
  size_t capacity = 0, used = 0;
  double(*point)[3] = NULL;
  double tangent[2];
  int hint = 0;
  /* pieces much shorter than a point's spacing come from steps cut at the ends */
  double least = 1e-3 * spacing;
  for (int i = 0; i + 1 < streamline->count; i++) {
    double from = fmax(node[i].s, arrow->tail), to = fmin(node[i + 1].s, arrow->tip);
    if (to - from < least)
      continue;
    int pieces = count_pieces(&node[i], &node[i + 1], to - from, spacing);
    if (!fg__grow((void **)&point, &capacity, used + (size_t)pieces + 1, sizeof *point)) {
      free(point);
      return fg__fail_memory(context, "an arrow's centreline",
                             (used + (size_t)pieces + 1) * sizeof *point);
    }
    for (int k = 0; k < pieces; k++, used++)
      fg__streamline_at(streamline, from + (to - from) * k / pieces, &hint, point[used],
                        tangent);
  }
  if (!point) {
    *points = NULL;
    *count = 0;
    return FG_STATUS_OK;
  }
  fg__streamline_at(streamline, arrow->tip, &hint, point[used], tangent);
  used++;
  for (size_t i = 0; i < used; i++)
    point[i][2] = 0;
  *points = point;
  *count = (int)used;
  return FG_STATUS_OK;
}
