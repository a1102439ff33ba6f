#include "skeleton/extension.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

static bool is_inside(const fg__window *window, const double point[2])
{
  return fg__window_level(window, point) > 0.0;
}

static double distance_between(const double a[2], const double b[2])
{
  return hypot(b[0] - a[0], b[1] - a[1]);
}

/* The length at which a ray from inside leaves the cluster, less at most a thousandth of
 * a cell. */
static double length_inside(const fg__window *window, const double from[2],
                            const double direction[2])
{
  double step = 0.25 * fmin(window->spacing[0], window->spacing[1]);
  double inside = 0.0;
  double outside = step;
  bool beyond = false;
  while (!beyond || outside - inside > 4e-3 * step) {
    double length = beyond ? 0.5 * (inside + outside) : outside;
    const double point[3] = {from[0] + length * direction[0],
                             from[1] + length * direction[1]};
    if (is_inside(window, point)) {
      inside = length;
      outside = beyond ? outside : length + step;
    } else {
      outside = length;
      beyond = true;
    }
  }
  return inside;
}

/* The last point before the end that is at least `base` away from it, else the first. */
static const double *point_before(const fg__polyline *line, double base)
{
  int last = line->count - 1;
  int k = last;
  while (k > 0 && distance_between(line->point[k], line->point[last]) < base)
    --k;
  return line->point[k];
}

/* What lies beyond the end of a line, as far as `reach` of it. */
typedef struct beyond {
  const fg__window *window;
  const double *end, *before; /* the line's last point, and one before it */
  double reach;
  unsigned char *seen;
  int *queue;
  int count;
} beyond;

static void node_place(const fg__window *window, int node, double place[2])
{
  place[0] = window->origin[0] + node % window->nodes[0] * window->spacing[0];
  place[1] = window->origin[1] + node / window->nodes[0] * window->spacing[1];
}

static bool is_beyond(const beyond *region, int node)
{
  double place[2];
  node_place(region->window, node, place);
  double ahead = (place[0] - region->end[0]) * (region->end[0] - region->before[0]) +
                 (place[1] - region->end[1]) * (region->end[1] - region->before[1]);
  return region->window->level[node] > 0.0F && !region->seen[node] && ahead >= 0.0 &&
         distance_between(place, region->end) <= region->reach;
}

static void add_node(beyond *region, int x, int y)
{
  const fg__window *window = region->window;
  if (x < 0 || y < 0 || x >= window->nodes[0] || y >= window->nodes[1])
    return;
  int node = y * window->nodes[0] + x;
  if (!is_beyond(region, node))
    return;
  region->seen[node] = 1;
  region->queue[region->count++] = node;
}

/* Collects the nodes that hang together with the cell of the line's end. */
static void flood(beyond *region)
{
  const fg__window *window = region->window;
  int x = (int)floor((region->end[0] - window->origin[0]) / window->spacing[0]);
  int y = (int)floor((region->end[1] - window->origin[1]) / window->spacing[1]);
  for (int k = 0; k < 4; ++k)
    add_node(region, x + k % 2, y + k / 2);
  for (int head = 0; head < region->count; ++head) {
    x = region->queue[head] % window->nodes[0];
    y = region->queue[head] / window->nodes[0];
    for (int k = 0; k < 4; ++k) {
      int axis = k / 2;
      int step = k % 2 == 0 ? -1 : 1;
      int next_x = axis == 0 ? x + step : x;
      int next_y = axis == 1 ? y + step : y;
      int low_x = next_x < x ? next_x : x;
      int low_y = next_y < y ? next_y : y;
      if (low_x < 0 || low_y < 0 || next_x >= window->nodes[0] ||
          next_y >= window->nodes[1] ||
          !fg__window_edge_active(window, (const int[3]){low_x, low_y, 0}, axis))
        continue;
      add_node(region, next_x, next_y);
    }
  }
}

/* The middle of what lies farthest beyond the end: of the nodes whose distance from
 * `before` is within half of `distance` of the largest one. False when nothing lies
 * there. */
static bool farthest_beyond(const beyond *region, double distance, double middle[2])
{
  double most = 0.0;
  double place[2];
  for (int k = 0; k < region->count; ++k) {
    node_place(region->window, region->queue[k], place);
    most = fmax(most, distance_between(place, region->before));
  }
  int count = 0;
  middle[0] = middle[1] = 0.0;
  for (int k = 0; k < region->count; ++k) {
    node_place(region->window, region->queue[k], place);
    if (distance_between(place, region->before) < most - 0.5 * distance)
      continue;
    middle[0] += place[0];
    middle[1] += place[1];
    ++count;
  }
  middle[0] /= count > 0 ? count : 1;
  middle[1] /= count > 0 ? count : 1;
  return count > 0;
}

