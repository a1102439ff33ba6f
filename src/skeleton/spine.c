#include "skeleton/spine.h"

#include <math.h>
#include <stdlib.h>

#include "base/context.h"
#include "base/memory.h"
#include "skeleton/centering.h"
#include "skeleton/ridge.h"

/* The ridge forks at a blunt end and runs into the corners. What the disc of `reach`
 * times the distance to the border covers belongs to such an end: sqrt(2) for a right
 * angle, and some for the grid. */
static const double reach = 1.5;

/* Rounds of centring: a path of nodes lies within half a cell of the ridge, and each
 * round halves what the smoothing left of the steps between rows. */
enum { ROUNDS = 8 };

static double cell_size(const fg__window *window)
{
  return sqrt(window->spacing[0] * window->spacing[1]);
}

static double between(const double a[2], const double b[2])
{
  return hypot(b[0] - a[0], b[1] - a[1]);
}

static bool is_inside(const fg__window *window, const double point[2])
{
  return fg__window_level(window, point) > 0.0;
}

static bool copy_ridge(fg__polyline *line, const fg__window *window,
                       const fg__ridge *ridge)
{
  line->closed = ridge->closed;
  for (int k = 0; k < ridge->count; ++k) {
    const double point[2] = {
        window->origin[0] + ridge->node[k] % window->nodes[0] * window->spacing[0],
        window->origin[1] + ridge->node[k] / window->nodes[0] * window->spacing[1]};
    if (!fg__polyline_add(line, point))
      return false;
  }
  return true;
}

/* The last point whose disc covers all points before it. */
static int covered_end(const fg__polyline *line, const fg__signed_distance *field)
{
  int end = 0;
  for (int k = 1; k < line->count; ++k) {
    double radius = reach * fg__signed_distance_at(field, line->point[k]);
    bool covers = true;
    for (int m = 0; m < k && covers; ++m)
      covers = between(line->point[m], line->point[k]) <= radius;
    if (covers)
      end = k;
  }
  return end;
}

/* Keeps the points first ... last. */
static void cut(fg__polyline *line, int first, int last)
{
  for (int k = first; k <= last; ++k) {
    line->point[k - first][0] = line->point[k][0];
    line->point[k - first][1] = line->point[k][1];
  }
  line->count = last - first + 1;
}

/* Follows a ray from a point inside until it leaves the cluster; `end` is its last point
 * inside, to a thousandth of a cell. */
static void follow_ray(const fg__window *window, const double from[2],
                       const double direction[2], double end[2])
{
  double step = 0.25 * fmin(window->spacing[0], window->spacing[1]);
  double inside = 0.0;
  double outside = step;
  for (;; outside += step) {
    const double point[2] = {from[0] + outside * direction[0],
                             from[1] + outside * direction[1]};
    if (!is_inside(window, point))
      break;
    inside = outside;
  }
  while (outside - inside > 1e-3 * step) {
    double middle = 0.5 * (inside + outside);
    const double point[2] = {from[0] + middle * direction[0],
                             from[1] + middle * direction[1]};
    *(is_inside(window, point) ? &inside : &outside) = middle;
  }
  end[0] = from[0] + inside * direction[0];
  end[1] = from[1] + inside * direction[1];
}

/* Goes on from the last point to the border, in the direction that the line has over the
 * length `base` before it. */
static bool extend(fg__polyline *line, const fg__window *window, double base)
{
  int last = line->count - 1;
  while (last > 0 && !is_inside(window, line->point[last]))
    --last;
  line->count = last + 1;
  int before = last;
  while (before > 0 && between(line->point[before], line->point[last]) < base)
    --before;
  double length = between(line->point[before], line->point[last]);
  if (!(length > 0.0))
    return true;
  const double direction[2] = {(line->point[last][0] - line->point[before][0]) / length,
                               (line->point[last][1] - line->point[before][1]) / length};
  double end[2];
  follow_ray(window, line->point[last], direction, end);
  if (!(between(end, line->point[last]) > 0.0))
    return true;
  return fg__polyline_add(line, end);
}

static bool extend_both(fg__polyline *line, const fg__signed_distance *field)
{
  for (int side = 0; side < 2; ++side) {
    fg__polyline_reverse(line);
    double base = fg__signed_distance_at(field, line->point[line->count - 1]);
    base = fmax(base, 2.0 * cell_size(field->window));
    if (!extend(line, field->window, base))
      return false;
  }
  return true;
}

/* Direction in which the nodes of the cluster lie spread widest. */
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
  double angle = 0.5 * atan2(2.0 * xy, xx - yy);
  direction[0] = cos(angle);
  direction[1] = sin(angle);
}

