#include "skeleton/centering.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "skeleton/border.h"

fg_status fg__signed_distance_create(fg__signed_distance *out, fg_context *context,
                                     const fg__window *window, const double *distance)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  *out = (fg__signed_distance){.window = window};
  out->value = fg__allocate(nodes, sizeof *out->value);
  if (!out->value)
    return fg__fail_memory(context, "a signed distance", nodes * sizeof *out->value);
  fg__border_distance(out->value, window, false);
  double farthest = fmax(window->spacing[0], window->spacing[1]);
  for (size_t k = 0; k < nodes; ++k) {
    if (window->level[k] > 0.0F)
      out->value[k] = distance[k];
    else
      out->value[k] = -fmin(out->value[k], farthest);
  }
  return FG_STATUS_OK;
}

void fg__signed_distance_clear(fg__signed_distance *field)
{
  free(field->value);
  *field = (fg__signed_distance){0};
}

double fg__signed_distance_at(const fg__signed_distance *field, const double position[2])
{
  const fg__window *window = field->window;
  int cell[2];
  double share[2];
  for (int k = 0; k < 2; ++k) {
    double place = (position[k] - window->origin[k]) / window->spacing[k];
    place = fmin(fmax(place, 0.0), window->nodes[k] - 1);
    cell[k] = (int)place;
    if (cell[k] == window->nodes[k] - 1)
      --cell[k];
    share[k] = place - cell[k];
  }
  const double *low = field->value + cell[1] * window->nodes[0] + cell[0];
  const double *high = low + window->nodes[0];
  double bottom = (1.0 - share[0]) * low[0] + share[0] * low[1];
  double top = (1.0 - share[0]) * high[0] + share[0] * high[1];
  return (1.0 - share[1]) * bottom + share[1] * top;
}

/* Unit normal of a line at a point, from its neighbours. */
static void normal_at(const fg__polyline *line, int k, double normal[2])
{
  int last = line->count - 1;
  int before = k > 0 ? k - 1 : line->closed ? last : 0;
  int after = k < last ? k + 1 : line->closed ? 0 : last;
  double x = line->point[after][0] - line->point[before][0];
  double y = line->point[after][1] - line->point[before][1];
  double length = hypot(x, y);
  normal[0] = length > 0.0 ? -y / length : 0.0;
  normal[1] = length > 0.0 ? x / length : 0.0;
}

/* How far along the normal the ridge lies. On the two sides of a ridge the distance falls
 * with slope one, so half the difference of two values off the ridge is the way there;
 * taken half way to the border, but within three cells, since the ridge may bend, and
 * half a cell at least, where the values are not those of the ridge's own blunt top. */
static double way_to_ridge(const fg__signed_distance *field, const double point[2],
                           const double normal[2])
{
  double h = fmin(field->window->spacing[0], field->window->spacing[1]);
  double off = 0.5 * fg__signed_distance_at(field, point);
  off = fmin(fmax(off, 0.5 * h), 3.0 * h);
  const double left[2] = {point[0] + off * normal[0], point[1] + off * normal[1]};
  const double right[2] = {point[0] - off * normal[0], point[1] - off * normal[1]};
  double way =
      0.5 * (fg__signed_distance_at(field, left) - fg__signed_distance_at(field, right));
  return fmin(fmax(way, -0.5 * h), 0.5 * h);
}

static void smooth(fg__polyline *line, double (*moved)[2])
{
  int last = line->count - 1;
  for (int k = 0; k <= last; ++k) {
    bool end = !line->closed && (k == 0 || k == last);
    const double *before = moved[k > 0 ? k - 1 : last];
    const double *after = moved[k < last ? k + 1 : 0];
    for (int axis = 0; axis < 2; ++axis) {
      double mean = 0.5 * (before[axis] + after[axis]);
      line->point[k][axis] = end ? moved[k][axis] : 0.5 * (moved[k][axis] + mean);
    }
  }
}

fg_status fg__polyline_center(fg__polyline *line, fg_context *context,
                              const fg__signed_distance *field, int rounds)
{
  if (line->count < 2)
    return FG_STATUS_OK;
  double(*moved)[2] = fg__allocate((size_t)line->count, sizeof *moved);
  if (!moved)
    return fg__fail_memory(context, "a spine", (size_t)line->count * sizeof *moved);
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < line->count; ++k) {
      double normal[2];
      normal_at(line, k, normal);
      double way = way_to_ridge(field, line->point[k], normal);
      moved[k][0] = line->point[k][0] + way * normal[0];
      moved[k][1] = line->point[k][1] + way * normal[1];
    }
    smooth(line, moved);
  }
  free(moved);
  return FG_STATUS_OK;
}
