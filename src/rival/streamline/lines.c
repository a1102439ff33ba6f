#include "rival/streamline/lines.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of a line, in separations, in 2D and 3D: distances of half a separation are then
 * known to a five-hundredth and a hundredth. */
static const double POINT_SPACING = 0.0625, POINT_SPACING_IN_SPACE = 0.125;

/* A line is near itself only beyond so many test distances along it: on a circle as wide
 * as that, half of the way round is pi / 2 of it. */
static const double OWN_WAY = 1.6;

/* Limits that lines seldom meet: three turns, and the box four times. */
static const double MOST_TURNING = 18.9;
static const double MOST_LENGTH = 4;

/* Lines are traced so many separations either way, and farther only where there is room:
 * most meet another line before that. */
static const double FIRST_REACH = 12;

void fg__lines_clear(fg__lines *lines)
{
  free(lines->part);
  *lines = (fg__lines){0};
}

fg_status fg__lines_trace(fg__line *out, fg_context *context, const fg__domain *domain,
                          const fg__lines *lines, const double seed[], double reach)
{
  const fg__line_limits limits = {.length = reach, .turning = MOST_TURNING};
  const fg__extent room =
      lines->round ? fg__domain_all(domain) : fg__domain_room(domain, seed, 0);
  return fg__line_trace(out, context, domain, &room, seed, &limits);
}

fg_status fg__placing_start(fg__placing *out, fg_context *context,
                            const fg__domain *domain, fg__lines *lines, double separation,
                            double test, bool round)
{
  lines->count = 0;
  lines->round = round;
  lines->separation = separation;
  *out = (fg__placing){
      .lines = lines, .context = context, .domain = domain, .test = test * separation};
  return fg__near_create(&out->near, context, domain, separation);
}

void fg__placing_end(fg__placing *placing)
{
  fg__near_clear(&placing->near);
  fg__line_clear(&placing->line);
  free(placing->points.position);
  free(placing->points.tangent);
  *placing = (fg__placing){0};
}

static fg_status find_points(fg__placing *placing)
{
  const fg__line *line = &placing->line;
  fg__lines_points *points = &placing->points;
  points->step = placing->lines->separation *
                 (line->traced.dimension == 2 ? POINT_SPACING : POINT_SPACING_IN_SPACE);
  points->seed = (int)floor(line->start / points->step);
  double length = fg__line_length(line);
  points->count = points->seed + 1 + (int)floor((length - line->start) / points->step);
  size_t count = (size_t)points->count;
  if (!fg__grow((void **)&points->position, &points->position_capacity, count,
                sizeof *points->position) ||
      !fg__grow((void **)&points->tangent, &points->tangent_capacity, count,
                sizeof *points->tangent))
    return fg__fail_memory(placing->context, "a line's points",
                           count * 2 * sizeof *points->position);
  int hint = 0;
  for (int i = 0; i < points->count; i++)
    fg__line_at(line, line->start + (i - points->seed) * points->step, &hint,
                points->position[i], points->tangent[i]);
  return FG_STATUS_OK;
}

/* Goes on from the seed one way while there is room; returns the last point. */
static fg_status go(fg__placing *placing, int direction, int *last)
{
  const fg__lines_points *points = &placing->points;
  int line = placing->lines->count;
  *last = points->seed;
  for (int i = points->seed + direction; i >= 0 && i < points->count; i += direction) {
    double s = (i - points->seed) * points->step;
    if (fg__near_has(&placing->near, points->position[i], placing->test, line, s,
                     OWN_WAY * placing->test))
      break;
    fg_status status =
        fg__near_add(&placing->near, placing->context, points->position[i], line, s);
    if (status != FG_STATUS_OK)
      return status;
    *last = i;
  }
  return FG_STATUS_OK;
}

/* Keeps the tried line, or forgets its points when it is short. */
static fg_status keep(fg__placing *placing, const double seed[], int points_before,
                      bool *kept)
{
  fg__lines *lines = placing->lines;
  const fg__lines_points *points = &placing->points;
  if ((placing->last - placing->first) * points->step <
      FG__LINES_SHORTEST * lines->separation) {
    fg__near_forget(&placing->near, points_before);
    return FG_STATUS_OK;
  }
  if (!fg__grow((void **)&lines->part, &lines->capacity, (size_t)lines->count + 1,
                sizeof *lines->part))
    return fg__fail_memory(placing->context, "lines",
                           ((size_t)lines->count + 1) * sizeof *lines->part);
  fg__lines_part *part = &lines->part[lines->count++];
  *part = (fg__lines_part){.from = (placing->first - points->seed) * points->step,
                           .to = (placing->last - points->seed) * points->step};
  for (int k = 0; k < placing->domain->dimension; k++)
    part->seed[k] = seed[k];
  *kept = true;
  return FG_STATUS_OK;
}

/* Traces and cuts the line through a seed, as far as `reach` either way; *whole: no part
 * of it lies beyond. */
static fg_status try_line(fg__placing *placing, const double seed[], double reach,
                          bool *whole)
{
  const fg__line *line = &placing->line;
  fg_status status = fg__lines_trace(&placing->line, placing->context, placing->domain,
                                     placing->lines, seed, reach);
  placing->first = placing->last = 0;
  *whole = true;
  if (status != FG_STATUS_OK || line->count < 2)
    return status;
  status = find_points(placing);
  if (status == FG_STATUS_OK)
    status =
        fg__near_add(&placing->near, placing->context, seed, placing->lines->count, 0);
  if (status == FG_STATUS_OK)
    status = go(placing, 1, &placing->last);
  if (status == FG_STATUS_OK)
    status = go(placing, -1, &placing->first);
  *whole = !(line->goes_on[0] && placing->first == 0) &&
           !(line->goes_on[1] && placing->last == placing->points.count - 1);
  return status;
}

fg_status fg__placing_try(fg__placing *placing, const double seed[], bool *kept)
{
  const fg__domain *domain = placing->domain;
  double separation = placing->lines->separation;
  *kept = false;
  if (!fg__domain_moves(domain, seed) ||
      fg__near_has(&placing->near, seed, separation, -1, 0, 0))
    return FG_STATUS_OK;
  double most = 0, reach = FIRST_REACH * separation;
  for (int k = 0; k < domain->dimension; k++)
    most += MOST_LENGTH * (domain->cells[k] * domain->spacing[k]);
  int points_before = placing->near.count;
  bool whole = false;
  fg_status status = FG_STATUS_OK;
  while (!whole && status == FG_STATUS_OK) {
    fg__near_forget(&placing->near, points_before);
    status = try_line(placing, seed, fmin(reach, most), &whole);
    whole = whole || reach >= most;
    reach *= 4;
  }
  if (status == FG_STATUS_OK && placing->last > placing->first)
    status = keep(placing, seed, points_before, kept);
  else
    fg__near_forget(&placing->near, points_before);
  return status == FG_STATUS_OK ? fg__check_stop(placing->context) : status;
}