/* A cluster hardly longer than wide has no ridge to speak of: the chord through its
 * middle along its principal axis instead. */
static bool make_chord(fg__polyline *line, const fg__window *window,
                       const double middle[2])
{
  double direction[2];
  principal_axis(window, direction);
  const double back[2] = {-direction[0], -direction[1]};
  double ends[2][2];
  follow_ray(window, middle, back, ends[0]);
  follow_ray(window, middle, direction, ends[1]);
  const double kept[2] = {middle[0], middle[1]};
  line->count = 0;
  bool room = true;
  if (between(ends[0], kept) > 0.0)
    room = fg__polyline_add(line, ends[0]);
  room = room && fg__polyline_add(line, kept);
  if (room && between(ends[1], kept) > 0.0)
    room = fg__polyline_add(line, ends[1]);
  return room;
}

/* From the path of nodes to an even line on the ridge, from border to border. */
static fg_status refine(fg__polyline *line, fg_context *context,
                        const fg__signed_distance *field)
{
  const fg__window *window = field->window;
  double step = cell_size(window);
  bool room = true;
  fg_status status = FG_STATUS_OK;
  if (!line->closed) {
    int first = covered_end(line, field);
    fg__polyline_reverse(line);
    int last = line->count - 1 - covered_end(line, field);
    fg__polyline_reverse(line);
    int widest = 0;
    for (int k = 0; k < line->count; ++k) {
      if (fg__signed_distance_at(field, line->point[k]) >
          fg__signed_distance_at(field, line->point[widest]))
        widest = k;
    }
    double radius = fg__signed_distance_at(field, line->point[widest]);
    double core = first < last ? between(line->point[first], line->point[last]) : 0.0;
    if (core < fmax(0.5 * radius, step)) {
      const double middle[2] = {line->point[widest][0], line->point[widest][1]};
      room = make_chord(line, window, middle);
    } else {
      cut(line, first, last);
      room = fg__polyline_resample(line, step);
      if (room)
        status = fg__polyline_center(line, context, field, ROUNDS);
      room = room && extend_both(line, field);
    }
  }
  room = room && fg__polyline_resample(line, step);
  if (room && !status)
    status = fg__polyline_center(line, context, field, ROUNDS);
  if (room && !status && !line->closed)
    room = extend_both(line, field);
  room = room && fg__polyline_resample(line, step);
  if (!room && !status)
    status = fg__fail_memory(context, "a spine", line->capacity * sizeof *line->point);
  return status;
}

static fg_status set_spine(fg__spine *spine, fg_context *context, fg__polyline *line,
                           const fg__signed_distance *field)
{
  spine->distance = fg__allocate((size_t)line->count, sizeof *spine->distance);
  if (!spine->distance)
    return fg__fail_memory(context, "a spine", (size_t)line->count * sizeof(double));
  spine->count = line->count;
  spine->closed = line->closed;
  spine->length = fg__polyline_length(line);
  spine->point = line->point;
  *line = (fg__polyline){0};
  for (int k = 0; k < spine->count; ++k)
    spine->distance[k] = fmax(fg__signed_distance_at(field, spine->point[k]), 0.0);
  spine->center = (spine->count - 1) / 2;
  for (int k = 0; spine->closed && k < spine->count; ++k) {
    if (spine->distance[k] > spine->distance[spine->center])
      spine->center = k;
  }
  return FG_STATUS_OK;
}

fg_status fg__spine_create(fg__spine *out, fg_context *context, const fg__window *window,
                           const double *distance)
{
  *out = (fg__spine){0};
  fg__ridge ridge = {0};
  fg__polyline line = {0};
  fg__signed_distance field = {0};
  fg_status status = fg__ridge_create(&ridge, context, window, distance);
  if (status)
    goto cleanup;
  status = fg__signed_distance_create(&field, context, window, distance);
  if (status)
    goto cleanup;
  if (!copy_ridge(&line, window, &ridge)) {
    status =
        fg__fail_memory(context, "a spine", (size_t)ridge.count * sizeof *line.point);
    goto cleanup;
  }
  status = refine(&line, context, &field);
  if (!status)
    status = set_spine(out, context, &line, &field);

cleanup:
  fg__ridge_clear(&ridge);
  fg__polyline_clear(&line);
  fg__signed_distance_clear(&field);
  return status;
}

void fg__spine_clear(fg__spine *spine)
{
  free(spine->point);
  free(spine->distance);
  *spine = (fg__spine){0};
}
