#include "place/line.h"

#include "base/memory.h"
#include "base/vector.h"
#include "place/angle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Local error of a step in lambda, and the longest step in cells of the data: the field
 * is linear between samples, with kinks at them. */
static const double ERROR = 1e-3;
static const double FINE_ERROR = 1e-5;
static const double LONGEST_STEP = 4.0;

/* A line ends before it turns by this angle over this share of lambda: a head there would
 * be broken. */
static const double BREAK_COSINE = 0.25881904510252074; /* 75 degrees */
static const double BREAK_RANGE = 0.15;

/* A head lies on so much of the line, too; one that would bend by this angle, and so many
 * times as much as the line before it, ends earlier, by so many samples at most. */
static const double HEAD_BEND = 40.0 * FG__PLACE_PI / 180.0;
static const double UNEVEN = 1.5;
enum { MOST_HEAD_CUTS = 4 };

/* Nor does it lie just behind an elbow: a line ends before it bends by this angle less
 * than so much before its end, in lambda. */
static const double ELBOW = 60.0 * FG__PLACE_PI / 180.0;
static const double HOOK = 0.4;

/* A line traced finely that ends farther than so many lambda from the coarse one has met
 * a place where the flow turns over within a step. */
static const double MOST_APART = 0.05;

/* Of a line for a picture so few points are kept that straight pieces between them leave
 * it by this at most, in lambda, and its direction by this. A piece replaces so many at
 * most. */
static const double STRAIGHT = 1e-4;
static const double STRAIGHT_COSINE = 0.99997563070539; /* two fifths of a degree */
enum { MOST_STRAIGHT = 32 };

/* A sample that can not be reached is tried at halves of the way, this often. */
enum { HALVINGS = 3, MOST_STEPS = 64 };

/* So many steps a sample has a line for a picture, more up to the second number where a
 * step would turn by more than this. */
enum { FINE_EVERY = 8, FINEST_EVERY = 64, MOST_FINE = FG__PLACE_SAMPLES * FINEST_EVERY };
static const double FINE_TURN_COSINE = 0.99939082701910; /* two degrees */

typedef struct tracing {
  const fg__place_domain *domain;
  const fg__place_scale *scale;
  double error; /* local, input coordinates */
  double step;  /* the last accepted one */
  double wall;  /* no nearer to one */
  bool follows; /* a line that was found before: it ends by its ways alone */
} tracing;

/* One end of a line as it grows. */
typedef struct tip {
  double position[3];
  double direction[3]; /* the flow's, whichever way the tip goes */
  double clearance;
  double turned[3]; /* sum of turns as vectors, radians */
} tip;

static bool advance_stage(const tracing *with, double out[3], const double from[3],
                          const double slope[3], double step)
{
  double place[3];
  for (int k = 0; k < 3; ++k)
    place[k] = from[k] + step * slope[k];
  return fg__place_direction(with->domain, place, out) &&
         fg__dot(out, slope) > 0.0; /* else it reverses */
}

/* One step of the pair, to `out`; false where a stage falls outside or turns back. */
static bool try_step(const tracing *with, tip *out, double *error, const tip *from,
                     double step)
{
  double k2[3], k3[3], k4[3], mean[3];
  const double *k1 = from->direction;
  if (!advance_stage(with, k2, from->position, k1, 0.5 * step) ||
      !advance_stage(with, k3, from->position, k2, 0.75 * step))
    return false;
  for (int k = 0; k < 3; ++k)
    mean[k] = (2.0 * k1[k] + 3.0 * k2[k] + 4.0 * k3[k]) / 9.0;
  if (!advance_stage(with, k4, from->position, mean, step))
    return false;
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    double off = step * (-5.0 / 72.0 * k1[k] + k2[k] / 12.0 + k3[k] / 9.0 - k4[k] / 8.0);
    square += off * off;
    out->position[k] = from->position[k] + step * mean[k];
    out->direction[k] = k4[k];
  }
  *error = sqrt(square);
  return true;
}

/* Moves a tip by an arc length, negative against the flow, in as many steps as it takes.
 * False where it can not go on or, in a search, where the line breaks between samples. */
