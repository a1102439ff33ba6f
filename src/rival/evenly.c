#include "rival/evenly.h"

#include "base/memory.h"
#include "rival/near.h"

#include <math.h>
#include <stdlib.h>

/* Points of a line, in separations: distances between lines are then known to a
 * five-hundredth. */
static const double POINT_SPACING = 0.0625;

/* Seeds are tried beside every so many points of a line. */
enum { SEED_STRIDE = 4 };

/* A hair more than the separation, so that rounding does not put a seed too near to the
 * very point it was made from. */
static const double BESIDE = 1 + 1e-9;

/* A line is near itself only beyond so many d_test along it: on a circle as wide as
 * d_test half of the way round is pi / 2 of it. */
static const double OWN_WAY = 1.6;

/* Limits that lines seldom meet: three turns, and the box four times. */
static const double MOST_TURNING = 18.9;
static const double MOST_LENGTH = 4;

/* Lines are traced so many separations either way, and farther only where there is room:
 * most meet another line before that. */
static const double FIRST_REACH = 12;

/* Placing ends in the search after so many separations; the number of lines jumps with
 * it, so that not every number can be had. */
enum { ATTEMPTS = 16 };

/* A number of lines is met when it is missed by less than this share. */
static const double CLOSE = 0.02;

/* How the number of lines falls with the separation: between 1 (all as long as the box)
 * and 2 (all as long as they are apart). */
static const double FALL = 1.2;

/* The points of one streamline. */
typedef struct points {
  double (*position)[2];
  double (*normal)[2];
  size_t position_capacity, normal_capacity;
  int count, seed;
  double step;
} points;

typedef struct placing {
  fg__evenly *evenly;
  fg_context *context;
  const fg__domain *domain;
  fg__near near;
  fg__streamline line;
  points now;        /* the line that is tried */
  double (*side)[2]; /* seeds that wait: first those of the first line */
  size_t side_capacity;
  int sides, next_side;
} placing;

fg_status fg__evenly_trace(fg__streamline *out, fg_context *context,
                           const fg__domain *domain, const double seed[2], double reach,
                           double *at_seed)
{
  fg__streamline_limits limits = {
      .step = domain->trace_step, .length = reach, .turning = MOST_TURNING};
  fg_status status =
      fg__streamline_trace(out, context, domain->field, &domain->all, seed, &limits);
  *at_seed = status == FG_STATUS_OK && out->count > 0 ? out->node[out->start].s : 0;
  return status;
}

/* Points at even arc lengths from the seed. */
static fg_status find_points(placing *work, double at_seed)
{
  points *now = &work->now;
  now->step = POINT_SPACING * work->evenly->separation;
  now->seed = (int)floor(at_seed / now->step);
  double length = fg__streamline_length(&work->line);
  now->count = now->seed + 1 + (int)floor((length - at_seed) / now->step);
  if (!fg__grow((void **)&now->position, &now->position_capacity, (size_t)now->count,
                sizeof *now->position) ||
      !fg__grow((void **)&now->normal, &now->normal_capacity, (size_t)now->count,
                sizeof *now->normal))
    return fg__fail_memory(work->context, "a line's points",
                           (size_t)now->count * 2 * sizeof *now->position);
  int hint = 0;
  for (int i = 0; i < now->count; i++) {
    double tangent[2];
    fg__streamline_at(&work->line, at_seed + (i - now->seed) * now->step, &hint,
                      now->position[i], tangent);
    now->normal[i][0] = -tangent[1];
    now->normal[i][1] = tangent[0];
  }
  return FG_STATUS_OK;
}

/* Goes on from the seed one way while there is room; returns the last point. */
static fg_status go(placing *work, int direction, int *last)
{
  const points *now = &work->now;
  double test = FG__EVENLY_TEST * work->evenly->separation;
  int line = work->evenly->count;
  *last = now->seed;
  for (int i = now->seed + direction; i >= 0 && i < now->count; i += direction) {
    double s = (i - now->seed) * now->step;
    if (fg__near_has(&work->near, now->position[i], test, line, s, OWN_WAY * test))
      break;
    fg_status status =
        fg__near_add(&work->near, work->context, now->position[i], line, s);
    if (status != FG_STATUS_OK)
      return status;
    *last = i;
  }
  return FG_STATUS_OK;
}

