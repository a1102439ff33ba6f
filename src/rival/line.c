#include "rival/line.h"

#include "icon/arrow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The tracers stop at the zero set of a level on a window: here one cell that is positive
 * all over. */
enum { CORNERS = 8 };

static fg_status trace_flat(fg__line *out, fg_context *context, const fg__domain *domain,
                            fg__volume *all, const double start[],
                            const fg__line_limits *limits)
{
  const fg__window window = {.nodes = {2, 2},
                             .origin = {all->origin[0], all->origin[1]},
                             .spacing = {all->spacing[0], all->spacing[1]},
                             .level = all->level,
                             .active = all->active};
  const fg__streamline_limits flat = {domain->trace_step, limits->length,
                                      limits->turning};
  fg__streamline *line = &out->flat;
  fg_status status =
      fg__streamline_trace(line, context, domain->field, &window, start, &flat);
  out->count = line->count;
  out->start = line->count > 0 ? line->node[line->start].s : 0;
  for (int way = 0; way < 2; way++)
    out->goes_on[way] = line->end[way] == FG__STREAMLINE_LONG;
  return status;
}

static fg_status trace_solid(fg__line *out, fg_context *context, const fg__domain *domain,
                             const fg__volume *all, const double start[],
                             const fg__line_limits *limits)
{
  const fg__path_limits solid = {domain->trace_step, limits->length, limits->turning};
  fg__path *path = &out->solid;
  fg_status status = fg__path_trace(path, context, domain->field, all, start, &solid);
  out->count = path->count;
  out->start = path->count > 0 ? path->node[path->start].s : 0;
  out->goes_on[0] = out->start >= limits->length;
  out->goes_on[1] = fg__path_length(path) - out->start >= limits->length;
  return status;
}

fg_status fg__line_trace(fg__line *out, fg_context *context, const fg__domain *domain,
                         const fg__extent *room, const double start[],
                         const fg__line_limits *limits)
{
  float level[CORNERS];
  unsigned char active = 1;
  fg__volume all = {.nodes = {2, 2, 2}, .level = level, .active = &active};
  for (int i = 0; i < CORNERS; i++)
    level[i] = 1;
  memcpy(all.origin, room->origin, sizeof all.origin);
  memcpy(all.spacing, room->side, sizeof all.spacing);
  out->dimension = domain->dimension;
  return domain->dimension == 2 ? trace_flat(out, context, domain, &all, start, limits)
                                : trace_solid(out, context, domain, &all, start, limits);
}

void fg__line_clear(fg__line *line)
{
  fg__streamline_clear(&line->flat);
  fg__path_clear(&line->solid);
  *line = (fg__line){0};
}

double fg__line_length(const fg__line *line)
{
  return line->dimension == 2 ? fg__streamline_length(&line->flat)
                              : fg__path_length(&line->solid);
}

void fg__line_at(const fg__line *line, double s, int *hint, double position[3],
                 double tangent[3])
{
  position[2] = tangent[2] = 0;
  if (line->dimension == 2)
    fg__streamline_at(&line->flat, s, hint, position, tangent);
  else
    fg__path_at(&line->solid, s, hint, position, tangent);
}

double fg__line_turning(const fg__line *line, double from, double to)
{
  if (line->dimension == 3) {
    double position[3], tangent[3];
    return fg__path_at(&line->solid, to, NULL, position, tangent) -
           fg__path_at(&line->solid, from, NULL, position, tangent);
  }
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (int i = 0; i < line->count; i++) {
    const fg__streamline_node *node = &line->flat.node[i];
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
  if (line->dimension == 3)
    return fg__path_points(points, count, context, &line->solid, from, to,
                           fg__line_turning(line, from, to), spacing);
  const fg__arrow arrow = {.tail = from, .tip = to};
  return fg__arrow_centerline(points, count, context, &line->flat, &arrow, spacing);
}