static bool move(tracing *with, tip *out, const tip *from, double way)
{
  double sign = way < 0.0 ? -1.0 : 1.0, left = fabs(way);
  double most = LONGEST_STEP * with->domain->data_step;
  *out = *from;
  for (int n = 0; n < MOST_STEPS && left > 0.0; ++n) {
    double step = fmin(fmin(with->step, most), left), error;
    tip next = *out;
    if (!try_step(with, &next, &error, out, sign * step))
      return false;
    double grow = error > 0.0 ? 0.9 * sqrt(with->error / error) : 2.0;
    if (error > with->error && n + 1 < MOST_STEPS / 2) {
      with->step = step * fmax(0.3, grow);
      continue;
    }
    if (step < left || grow < 1.0) /* one cut short by the sample says little */
      with->step = step * fmin(fmax(grow, 0.5), 2.0);
    else
      with->step = fmax(with->step, step * fmin(grow, 2.0));
    if (!with->follows && fg__dot(next.direction, from->direction) < BREAK_COSINE)
      return false;
    *out = next;
    left = step < left ? left - step : 0.0;
  }
  return left <= 0.0;
}

/* Whether a line may go on to a place; adds up its turn. */
static bool accept(const tracing *with, tip *next, const tip *from)
{
  double turn[3], cosine = fg__dot(from->direction, next->direction);
  next->clearance = fg__place_clearance(with->domain, next->position);
  if (next->clearance < with->wall && next->clearance < from->clearance)
    return false;
  if (!(cosine > 0.0))
    return false;
  fg__cross(from->direction, next->direction, turn);
  double sine = fg__length(turn);
  if (sine > 0.0) {
    double angle = fg__place_arccos(cosine) / sine;
    for (int k = 0; k < 3; ++k)
      next->turned[k] = from->turned[k] + angle * turn[k];
  }
  return fg__length(next->turned) <= with->scale->turning;
}

/* A side's samples, the seed's first. */
typedef struct side {
  tip sample[FG__PLACE_SAMPLES];
  double at[FG__PLACE_SAMPLES]; /* arc length from the seed */
  int count;
} side;

/* The last sample at least `range` before sample `last`; 0 where there is none. */
static int sample_before(const side *line, int last, double range)
{
  int first = last;
  while (first > 0 && line->at[last] - line->at[first] < range)
    --first;
  return first;
}

/* Whether the line turns back within `range` of its end. */
static bool breaks(const side *line, double range)
{
  const int last = line->count - 1, first = sample_before(line, last, range);
  return fg__dot(line->sample[first].direction, line->sample[last].direction) <
         BREAK_COSINE;
}

/* Removes the samples within `range` of the end. */
static void cut_break(side *line, double range)
{
  double end = line->at[line->count - 1] - range;
  while (line->count > 1 && line->at[line->count - 1] > end)
    --line->count;
}

static void trace_side(side *line, tracing *with, const tip *seed, double sign,
                       double way, double sampling)
{
  double range = BREAK_RANGE * with->scale->lambda;
  line->sample[0] = *seed;
  line->at[0] = 0.0;
  line->count = 1;
  while (line->count < FG__PLACE_SAMPLES) {
    const tip *from = &line->sample[line->count - 1];
    tip *next = &line->sample[line->count];
    double done = line->at[line->count - 1], step = fmin(sampling, way - done);
    int halving = 0;
    if (step < 0.05 * sampling)
      return;
    for (; halving < HALVINGS; ++halving, step /= 2.0)
      if (move(with, next, from, sign * step) && accept(with, next, from))
        break;
    if (halving == HALVINGS)
      return;
    line->at[line->count++] = done + step;
    if (breaks(line, range)) {
      cut_break(line, range);
      return;
    }
    if (halving > 0)
      return;
  }
}

double fg__place_least_clearance(const fg__place_domain *domain,
                                 const fg__place_scale *scale, const double position[3])
{
  const fg__place_subdomain *subdomain = fg__place_subdomain_at(domain, position);
  return subdomain ? fmin(scale->clearance, 0.5 * subdomain->widest) : HUGE_VAL;
}