/* Turns the direction at the end of a line to the middle of what lies farthest beyond. */
static fg_status aim(double direction[2], const fg__polyline *line, fg_context *context,
                     const fg__signed_distance *field, double base)
{
  const fg__window *window = field->window;
  size_t nodes = fg__window_count(window);
  const double *end = line->point[line->count - 1];
  beyond region = {.window = window,
                   .end = end,
                   .before = point_before(line, base),
                   .reach = 2.5 * base,
                   .seen = fg__allocate(nodes, 1),
                   .queue = fg__allocate(nodes, sizeof *region.queue)};
  fg_status status = FG_STATUS_OK;
  if (!region.seen || !region.queue) {
    status = fg__fail_memory(context, "the end of a spine", nodes * sizeof(int));
    goto cleanup;
  }
  flood(&region);
  double middle[2];
  if (farthest_beyond(&region, base, middle) &&
      distance_between(end, middle) > 0.25 * base) {
    double length = distance_between(end, middle);
    direction[0] = (middle[0] - end[0]) / length;
    direction[1] = (middle[1] - end[1]) / length;
  }

cleanup:
  free(region.seen);
  free(region.queue);
  return status;
}

/* Adds points a cell apart on the ray from the last point to the boundary. */
static bool add_ray(fg__polyline *line, const fg__window *window,
                    const double direction[2])
{
  const double from[3] = {line->point[line->count - 1][0],
                          line->point[line->count - 1][1]};
  double length = length_inside(window, from, direction);
  double h = fmax(window->spacing[0], window->spacing[1]);
  int pieces = (int)fmin(ceil(length / h), 1e6);
  for (int k = 1; k <= pieces; ++k) {
    double at = length * k / pieces;
    const double point[3] = {from[0] + at * direction[0], from[1] + at * direction[1]};
    if (!fg__polyline_add(line, point))
      return false;
  }
  return true;
}

static fg_status extend_end(fg__polyline *line, fg_context *context,
                            const fg__signed_distance *field, bool to_farthest,
                            double *on)
{
  const fg__window *window = field->window;
  while (line->count > 1 && !is_inside(window, line->point[line->count - 1]))
    --line->count;
  const double *end = line->point[line->count - 1];
  double h = fmax(window->spacing[0], window->spacing[1]);
  double base = fmax(fg__signed_distance_at(field, end), 2.0 * h);
  const double *before = point_before(line, base);
  double length = distance_between(before, end);
  if (!(length > 0.0))
    return FG_STATUS_OK;
  double direction[2] = {(end[0] - before[0]) / length, (end[1] - before[1]) / length};
  fg_status status = FG_STATUS_OK;
  double ahead = length_inside(window, end, direction);
  const double hit[2] = {end[0] + ahead * direction[0], end[1] + ahead * direction[1]};
  if (fg__signed_distance_to_domain(field, end) ||
      fg__signed_distance_to_domain(field, hit))
    *on = ahead;
  else if (to_farthest)
    status = aim(direction, line, context, field, base);
  if (!status && !add_ray(line, window, direction))
    status = fg__fail_memory(context, "a spine", line->capacity * sizeof *line->point);
  return status;
}

fg_status fg__polyline_extend(fg__polyline *line, fg_context *context,
                              const fg__signed_distance *field, bool to_farthest,
                              double on[2])
{
  double went[2] = {0.0, 0.0};
  fg_status status = FG_STATUS_OK;
  for (int side = 0; side < 2; ++side) {
    fg__polyline_reverse(line);
    if (!status)
      status = extend_end(line, context, field, to_farthest, &went[side]);
  }
  for (int side = 0; on && side < 2; ++side)
    on[side] = went[side];
  return status;
}

/* Direction in which the nodes of the cluster lie farthest apart. */
static void principal_axis(const fg__window *window, double direction[2])
{
  double count = 0.0;
  double mean[2] = {0.0, 0.0};
  double moment[3] = {0.0, 0.0, 0.0}; /* xx, xy, yy */
  for (int y = 0; y < window->nodes[1]; ++y) {
    for (int x = 0; x < window->nodes[0]; ++x) {
      if (!(window->level[y * window->nodes[0] + x] > 0.0F))
        continue;
      double place[2] = {x * window->spacing[0], y * window->spacing[1]};
      count += 1.0;
      mean[0] += place[0];
      mean[1] += place[1];
      moment[0] += place[0] * place[0];
      moment[1] += place[0] * place[1];
      moment[2] += place[1] * place[1];
    }
  }
  double xx = moment[0] - mean[0] * mean[0] / count;
  double xy = moment[1] - mean[0] * mean[1] / count;
  double yy = moment[2] - mean[1] * mean[1] / count;
  /* the grid alone draws a disc of ten cells out by half a per cent */
  bool is_round = hypot(2.0 * xy, xx - yy) <= 0.01 * (xx + yy);
  double angle = is_round ? 0.0 : 0.5 * atan2(2.0 * xy, xx - yy);
  direction[0] = cos(angle);
  direction[1] = sin(angle);
}

bool fg__polyline_make_chord(fg__polyline *line, const fg__window *window,
                             const double middle[2])
{
  double direction[2];
  principal_axis(window, direction);
  const double from[3] = {middle[0], middle[1], 0.0};
  line->count = 0;
  for (int side = 0; side < 2; ++side) {
    fg__polyline_reverse(line);
    if (line->count == 0 && !fg__polyline_add(line, from))
      return false;
    if (!add_ray(line, window, direction))
      return false;
    direction[0] = -direction[0];
    direction[1] = -direction[1];
  }
  return true;
}