/* Both sides of a new line's points wait to be tried as seeds. */
static fg_status add_sides(placing *work, int first, int last)
{
  const points *now = &work->now;
  size_t most = (size_t)work->sides + 2 * ((size_t)(last - first) / SEED_STRIDE + 1);
  if (!fg__grow((void **)&work->side, &work->side_capacity, most, sizeof *work->side))
    return fg__fail_memory(work->context, "seeds", most * sizeof *work->side);
  double away = BESIDE * work->evenly->separation;
  for (int i = first; i <= last; i += SEED_STRIDE)
    for (int sign = -1; sign <= 1; sign += 2, work->sides++)
      for (int k = 0; k < 2; k++)
        work->side[work->sides][k] =
            now->position[i][k] + sign * away * now->normal[i][k];
  return FG_STATUS_OK;
}

/* Keeps the tried line, or forgets its points when it is short. */
static fg_status keep(placing *work, const double seed[2], int first, int last,
                      int points_before)
{
  fg__evenly *evenly = work->evenly;
  if ((last - first) * work->now.step < FG__EVENLY_SHORTEST * evenly->separation) {
    fg__near_forget(&work->near, points_before);
    return FG_STATUS_OK;
  }
  if (!fg__grow((void **)&evenly->line, &evenly->capacity, (size_t)evenly->count + 1,
                sizeof *evenly->line))
    return fg__fail_memory(work->context, "lines",
                           ((size_t)evenly->count + 1) * sizeof *evenly->line);
  evenly->line[evenly->count++] =
      (fg__evenly_line){.seed = {seed[0], seed[1]},
                        .from = (first - work->now.seed) * work->now.step,
                        .to = (last - work->now.seed) * work->now.step};
  return add_sides(work, first, last);
}

/* Traces and cuts the line through a seed, as far as `reach` either way; *whole: no part
 * of it lies beyond. */
static fg_status try_line(placing *work, const double seed[2], double reach, int *first,
                          int *last, bool *whole)
{
  double at_seed;
  fg_status status =
      fg__evenly_trace(&work->line, work->context, work->domain, seed, reach, &at_seed);
  *first = *last = 0;
  *whole = true;
  if (status != FG_STATUS_OK || work->line.count < 2)
    return status;
  status = find_points(work, at_seed);
  if (status == FG_STATUS_OK)
    status = fg__near_add(&work->near, work->context, seed, work->evenly->count, 0);
  if (status == FG_STATUS_OK)
    status = go(work, 1, last);
  if (status == FG_STATUS_OK)
    status = go(work, -1, first);
  *whole = !(work->line.end[0] == FG__STREAMLINE_LONG && *first == 0) &&
           !(work->line.end[1] == FG__STREAMLINE_LONG && *last == work->now.count - 1);
  return status;
}

static fg_status try_seed(placing *work, const double seed[2])
{
  fg__evenly *evenly = work->evenly;
  const fg__domain *domain = work->domain;
  if (!fg__domain_moves(domain, seed) ||
      fg__near_has(&work->near, seed, evenly->separation, -1, 0, 0))
    return FG_STATUS_OK;
  double most = MOST_LENGTH * (domain->cells[0] * domain->spacing[0] +
                               domain->cells[1] * domain->spacing[1]);
  double reach = FIRST_REACH * evenly->separation;
  int points_before = work->near.count, first = 0, last = 0;
  bool whole = false;
  fg_status status = FG_STATUS_OK;
  while (!whole && status == FG_STATUS_OK) {
    fg__near_forget(&work->near, points_before);
    status = try_line(work, seed, fmin(reach, most), &first, &last, &whole);
    whole = whole || reach >= most;
    reach *= 4;
  }
  if (status == FG_STATUS_OK && last > first)
    status = keep(work, seed, first, last, points_before);
  else
    fg__near_forget(&work->near, points_before);
  return status == FG_STATUS_OK ? fg__check_stop(work->context) : status;
}