static double bend_between(const side *line, int first, int last)
{
  return fg__place_arccos(
      fg__dot(line->sample[first].direction, line->sample[last].direction));
}

/* Shortens the line where its end bends more than an arrowhead can, and more than the
 * piece before it: not on an even arc, as of a ring. */
static void straighten_head(side *line, double range)
{
  for (int n = 0; n < MOST_HEAD_CUTS && line->count > 2; ++n) {
    int last = line->count - 1, middle = sample_before(line, last, range);
    double bend = bend_between(line, middle, last);
    double before = bend_between(line, sample_before(line, middle, range), middle);
    if (bend < HEAD_BEND || bend < UNEVEN * before)
      return;
    --line->count;
  }
}

/* Removes a hook at the end: a sharp bend and the short piece behind it. */
static void cut_hook(side *line, double range, double hook)
{
  const double length = line->at[line->count - 1];
  for (int last = line->count - 1; line->at[last] > 2.0 * range; --last) {
    const int middle = sample_before(line, last, range);
    const int before = sample_before(line, middle, range);
    const double bend = bend_between(line, middle, last);
    int end = middle; /* the last sample before it bends */
    if (length - line->at[middle] > hook + range)
      return;
    if (bend < ELBOW || bend < UNEVEN * bend_between(line, before, middle))
      continue;
    while (bend_between(line, middle, end + 1) < 0.25 * ELBOW)
      ++end;
    if (length - line->at[end] < hook)
      line->count = end + 1;
    return;
  }
}

/* Both sides of a seed; false: no line can be here. */
static bool trace_both(side both[2], const fg__place_domain *domain,
                       const fg__place_scale *scale, const fg__place_seed *seed)
{
  tip start = {{0}, {0}, 0, {0}};
  double sampling = scale->sampling;
  tracing with = {domain, scale, ERROR * scale->lambda, sampling, 0.0, false};
  memcpy(start.position, seed->position, sizeof start.position);
  with.wall = fg__place_least_clearance(domain, scale, start.position);
  start.clearance = fg__place_clearance(domain, start.position);
  if (start.clearance < with.wall ||
      !fg__place_direction(domain, start.position, start.direction))
    return false;
  for (int n = 0; n < 2; ++n) {
    with.step = sampling;
    trace_side(&both[n], &with, &start, n ? 1.0 : -1.0, seed->way[n], sampling);
  }
  cut_hook(&both[1], BREAK_RANGE * scale->lambda, HOOK * scale->lambda);
  straighten_head(&both[1], BREAK_RANGE * scale->lambda);
  /* narrow seas may have short ones */
  double ends = both[0].at[both[0].count - 1] + both[1].at[both[1].count - 1];
  double shortest =
      with.wall < scale->clearance ? 0.7 * scale->shortest : scale->shortest;
  return ends >= shortest;
}

/* Adds `count` samples of a side, from `from` on by steps of 1 or -1. */
static void take_samples(fg__place_line *out, const fg__place_domain *domain,
                         const fg__place_scale *scale, const side *line, int from,
                         int step, int count)
{
  double inverse = 1.0 / scale->lambda;
  for (int n = 0, i = from; n < count && out->count < FG__PLACE_SAMPLES; ++n, i += step) {
    const tip *sample = &line->sample[i];
    double before = i > 0 ? line->at[i] - line->at[i - 1] : 0.0;
    double after = i + 1 < line->count ? line->at[i + 1] - line->at[i] : 0.0;
    for (int k = 0; k < 3; ++k) {
      out->position[k][out->count] =
          (float)((sample->position[k] - domain->low[k]) * inverse);
      out->tangent[k][out->count] = (float)sample->direction[k];
    }
    out->share[out->count++] = (float)((before + after) / 2.0 / scale->sampling);
  }
}

void fg__place_trace(fg__place_line *out, const fg__place_domain *domain,
                     const fg__place_scale *scale, const fg__place_seed *seed)
{
  side both[2];
  out->count = 0;
  if (!trace_both(both, domain, scale, seed))
    return;
  take_samples(out, domain, scale, &both[0], both[0].count - 1, -1, both[0].count);
  out->seed = out->count - 1;
  double first = both[1].count > 1 ? both[1].at[1] / 2.0 / scale->sampling : 0.0;
  out->share[out->seed] += (float)first;
  take_samples(out, domain, scale, &both[1], 1, 1, both[1].count - 1);
  for (int n = 0; n < 2; ++n)
    out->way[n] = both[n].at[both[n].count - 1];
  out->length = out->way[0] + out->way[1];
}

