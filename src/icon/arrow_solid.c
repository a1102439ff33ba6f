#include "icon/arrow.h"
#include "icon/territory.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

/* Two samples a spacing; long lines have this many at most. */
enum { FEWEST_SAMPLES = 4, MOST_SAMPLES = 400 };

/* Points of a line to be drawn: it turns by at most this between two of them, radians (5
 * degrees), and has at least so many pieces. */
static const double LARGEST_TURN = 0.0873;
enum { FEWEST_PIECES = 8 };

/* Kept free between arrow and boundary, in spacings: what linear interpolation of the
 * distance hides. */
static const double MARGIN = 0.15;

/* Of the length: thicker looks like a drop, thinner like a thread. */
static const double WIDEST = 0.09, SLIMMEST = 0.028;

/* Widths are tried from the widest down in such steps. */
static const double NARROWER = 0.88;

/* Least length, and least width of the head, in spacings: as in 2D. */
static const double SHORTEST = 3.0, LEAST_HEAD = 1.2;

/* The body's radius in radii of curvature: beyond 1 its sections would cross. */
static const double LARGEST_BEND = 0.7;

/* The line under a head turns by no more, radians: a cone bent further is a claw. */
static const double HEAD_TURNING = 0.6;

/* Parts of an arrow that are farther apart along it than this many head widths must be
 * APART head widths apart in space: the gap between two turns shows. */
static const double SEPARATE = 3.0, APART = 1.5;

double fg__arrow_widest_solid(double length)
{
  return WIDEST * length;
}

/* Samples with the radius of the free ball, limited by that of the curve. */
static fg_status place(fg__arc_samples *samples, fg_context *context,
                       const fg__streamline *line, const fg__interior *interior)
{
  double length = fg__streamline_length(line);
  int pieces = (int)ceil(2 * length / interior->spacing);
  pieces = pieces < FEWEST_SAMPLES ? FEWEST_SAMPLES : pieces;
  pieces = pieces > MOST_SAMPLES ? MOST_SAMPLES : pieces;
  fg_status status = fg__arc_samples_place(samples, context, line, pieces);
  for (int i = 0; i <= pieces && status == FG_STATUS_OK; i++) {
    fg__arc_sample *at = &samples->sample[i];
    at->clearance =
        fg__interior_distance(interior, at->position) - MARGIN * interior->spacing;
    double bend = i > 0 && i < pieces ? at[1].turning - at[-1].turning : 0;
    if (bend > 0)
      at->clearance = fmin(at->clearance, LARGEST_BEND * 2 * samples->step / bend);
  }
  return status;
}

/* Whether a cone ending at sample `tip` fits; *base is the last sample before it. */
static bool head_fits(const fg__arc_samples *samples, int tip, double width, int *base)
{
  double head = FG__SOLID_HEAD_LENGTH * width;
  *base = tip - (int)ceil(head / samples->step);
  if (*base < 0 ||
      samples->sample[tip].turning - samples->sample[*base].turning > HEAD_TURNING)
    return false;
  for (int i = tip; i >= *base; i--) {
    double behind = fmin((tip - i) * samples->step, head);
    if (samples->sample[i].clearance < FG__SOLID_HEAD_WIDTH / 2 * width * behind / head)
      return false;
  }
  return true;
}

/* The first sample of the longest body that ends at `base`: the body's radius grows
 * linearly from tail a to base b, and r(s) <= clearance(s) bounds a from below by
 * (s - share b) / (1 - share), share being the part of the growth that fits at s. */
static int find_tail(const fg__arc_samples *samples, int base, int tip, double width)
{
  double bound = 0, limit = samples->sample[tip].turning - FG__LARGEST_TURNING;
  int i = base;
  for (; i >= 0 && i >= bound && samples->sample[i].turning >= limit; i--) {
    double share = (2 * samples->sample[i].clearance / width - FG__SOLID_TAIL_WIDTH) /
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
static int clear_itself(const fg__arc_samples *samples, int tail, int tip, double width)
{
  double head = FG__SOLID_HEAD_WIDTH * width, wanted = APART * head;
  int apart = (int)ceil(SEPARATE * head / samples->step);
  for (int i = tip; i - apart >= tail; i--)
    for (int j = i - apart; j >= tail; j--)
      if (fg__distance(samples->sample[i].position, samples->sample[j].position) <
          wanted) {
        tail = j + 1;
        break;
      }
  return tail;
}

fg_status fg__arrow_fit_solid(fg__arrow *out, fg_context *context,
                              const fg__streamline *line, const fg__interior *interior,
                              fg__arc_samples *samples)
{
  *out = (fg__arrow){0};
  double length = fg__streamline_length(line), best = 0, deepest = 0;
  if (line->count < 2 || length < SHORTEST * interior->spacing)
    return FG_STATUS_OK;
  fg_status status = place(samples, context, line, interior);
  if (status != FG_STATUS_OK)
    return status;
  for (int i = 0; i < samples->count; i++)
    deepest = fmax(deepest, samples->sample[i].clearance);
  double least = LEAST_HEAD * interior->spacing / FG__SOLID_HEAD_WIDTH;
  const double most = fmin(length, fg__territory_longest(interior->territory));
  double width = fmin(WIDEST * most, 2 * deepest / FG__SOLID_HEAD_WIDTH);
  for (; width >= least; width *= NARROWER) {
    if (length * pow(width, FG__WIDTH_EXPONENT) <= best)
      break;
    for (int tip = samples->count - 1; tip > 0; tip--) {
      int base;
      if (tip * samples->step * pow(width, FG__WIDTH_EXPONENT) <= best)
        break;
      if (!head_fits(samples, tip, width, &base))
        continue;
      int tail = find_tail(samples, base, tip, width);
      int longest = (int)(fmin(width / SLIMMEST, most) / samples->step);
      tail = tip - tail > longest ? tip - longest : tail;
      double value = (tip - tail) * samples->step * pow(width, FG__WIDTH_EXPONENT);
      if (tail >= base || value <= best)
        continue;
      tail = clear_itself(samples, tail, tip, width);
      double taken = (tip - tail) * samples->step;
      value = taken * pow(width, FG__WIDTH_EXPONENT);
      if (value <= best || tail >= base || taken < SHORTEST * interior->spacing ||
          width > WIDEST * taken)
        continue;
      best = value;
      *out = (fg__arrow){.tail = tail * samples->step,
                         .tip = tip * samples->step,
                         .width = width,
                         .turning =
                             samples->sample[tip].turning - samples->sample[tail].turning,
                         .bending = 1};
    }
  }
  return FG_STATUS_OK;
}

fg_status fg__arrow_centerline_solid(double (**points)[3], int *count,
                                     fg_context *context,
                                     const fg__streamline *streamline,
                                     const fg__arrow *arrow, double spacing)
{
  double length = arrow->tip - arrow->tail;
  int pieces = (int)ceil(fmax(length / spacing, arrow->turning / LARGEST_TURN));
  pieces = pieces < FEWEST_PIECES ? FEWEST_PIECES : pieces;
  *points = fg__allocate((size_t)pieces + 1, sizeof **points);
  if (!*points)
    return fg__fail_memory(context, "an icon", ((size_t)pieces + 1) * sizeof **points);
  int hint = 0;
  for (int i = 0; i <= pieces; i++)
    fg__streamline_at(streamline, arrow->tail + length * i / pieces, &hint, (*points)[i],
                      NULL);
  *count = pieces + 1;
  return FG_STATUS_OK;
}
