#include "rival/line.h"

#include "icon/arrow.h"

#include <math.h>
#include <string.h>

/* The tracer stops at the zero set of a level on a window: here one cell that is positive
 * all over. */
enum { CORNERS = 8 };

fg_status fg__line_trace(fg__line *out, fg_context *context, const fg__domain *domain,
                         const fg__extent *room, const double start[],
                         const fg__line_limits *limits)
{
  float level[CORNERS];
  unsigned char active = 1;
  fg__window all = {.dimension = domain->dimension,
                    .nodes = {2, 2, domain->dimension - 1},
                    .level = level,
                    .active = &active};
  for (int i = 0; i < CORNERS; i++)
    level[i] = 1;
  memcpy(all.origin, room->origin, sizeof all.origin);
  memcpy(all.spacing, room->side, sizeof all.spacing);
  const fg__streamline_limits within = {domain->trace_step, limits->length,
                                        limits->turning};
  fg__streamline *line = &out->traced;
  fg_status status =
      fg__streamline_trace(line, context, domain->field, &all, start, &within);
  out->count = line->count;
  out->start = line->count > 0 ? line->node[line->start].s : 0;
  for (int way = 0; way < 2; way++)
    out->goes_on[way] = line->end[way] == FG__STREAMLINE_LONG;
  return status;
}

void fg__line_clear(fg__line *line)
{
  fg__streamline_clear(&line->traced);
  *line = (fg__line){0};
}

double fg__line_length(const fg__line *line)
{
  return fg__streamline_length(&line->traced);
}

void fg__line_at(const fg__line *line, double s, int *hint, double position[3],
                 double tangent[3])
{
  fg__streamline_at(&line->traced, s, hint, position, tangent);
}

double fg__line_turning(const fg__line *line, double from, double to)
{
  if (line->traced.dimension == 3) {
    double position[3];
    return fg__streamline_at(&line->traced, to, NULL, position, NULL) -
           fg__streamline_at(&line->traced, from, NULL, position, NULL);
  }
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (int i = 0; i < line->count; i++) {
    const fg__streamline_node *node = &line->traced.node[i];
    if (node->s >= from && node->s <= to) {
      lowest = fmin(lowest, node->turning);
      highest = fmax(highest, node->turning);
    }
  }
  return highest > lowest ? highest - lowest : 0;
}

fg_status fg__line_points(double (**points)[3], int *count, fg_context *context,
                          const fg__line *line, double from, double to, double spacing)
{
  const fg__arrow arrow = {
      .tail = from, .tip = to, .turning = fg__line_turning(line, from, to)};
  return fg__arrow_centerline(points, count, context, &line->traced, &arrow, spacing);
}