/* The place of a line's sample. */
static void place_of(double out[3], const fg__place_domain *domain,
                     const fg__place_scale *scale, const fg__place_line *line, int n)
{
  for (int k = 0; k < 3; ++k)
    out[k] = domain->low[k] + (double)line->position[k][n] * scale->lambda;
}

/* Adds the points of one side of a line behind those of `points`, in small steps. */
static void follow_side(double (*points)[3], int *count, tracing *with, const tip *seed,
                        double sign, double way)
{
  const double sampling = with->scale->sampling / FINE_EVERY;
  const double finest = with->scale->sampling / FINEST_EVERY;
  double left = way, step = sampling;
  tip now = *seed, next;
  with->step = sampling;
  while (left > 0.05 * sampling && *count < MOST_FINE) {
    step = fmin(step, left);
    bool reached = move(with, &next, &now, sign * step);
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
  tracing with = {domain, scale, FINE_ERROR * scale->lambda, 0.0, 0.0, true};
  double end[3];
  tip start = {{0}, {0}, 0, {0}};
  place_of(start.position, domain, scale, line, line->seed);
  if (!fg__place_direction(domain, start.position, start.direction))
    return false;
  memcpy(points[0], start.position, sizeof *points);
  *count = 1;
  for (int n = 0; n < 2; ++n) {
    follow_side(points, count, &with, &start, n ? 1.0 : -1.0, line->way[n]);
    place_of(end, domain, scale, line, n ? line->count - 1 : 0);
    if (fg__distance(end, points[*count - 1]) > MOST_APART * scale->lambda)
      return false;
    if (n == 0)
      turn_round(points, *count);
  }
  return true;
}

/* A point of the cubic through two samples with their tangents, `t` from 0 to 1. */
static void point_between(double out[3], const fg__place_domain *domain,
                          const fg__place_scale *scale, const fg__place_line *line, int n,
                          double t)
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
    out[k] = domain->low[k] + at * scale->lambda;
  }
}

/* The points of a line along the cubics through its samples. */
static void follow_samples(double (*points)[3], int *count,
                           const fg__place_domain *domain, const fg__place_scale *scale,
                           const fg__place_line *line)
{
  *count = (line->count - 1) * FINE_EVERY + 1;
  for (int i = 0; i < *count; ++i) {
    int n = i / FINE_EVERY < line->count - 1 ? i / FINE_EVERY : line->count - 2;
    point_between(points[i], domain, scale, line, n,
                  (double)(i - n * FINE_EVERY) / FINE_EVERY);
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
    follow_samples(*points, count, domain, scale, line);
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

bool fg__place_close(double *gap, double *diameter, const fg__place_domain *domain,
                     const fg__place_scale *scale, const double start[3], double radius)
{
  enum { STEPS = 400 };
  double step = radius * FG__PLACE_PI / 60.0;
  tracing with = {domain, scale, FINE_ERROR * radius, step, 0.0, true};
  tip now = {{0}, {0}, 0, {0}}, next;
  memcpy(now.position, start, sizeof now.position);
  if (!fg__place_direction(domain, start, now.direction))
    return false;
  *diameter = 0.0;
  with.follows = false; /* turns are added up, walls do not matter */
  with.wall = 0.0;
  fg__place_scale all_round = *scale;
  all_round.turning = 4.0 * FG__PLACE_PI;
  with.scale = &all_round;
  for (int n = 0; n < STEPS; ++n) {
    if (!move(&with, &next, &now, step) || !accept(&with, &next, &now))
      return false;
    now = next;
    *gap = fg__distance(now.position, start);
    *diameter = fmax(*diameter, *gap);
    if (fg__length(now.turned) >= 2.0 * FG__PLACE_PI)
      return true;
  }
  return false;
}
