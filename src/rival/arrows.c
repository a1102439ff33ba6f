#include "rival/arrows.h"

#include "base/memory.h"
#include "base/vector.h"
#include "icon/arrow.h"
#include "icon/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A shorter arrow is too small, in cells. */
static const double SHORTEST = 1.0;

/* What straight pieces of a bent arrow are shorter by, at most, for which it is not too
 * small. */
static const double ROUNDING = 0.01;

/* Where a straight arrow meets a mask is found by steps of this share of a cell. */
static const double CUT_STEP = 0.125;

/* The point so far from another along a direction. */
static void go(const fg__domain *domain, const double from[], double way,
               const double ahead[3], double point[3])
{
  point[2] = 0;
  for (int k = 0; k < domain->dimension; k++)
    point[k] = from[k] + way * ahead[k];
}

/* How far one can go straight on inside the domain, at most `reach`; sign: with the
 * direction or against it. */
static double free_way(const fg__domain *domain, const double from[],
                       const double ahead[3], double sign, double reach)
{
  double step = CUT_STEP * fg__domain_cell_size(domain), way = 0, velocity[3], point[3];
  while (way < reach) {
    double next = fmin(way + step, reach);
    go(domain, from, sign * next, ahead, point);
    if (!fg_field_velocity(domain->field, point, velocity))
      break;
    way = next;
  }
  return way;
}

/* Sets what follows from the points: widths, center (nearest to `middle`), speed. */
static void finish(fg_icon *icon, const fg__domain *domain, const double middle[],
                   double width)
{
  double near[3] = {0};
  memcpy(near, middle, (size_t)domain->dimension * sizeof *near);
  fg__icon_set_width(icon, domain->dimension, width);
  fg__icon_set_center(icon, near);
  icon->speed = fg__icon_mean_speed(domain->field, icon);
}

fg_status fg__rival_straight(fg_icon *icon, fg_context *context, const fg__domain *domain,
                             const double middle[], double length)
{
  enum { POINTS = 9 }; /* so that the mean speed is one */
  double ahead[3];
  icon->points = NULL;
  if (!fg__domain_flow(domain, middle, ahead))
    return FG_STATUS_OK;
  double tail = free_way(domain, middle, ahead, -1, length / 2);
  double tip = free_way(domain, middle, ahead, 1, length / 2);
  if (tail + tip < SHORTEST * fg__domain_cell_size(domain))
    return FG_STATUS_OK;
  double(*points)[3] = fg__allocate(POINTS, sizeof *points);
  if (!points)
    return fg__fail_memory(context, "an arrow", POINTS * sizeof *points);
  for (int i = 0; i < POINTS; i++)
    go(domain, middle, (tail + tip) * i / (POINTS - 1) - tail, ahead, points[i]);
  icon->points = (const double(*)[3])points;
  icon->point_count = POINTS;
  icon->kind = FG_ICON_ARROW;
  finish(icon, domain, middle, FG__RIVAL_WIDTH * (tail + tip));
  return FG_STATUS_OK;
}

/* Moves points by whole periods so that `middle`, which goes with them, lies in the box.
 */
static void move_into_box(double (*points)[3], int count, double middle[3],
                          const fg__domain *domain)
{
  int turns[3];
  fg__domain_turns(domain, middle, turns);
  for (int k = 0; k < domain->dimension; k++) {
    double way = turns[k] * domain->period[k];
    middle[k] -= way;
    for (int i = 0; i < count; i++)
      points[i][k] -= way;
  }
}

/* Whether a piece of a polyline lies in the domain: its ends and its middle do. */
static bool is_inside(const fg__domain *domain, const double p[3], const double q[3])
{
  double tangent[3], middle[3];
  for (int k = 0; k < 3; k++)
    middle[k] = (p[k] + q[k]) / 2;
  return fg_field_tangent(domain->field, p, tangent) &&
         fg_field_tangent(domain->field, middle, tangent) &&
         fg_field_tangent(domain->field, q, tangent);
}

/* Keeps the longest run of points that nowhere leaves the domain: a tracer's step can
 * cross the corner of a mask. Returns its length. */
static double keep_inside(double (*points)[3], int *count, const fg__domain *domain)
{
  int first = 0, kept = 0, begin = 0;
  double longest = 0, length = 0;
  for (int i = 1; i < *count; i++) {
    if (!is_inside(domain, points[i - 1], points[i])) {
      begin = i;
      length = 0;
      continue;
    }
    length += fg__distance(points[i], points[i - 1]);
    if (length > longest) {
      longest = length;
      first = begin;
      kept = i - begin + 1;
    }
  }
  memmove(points, points + first, (size_t)kept * sizeof *points);
  *count = kept;
  return longest;
}

fg_status fg__rival_piece(fg_icon *icon, fg_context *context, const fg__domain *domain,
                          const fg__line *line, double from, double to, double width)
{
  double size = fg__domain_cell_size(domain);
  icon->points = NULL;
  if (!(to - from >= SHORTEST * size))
    return FG_STATUS_OK;
  double(*points)[3] = NULL;
  fg_status status =
      fg__line_points(&points, &icon->point_count, context, line, from, to, size);
  icon->points = (const double(*)[3])points;
  if (status != FG_STATUS_OK || !points)
    return status;
  if (keep_inside(points, &icon->point_count, domain) < (SHORTEST - ROUNDING) * size) {
    fg__rival_free_points(icon);
    return FG_STATUS_OK;
  }
  icon->kind = fg__icon_kind_of(fg__line_turning(line, from, to));
  double middle[3], tangent[3];
  fg__line_at(line, (from + to) / 2, NULL, middle, tangent);
  move_into_box(points, icon->point_count, middle, domain);
  finish(icon, domain, middle, width);
  return FG_STATUS_OK;
}

fg_status fg__rival_curved(fg_icon *icon, fg_context *context, const fg__domain *domain,
                           const double middle[], double length, fg__line *line)
{
  const fg__line_limits limits = {.length = length / 2,
                                  .turning = FG__LARGEST_TURNING / 2};
  double head = domain->dimension == 2 ? FG__HEAD_WIDTH : FG__SOLID_HEAD_WIDTH;
  fg__extent room = fg__domain_room(domain, middle, head / 2 * FG__RIVAL_WIDTH * length);
  icon->points = NULL;
  fg_status status = fg__line_trace(line, context, domain, &room, middle, &limits);
  if (status != FG_STATUS_OK || line->count < 2)
    return status;
  double from = fmax(line->start - length / 2, 0);
  double to = fmin(line->start + length / 2, fg__line_length(line));
  return fg__rival_piece(icon, context, domain, line, from, to,
                         FG__RIVAL_WIDTH * (to - from));
}

void fg__rival_free_points(fg_icon *icon)
{
  free((void *)(uintptr_t)icon->points);
  icon->points = NULL;
}
