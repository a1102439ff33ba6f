#include "place/line.h"

#include "base/memory.h"
#include "base/vector.h"
#include "place/angle.h"
#include "place/streamline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Error of a step in lambda, of a search and of a way round. */
static const double ERROR = 1e-3;
static const double ROUND_ERROR = 1e-5;

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

/* A sample that can not be reached is tried at halves of the way, this often. */
enum { HALVINGS = 3 };

typedef struct tracing {
  fg__place_tracing move;
  const fg__place_scale *scale;
  double wall; /* no nearer to one */
} tracing;

/* One end of a line as it grows. */
typedef fg__place_step tip;

/* Whether a line may go on to a place; adds up its turn. */
static bool accept(const tracing *with, tip *next, const tip *from)
{
  double turn[3], cosine = fg__dot(from->at.direction, next->at.direction);
  next->clearance = fg__place_clearance(with->move.domain, next->at.position);
  if (next->clearance < with->wall && next->clearance < from->clearance)
    return false;
  if (!(cosine > 0.0))
    return false;
  fg__cross(from->at.direction, next->at.direction, turn);
  double sine = fg__length(turn);
  if (sine > 0.0) {
    double angle = fg__place_arccos(cosine) / sine;
    for (int k = 0; k < 3; ++k)
      next->turned[k] = from->turned[k] + angle * turn[k];
  }
  return fg__length(next->turned) <= with->scale->turning;
}

static bool advance(tracing *with, tip *next, const tip *from, double way)
{
  *next = *from;
  return fg__place_move(&with->move, &next->at, &from->at, way) &&
         accept(with, next, from);
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
  return fg__dot(line->sample[first].at.direction, line->sample[last].at.direction) <
         BREAK_COSINE;
}

/* Removes the samples within `range` of the end. */
static void cut_break(side *line, double range)
{
  double end = line->at[line->count - 1] - range;
  while (line->count > 1 && line->at[line->count - 1] > end)
    --line->count;
}

/* Takes the next full step of a side, from those taken before where it is there. */
static bool step_on(side *line, tracing *with, fg__place_steps *steps, int which)
{
  const int n = line->count - 1;
  const double sign = which ? 1.0 : -1.0;
  tip *next = &line->sample[n + 1];
  if (n < steps->count[which]) {
    *next = steps->step[which][n];
    with->move.step = next->trial_step;
    return true;
  }
  if (!advance(with, next, &line->sample[n], sign * with->scale->sampling))
    return false;
  next->trial_step = with->move.step;
  steps->step[which][n] = *next;
  steps->count[which] = n + 1;
  return true;
}

static void trace_side(side *line, tracing *with, const tip *seed, double way,
                       fg__place_steps *steps, int which)
{
  const double sampling = with->scale->sampling, sign = which ? 1.0 : -1.0;
  double range = BREAK_RANGE * with->scale->lambda;
  line->sample[0] = *seed;
  line->at[0] = 0.0;
  line->count = 1;
  while (line->count < FG__PLACE_SAMPLES) {
    const tip *from = &line->sample[line->count - 1];
    tip *next = &line->sample[line->count];
    double done = line->at[line->count - 1], step = fg__least(sampling, way - done);
    int halving = 0;
    if (step < 0.05 * sampling)
      return;
    for (; halving < HALVINGS; ++halving, step /= 2.0)
      if (step < sampling ? advance(with, next, from, sign * step)
                          : step_on(line, with, steps, which))
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
  return subdomain ? fg__least(scale->clearance, 0.5 * subdomain->widest) : HUGE_VAL;
}

static double bend_between(const side *line, int first, int last)
{
  return fg__place_arccos(
      fg__dot(line->sample[first].at.direction, line->sample[last].at.direction));
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
                       const fg__place_scale *scale, const fg__place_seed *seed,
                       fg__place_steps *steps)
{
  tip start = {.at = {{0}, {0}}};
  double sampling = scale->sampling;
  tracing with = {{domain, ERROR * scale->lambda, sampling, BREAK_COSINE}, scale, 0.0};
  memcpy(start.at.position, seed->position, sizeof start.at.position);
  with.wall = fg__place_least_clearance(domain, scale, start.at.position);
  start.clearance = fg__place_clearance(domain, start.at.position);
  if (start.clearance < with.wall ||
      !fg__place_direction(domain, start.at.position, start.at.direction))
    return false;
  for (int n = 0; n < 2; ++n) {
    with.move.step = sampling;
    trace_side(&both[n], &with, &start, seed->way[n], steps, n);
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
static void take_samples(fg__place_line *out, const fg__place_scale *scale,
                         const side *line, int from, int step, int count)
{
  double inverse = 1.0 / scale->lambda;
  for (int n = 0, i = from; n < count && out->count < FG__PLACE_SAMPLES; ++n, i += step) {
    const tip *sample = &line->sample[i];
    double before = i > 0 ? line->at[i] - line->at[i - 1] : 0.0;
    double after = i + 1 < line->count ? line->at[i + 1] - line->at[i] : 0.0;
    for (int k = 0; k < 3; ++k) {
      out->position[k][out->count] =
          (float)((sample->at.position[k] - scale->origin[k]) * inverse);
      out->tangent[k][out->count] = (float)sample->at.direction[k];
    }
    out->share[out->count++] = (float)((before + after) / 2.0 / scale->sampling);
  }
}

void fg__place_trace(fg__place_line *out, const fg__place_domain *domain,
                     const fg__place_scale *scale, const fg__place_seed *seed)
{
  fg__place_steps steps;
  fg__place_no_steps(&steps);
  fg__place_trace_on(out, domain, scale, seed, &steps);
}

void fg__place_trace_on(fg__place_line *out, const fg__place_domain *domain,
                        const fg__place_scale *scale, const fg__place_seed *seed,
                        fg__place_steps *steps)
{
  side both[2];
  out->count = 0;
  if (!trace_both(both, domain, scale, seed, steps))
    return;
  take_samples(out, scale, &both[0], both[0].count - 1, -1, both[0].count);
  out->seed = out->count - 1;
  double first = both[1].count > 1 ? both[1].at[1] / 2.0 / scale->sampling : 0.0;
  out->share[out->seed] += (float)first;
  take_samples(out, scale, &both[1], 1, 1, both[1].count - 1);
  for (int n = 0; n < 2; ++n)
    out->way[n] = both[n].at[both[n].count - 1];
  out->length = out->way[0] + out->way[1];
}

bool fg__place_close(double *gap, double *diameter, const fg__place_domain *domain,
                     const fg__place_scale *scale, const double start[3], double radius)
{
  enum { STEPS = 400 };
  double step = radius * FG__PLACE_PI / 60.0;
  tracing with = {{domain, ROUND_ERROR * radius, step, BREAK_COSINE}, scale, 0.0};
  tip now = {.at = {{0}, {0}}}, next;
  memcpy(now.at.position, start, sizeof now.at.position);
  if (!fg__place_direction(domain, start, now.at.direction))
    return false;
  *diameter = 0.0;
  fg__place_scale all_round = *scale;
  all_round.turning = 4.0 * FG__PLACE_PI;
  with.scale = &all_round;
  for (int n = 0; n < STEPS; ++n) {
    if (!advance(&with, &next, &now, step))
      return false;
    now = next;
    *gap = fg__distance(now.at.position, start);
    *diameter = fg__most(*diameter, *gap);
    if (fg__length(now.turned) >= 2.0 * FG__PLACE_PI)
      return true;
  }
  return false;
}