static fg_status try_sides(placing *work)
{
  fg_status status = FG_STATUS_OK;
  while (work->next_side < work->sides && status == FG_STATUS_OK) {
    const double *side = work->side[work->next_side++];
    const double seed[2] = {side[0], side[1]}; /* the list may move */
    status = try_seed(work, seed);
  }
  return status;
}

/* The cell where the flow is fastest; the first of equal ones. */
static int fastest_cell(const fg__domain *domain)
{
  double fastest = -1;
  int found = 0;
  for (int i = 0; i < domain->cells[0] * domain->cells[1]; i++) {
    double center[2], velocity[3];
    fg__domain_center(domain, i, center);
    if (!domain->valid[i] || !fg_field_velocity(domain->field, center, velocity))
      continue;
    double speed = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    if (speed > fastest) {
      fastest = speed;
      found = i;
    }
  }
  return found;
}

static fg_status place_all(placing *work)
{
  const fg__domain *domain = work->domain;
  double seed[2];
  fg__domain_center(domain, fastest_cell(domain), seed);
  fg_status status = try_seed(work, seed);
  if (status == FG_STATUS_OK)
    status = try_sides(work);
  /* what no line passes: parts behind masks, and places beside short lines */
  for (int i = 0; i < domain->cells[0] * domain->cells[1] && status == FG_STATUS_OK;
       i++) {
    if (!domain->valid[i])
      continue;
    fg__domain_center(domain, i, seed);
    status = try_seed(work, seed);
    if (status == FG_STATUS_OK)
      status = try_sides(work);
  }
  return status;
}

fg_status fg__evenly_place(fg__evenly *out, fg_context *context, const fg__domain *domain,
                           double separation)
{
  out->count = 0;
  out->separation = separation;
  placing work = {.evenly = out, .context = context, .domain = domain};
  fg_status status = fg__near_create(&work.near, context, domain, separation);
  if (status == FG_STATUS_OK)
    status = place_all(&work);
  fg__near_clear(&work.near);
  fg__streamline_clear(&work.line);
  free(work.now.position);
  free(work.now.normal);
  free(work.side);
  return status;
}

void fg__evenly_clear(fg__evenly *evenly)
{
  free(evenly->line);
  *evenly = (fg__evenly){0};
}

/* Nearer to the number, and of two as near the one with fewer lines. */
static bool is_better(int count, int best, int wanted)
{
  int miss = abs(count - wanted), least = abs(best - wanted);
  return best < 0 || miss < least || (miss == least && count < best);
}

/* The next separation to try: by the law of fall, or between those known to give too many
 * and too few. */
static double next_separation(double separation, int lines, int count, double low,
                              double high)
{
  double guess = separation * pow(fmax(lines, 0.5) / count, 1 / FALL);
  if (guess > low && guess < high)
    return guess;
  return low > 0 && high < HUGE_VAL ? sqrt(low * high) : guess;
}

fg_status fg__evenly_search(fg__evenly *out, fg_context *context,
                            const fg__domain *domain, int count)
{
  fg__evenly tried = {0};
  double separation = sqrt(domain->area / count) / 2, low = 0, high = HUGE_VAL;
  int best = -1;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < ATTEMPTS && (best < 0 || abs(best - count) > CLOSE * count); i++) {
    status = fg__evenly_place(&tried, context, domain, separation);
    if (status != FG_STATUS_OK)
      break;
    int lines = tried.count;
    if (is_better(lines, best, count)) {
      fg__evenly other = *out;
      *out = tried;
      tried = other;
      best = lines;
    }
    if (lines > count)
      low = fmax(low, separation);
    else
      high = fmin(high, separation);
    separation = next_separation(separation, lines, count, low, high);
  }
  fg__evenly_clear(&tried);
  return status;
}
