#include "skeleton/centering.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "skeleton/boundary.h"

fg_status fg__signed_distance_create(fg__signed_distance *out, fg_context *context,
                                     const fg__window *window, const double *distance)
{
  size_t nodes = fg__window_count(window);
  *out = (fg__signed_distance){.window = window};
  out->value = fg__allocate(nodes, sizeof *out->value);
  if (!out->value)
    return fg__fail_memory(context, "a signed distance", nodes * sizeof *out->value);
  fg__boundary_distance(out->value, window, false);
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

double fg__signed_distance_at(const fg__signed_distance *field, const double position[])
{
  return fg__window_value(field->window, field->value, position);
}

bool fg__signed_distance_to_domain(const fg__signed_distance *field,
                                   const double position[])
{
  const fg__window *window = field->window;
  double near = fg__signed_distance_at(field, position) +
                0.5 * fmax(window->spacing[0], window->spacing[1]);
  for (int side = 0; side < 4; ++side) {
    int axis = side / 2;
    int node = side % 2 == 0 ? 0 : window->nodes[axis] - 1;
    double edge = window->origin[axis] + node * window->spacing[axis];
    if (window->at_boundary[side] && fabs(position[axis] - edge) <= near)
      return true;
  }
  return false;
}

/* Unit tangent of a line at a point, from the points `base` before and after it: one from
 * its next neighbours would follow every wiggle, and the centring then amplify it. */
static void tangent_at(const fg__polyline *line, int k, int base, double tangent[2])
{
  int count = line->count;
  int before = k - base;
  int after = k + base;
  if (line->closed) {
    before = (before + count) % count;
    after = after % count;
  } else {
    before = before < 0 ? 0 : before;
    after = after > count - 1 ? count - 1 : after;
  }
  double x = line->point[after][0] - line->point[before][0];
  double y = line->point[after][1] - line->point[before][1];
  double length = hypot(x, y);
  tangent[0] = length > 0.0 ? x / length : 0.0;
  tangent[1] = length > 0.0 ? y / length : 0.0;
}

static double value_off(const fg__signed_distance *field, const double point[2],
                        const double direction[2], double off)
{
  const double place[2] = {point[0] + off * direction[0], point[1] + off * direction[1]};
  return fg__signed_distance_at(field, place);
}

/* How far along the normal the ridge lies. On the two sides of a ridge the distance falls
 * with slope one, so half the difference of two values off the ridge is the way there.
 * Where the line runs straight towards a boundary or away from it, as in a disc and at
 * blunt ends, that difference says nothing about a ridge and follows the line's own tilt:
 * the square of the slope along the line, 1 there and 0 on a level ridge, takes the way
 * back. */
static double way_to_ridge(const fg__signed_distance *field, const double point[2],
                           const double tangent[2], double off)
{
  const double normal[2] = {-tangent[1], tangent[0]};
  double way = 0.5 * (value_off(field, point, normal, off) -
                      value_off(field, point, normal, -off));
  double slope =
      (value_off(field, point, tangent, off) - value_off(field, point, tangent, -off)) /
      (2.0 * off);
  return way * fmax(1.0 - slope * slope, 0.0);
}

/* Moves point k to the ridge, at most by half the points' spacing, so that they keep
 * their order. Values are taken half way to the boundary, and half a cell off at least,
 * where they are not those of the ridge's own blunt top. */
static void center_point(const fg__polyline *line, const fg__signed_distance *field,
                         int k, double spacing, double moved[2])
{
  const double *point = line->point[k];
  double h = fmin(field->window->spacing[0], field->window->spacing[1]);
  double off = fmax(0.5 * fg__signed_distance_at(field, point), 0.5 * h);
  int base = (int)fmin(fmax(round(off / spacing), 1.0), (line->count - 1) / 2);
  double tangent[2];
  tangent_at(line, k, base > 0 ? base : 1, tangent);
  double way = way_to_ridge(field, point, tangent, off);
  way = fmin(fmax(way, -0.5 * spacing), 0.5 * spacing);
  moved[0] = point[0] - way * tangent[1];
  moved[1] = point[1] + way * tangent[0];
}

static double kept_in_window(const fg__window *window, int axis, double coordinate)
{
  double last = window->origin[axis] + (window->nodes[axis] - 1) * window->spacing[axis];
  return fmin(fmax(coordinate, window->origin[axis]), last);
}

static void smooth(fg__polyline *line, double (*moved)[3])
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
                              const fg__signed_distance *field, int rounds,
                              const int held[2])
{
  if (line->count < 2)
    return FG_STATUS_OK;
  double(*moved)[3] = fg__allocate((size_t)line->count, sizeof *moved);
  if (!moved)
    return fg__fail_memory(context, "a spine", (size_t)line->count * sizeof *moved);
  int segments = line->closed ? line->count : line->count - 1;
  double spacing = fg__polyline_length(line) / segments;
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < line->count; ++k) {
      memcpy(moved[k], line->point[k], sizeof *moved);
      if (k >= held[0] && k < line->count - held[1])
        center_point(line, field, k, spacing, moved[k]);
      for (int axis = 0; axis < 2; ++axis)
        moved[k][axis] = kept_in_window(field->window, axis, moved[k][axis]);
    }
    smooth(line, moved);
  }
  free(moved);
  return FG_STATUS_OK;
}
