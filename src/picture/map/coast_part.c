/* Rings and lines of the coasts' data, and their edges. */
#include <math.h>

#include "picture/map/tracer.h"

/* Edges so near to the antimeridian are the data's own cut: half a unit of their
 * numbers. */
static const double cut_slack = 0.001;

void fg__part_turns(int turns[2], const fg__coast_part *p, const fg__plane *plane)
{
  const bool apart = p->high[1] < plane->south || p->low[1] > plane->north;
  const double reach = fabs(p->turn);
  turns[0] = 1, turns[1] = 0;
  if (apart && reach == 0.0)
    return;
  turns[0] = (int)ceil((plane->west - p->high[0]) / 360.0);
  turns[1] = (int)floor((plane->east - p->low[0]) / 360.0);
}

static bool on_antimeridian(const double a[2])
{
  return fabs(fabs(remainder(a[0], 360.0)) - 180.0) < cut_slack;
}

bool fg__edge_is_cut(const double a[2], const double b[2])
{
  return on_antimeridian(a) && on_antimeridian(b) && fabs(a[0] - b[0]) < 2.0 * cut_slack;
}

void fg__part_edge(const fg__coast_part *p, size_t n, double a[2], double b[2])
{
  const bool last = n + 1 == p->count;
  const double *to = p->point[last ? 0 : n + 1];
  a[0] = p->point[n][0];
  a[1] = p->point[n][1];
  b[0] = to[0] + (last ? p->turn : 0.0);
  b[1] = to[1];
}

size_t fg__part_edges(const fg__coast_part *p)
{
  return p->closed ? p->count : p->count - 1;
}
