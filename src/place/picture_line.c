/* The line of an icon as pictures draw it. */
#include "place/line.h"

#include "base/memory.h"
#include "base/vector.h"
#include "place/angle.h"
#include "place/streamline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Error of a step in lambda. */
static const double ERROR = 1e-5;

/* So many steps a sample has a line for a picture, more up to the second number where a
 * step would turn by more than this. */
enum { FINE_EVERY = 8, FINEST_EVERY = 64, MOST_FINE = FG__PLACE_SAMPLES * FINEST_EVERY };
static const double FINE_TURN_COSINE = 0.99939082701910; /* two degrees */

/* A line that ends farther than so many lambda from the coarse one has met
 * a place where the flow turns over within a step. */
static const double MOST_APART = 0.05;

/* Of a line for a picture so few points are kept that straight pieces between them leave
 * it by this at most, in lambda, and its direction by this. A piece replaces so many at
 * most. */
static const double STRAIGHT = 1e-4;
static const double STRAIGHT_COSINE = 0.99999390765779; /* a fifth of a degree */
enum { MOST_STRAIGHT = 32 };

/* The place of a line's sample. */
static void place_of(double out[3], const fg__place_scale *scale,
                     const fg__place_line *line, int n)
{
  for (int k = 0; k < 3; ++k)
    out[k] = scale->origin[k] + (double)line->position[k][n] * scale->lambda;
}

/* Adds the points of one side of a line behind those of `points`, in small steps. */
static void follow_side(double (*points)[3], int *count, fg__place_tracing *with,
                        const fg__place_scale *scale, const fg__place_tip *seed,
                        double sign, double way)
{
  const double sampling = scale->sampling / FINE_EVERY;
  const double finest = scale->sampling / FINEST_EVERY;
  double left = way, step = sampling;
  fg__place_tip now = *seed, next;
  with->step = sampling;
  while (left > 0.05 * sampling && *count < MOST_FINE) {
    step = fmin(step, left);
    bool reached = fg__place_move(with, &next, &now, sign * step);
    bool turns = reached && fg__dot(now.direction, next.direction) < FINE_TURN_COSINE;
    if ((turns || !reached) && step > finest) {
      step = fmax(0.5 * step, finest);
      continue;
    }
    if (!reached)
      return;
    memcpy(points[(*count)++], next.position, sizeof *points);
    left -= step;
    step = fmin(2.0 * step, sampling);
    now = next;
  }
}

/* Reverses the order of points. */
static void turn_round(double (*points)[3], int count)
{
  for (int n = 0; n < count / 2; ++n)
    for (int k = 0; k < 3; ++k) {
      double first = points[n][k];
      points[n][k] = points[count - 1 - n][k];
      points[count - 1 - n][k] = first;
    }
}

/* The points of a line in small steps; false where they do not end as the line does. */
static bool trace_finely(double (*points)[3], int *count, const fg__place_domain *domain,
                         const fg__place_scale *scale, const fg__place_line *line)
{
  fg__place_tracing with = {domain, ERROR * scale->lambda, 0.0, -1.0};
  fg__place_tip start = {{0}, {0}};
  double end[3];
  place_of(start.position, scale, line, line->seed);
  if (!fg__place_direction(domain, start.position, start.direction))
    return false;
  memcpy(points[0], start.position, sizeof *points);
  *count = 1;
  for (int n = 0; n < 2; ++n) {
    follow_side(points, count, &with, scale, &start, n ? 1.0 : -1.0, line->way[n]);
    place_of(end, scale, line, n ? line->count - 1 : 0);
    if (fg__distance(end, points[*count - 1]) > MOST_APART * scale->lambda)
      return false;
    if (n == 0)
      turn_round(points, *count);
  }
  return true;
}

/* A point of the cubic through two samples with their tangents, `t` from 0 to 1. */
static void point_between(double out[3], const fg__place_scale *scale,
                          const fg__place_line *line, int n, double t)
{
  double chord = 0.0, s = 1.0 - t;
  for (int k = 0; k < 3; ++k) {
    double off = (double)line->position[k][n + 1] - (double)line->position[k][n];
    chord += off * off;
  }
  chord = sqrt(chord);
  for (int k = 0; k < 3; ++k) {
    double from = (double)line->position[k][n], to = (double)line->position[k][n + 1];
    double slope = s * (double)line->tangent[k][n] - t * (double)line->tangent[k][n + 1];
    double at = s * s * (1.0 + 2.0 * t) * from + t * t * (1.0 + 2.0 * s) * to +
                s * t * chord * slope;
    out[k] = scale->origin[k] + at * scale->lambda;
  }
}

/* The points of a line along the cubics through its samples. */
static void follow_samples(double (*points)[3], int *count, const fg__place_scale *scale,
                           const fg__place_line *line)
{
  *count = (line->count - 1) * FINE_EVERY + 1;
  for (int i = 0; i < *count; ++i) {
    int n = i / FINE_EVERY < line->count - 1 ? i / FINE_EVERY : line->count - 2;
    point_between(points[i], scale, line, n, (double)(i - n * FINE_EVERY) / FINE_EVERY);
  }
}

/* Whether the chord between two points is within `most` of those between, which all go
 * forwards along it. */
static bool is_straight(const double (*points)[3], int from, int to, double most)
{
  double whole[3], off[3], piece[3], across[3];
  fg__subtract(points[to], points[from], whole);
  double length = fg__length(whole);
  for (int n = from; n < to; ++n) {
    fg__subtract(points[n], points[from], off);
    fg__subtract(points[n + 1], points[n], piece);
    fg__cross(whole, off, across);
    if (!(fg__length(across) <= most * length) ||
        !(fg__dot(whole, piece) >= STRAIGHT_COSINE * length * fg__length(piece)))
      return false;
  }
  return true;
}

/* Drops the points whose neighbours' chord is within `most` of them; returns how many are
 * left. */
static int keep_needed(double (*points)[3], int count, double most)
{
  int kept = 1;
  for (int from = 0, to; from < count - 1; from = to) {
    to = from + 1;
    while (to + 1 < count && to - from < MOST_STRAIGHT &&
           is_straight((const double(*)[3])points, from, to + 1, most))
      ++to;
    memmove(points[kept++], points[to], sizeof *points);
  }
  return kept;
}

fg_status fg__place_trace_fine(double (**points)[3], int *count, fg_context *context,
                               const fg__place_domain *domain,
                               const fg__place_scale *scale, const fg__place_line *line)
{
  *count = 0;
  *points = fg__allocate(MOST_FINE, sizeof **points);
  if (!*points)
    return fg__fail_memory(context, "a line", MOST_FINE * sizeof **points);
  if (!trace_finely(*points, count, domain, scale, line))
    follow_samples(*points, count, scale, line);
  *count = keep_needed(*points, *count, STRAIGHT * scale->lambda);
  return FG_STATUS_OK;
}

double fg__place_turning(const double (*points)[3], int count)
{
  double sum[3] = {0}, before[3] = {0};
  for (int n = 1; n < count; ++n) {
    double along[3], turn[3];
    fg__subtract(points[n], points[n - 1], along);
    double size = fg__length(along);
    if (!(size > 0.0))
      continue;
    for (int k = 0; k < 3; ++k)
      along[k] /= size;
    fg__cross(before, along, turn);
    double sine = fg__length(turn);
    double angle = fg__place_arccos(fg__dot(before, along));
    for (int k = 0; k < 3 && sine > 0.0; ++k)
      sum[k] += turn[k] * angle / sine;
    memcpy(before, along, sizeof before);
  }
  return fg__length(sum);
}
