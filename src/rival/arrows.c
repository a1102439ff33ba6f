#include "rival/arrows.h"

#include "base/memory.h"
#include "icon/arrow.h"
#include "icon/measure.h"

#include <math.h>
#include <stdlib.h>

/* A shorter arrow is a speck, in cells. */
static const double SHORTEST = 1.0;

/* Where a straight arrow meets a mask is found by steps of this share of a cell. */
static const double CUT_STEP = 0.125;

static double cell_size(const fg__domain *domain)
{
  return fmin(domain->spacing[0], domain->spacing[1]);
}

/* How far one can go straight on inside the domain, at most `reach`. */
static double free_way(const fg__domain *domain, const double from[2],
                       const double direction[2], double reach)
{
  double step = CUT_STEP * cell_size(domain), way = 0, velocity[3];
  while (way < reach) {
    double next = fmin(way + step, reach);
    double point[2] = {from[0] + next * direction[0], from[1] + next * direction[1]};
    if (!fg_field_velocity(domain->field, point, velocity))
      break;
    way = next;
  }
  return way;
}

/* Sets what follows from the points: widths, center (nearest to `middle`), speed. */
static void finish(fg_icon *icon, const fg__domain *domain, const double middle[2],
                   double width)
{
  fg__icon_set_width(icon, width);
  fg__icon_set_center(icon, middle);
  icon->speed = fg__icon_mean_speed(domain->field, icon);
}

fg_status fg__rival_straight(fg_icon *icon, fg_context *context, const fg__domain *domain,
                             const double middle[2], double length)
{
  enum { POINTS = 9 }; /* so that the mean speed is one */
  double tangent[3] = {0};
  icon->points = NULL;
  if (!fg_field_tangent(domain->field, middle, tangent))
    return FG_STATUS_OK;
  double size = hypot(tangent[0], tangent[1]);
  if (!(size > 0))
    return FG_STATUS_OK;
  double ahead[2] = {tangent[0] / size, tangent[1] / size};
  double back[2] = {-ahead[0], -ahead[1]};
  double tail = free_way(domain, middle, back, length / 2);
  double tip = free_way(domain, middle, ahead, length / 2);
  if (tail + tip < SHORTEST * cell_size(domain))
    return FG_STATUS_OK;
  double(*points)[3] = fg__allocate(POINTS, sizeof *points);
  if (!points)
    return fg__fail_memory(context, "an arrow", POINTS * sizeof *points);
  for (int i = 0; i < POINTS; i++) {
    double way = (tail + tip) * i / (POINTS - 1) - tail;
    for (int k = 0; k < 2; k++)
      points[i][k] = middle[k] + way * ahead[k];
  }
  icon->points = (const double(*)[3])points;
  icon->point_count = POINTS;
  icon->kind = FG_ICON_ARROW;
  finish(icon, domain, middle, FG__RIVAL_WIDTH * (tail + tip));
  return FG_STATUS_OK;
}

/* Moves points by whole periods so that `middle`, which goes with them, lies in the box.
 */
static void move_into_box(double (*points)[3], int count, double middle[2],
                          const fg__domain *domain)
{
  int turns[2];
  fg__domain_turns(domain, middle, turns);
  for (int k = 0; k < 2; k++) {
    double way = turns[k] * domain->period[k];
    middle[k] -= way;
    for (int i = 0; i < count; i++)
      points[i][k] -= way;
  }
}

fg_status fg__rival_piece(fg_icon *icon, fg_context *context, const fg__domain *domain,
                          const fg__streamline *line, double from, double to,
                          double width)
{
  icon->points = NULL;
  if (!(to - from >= SHORTEST * cell_size(domain)))
    return FG_STATUS_OK;
  fg__arrow arrow = {.tail = from, .tip = to};
  double(*points)[3] = NULL;
  fg_status status = fg__arrow_centerline(&points, &icon->point_count, context, line,
                                          &arrow, cell_size(domain));
  icon->points = (const double(*)[3])points;
  if (status != FG_STATUS_OK || !points)
    return status;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (int i = 0; i < line->count; i++)
    if (line->node[i].s >= from && line->node[i].s <= to) {
      lowest = fmin(lowest, line->node[i].turning);
      highest = fmax(highest, line->node[i].turning);
    }
  icon->kind = fg__icon_kind_of(highest > lowest ? highest - lowest : 0);
  double middle[2], tangent[2];
  fg__streamline_at(line, (from + to) / 2, NULL, middle, tangent);
  move_into_box(points, icon->point_count, middle, domain);
  finish(icon, domain, middle, width);
  return FG_STATUS_OK;
}

fg_status fg__rival_curved(fg_icon *icon, fg_context *context, const fg__domain *domain,
                           const double middle[2], double length, fg__streamline *line)
{
  fg__streamline_limits limits = {.step = domain->trace_step,
                                  .length = length / 2,
                                  .turning = FG__LARGEST_TURNING / 2};
  fg__window room =
      fg__domain_room(domain, middle, FG__HEAD_WIDTH / 2 * FG__RIVAL_WIDTH * length);
  icon->points = NULL;
  fg_status status =
      fg__streamline_trace(line, context, domain->field, &room, middle, &limits);
  if (status != FG_STATUS_OK || line->count < 2)
    return status;
  double start = line->node[line->start].s;
  double from = fmax(start - length / 2, 0);
  double to = fmin(start + length / 2, fg__streamline_length(line));
  return fg__rival_piece(icon, context, domain, line, from, to,
                         FG__RIVAL_WIDTH * (to - from));
}
