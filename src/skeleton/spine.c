#include "skeleton/spine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "base/vector.h"
#include "skeleton/centering.h"
#include "skeleton/extension.h"
#include "skeleton/ridge.h"

/* The ridge forks at a blunt end and runs into the corners. What the disc of `reach`
 * times the distance to the boundary covers belongs to such an end: sqrt(2) for a right
 * angle. A stripe that the domain's boundary cuts ends in a sharper corner, so there it
 * is the angle of 47 degrees that just counts as an end. */
static const double reach = 1.5;
static const double reach_at_boundary = 2.5;

/* A line is centred with points half the cluster's half-width apart first, because where
 * the ridge is blunt a path of nodes bends by the directions of the grid, over many
 * cells; then cell by cell. Each round halves what is left of an error of the points' own
 * spacing. */
enum { ROUNDS = 8 };

/* Smoothing steps in 3D, where no line is centred: after these a staircase of unit steps
 * is within a third of a step of a straight line. */
enum { SMOOTHINGS = 6 };

static double cell_size(const fg__window *window)
{
  return sqrt(window->spacing[0] * window->spacing[1]);
}

static double distance_between(const double a[2], const double b[2])
{
  return hypot(b[0] - a[0], b[1] - a[1]);
}

static bool copy_ridge(fg__polyline *line, const fg__window *window,
                       const fg__ridge *ridge)
{
  line->closed = ridge->closed;
  for (int k = 0; k < ridge->count; ++k) {
    double point[3];
    fg__window_position(window, (size_t)ridge->node[k], point);
    if (!fg__polyline_add(line, point))
      return false;
  }
  return true;
}

/* The last point whose disc reaches the line's first point along the line, and half its
 * distance to the boundary further, since a path turns into a corner before the fork. */
static int covered_end(const fg__polyline *line, const fg__signed_distance *field)
{
  int end = 0;
  double length = 0.0;
  for (int k = 1; k < line->count; ++k) {
    length += distance_between(line->point[k - 1], line->point[k]);
    double factor =
        fg__signed_distance_to_domain(field, line->point[k]) ? reach_at_boundary : reach;
    if (length <= factor * (fg__signed_distance_at(field, line->point[k]) +
                            0.5 * cell_size(field->window)))
      end = k;
  }
  double further = 0.5 * fg__signed_distance_at(field, line->point[end]);
  int turn = end;
  while (end > 0 && turn + 1 < line->count &&
         distance_between(line->point[turn], line->point[end]) < further)
    ++turn;
  return turn;
}

/* Keeps the points first ... last. */
static void cut(fg__polyline *line, int first, int last)
{
  memmove(line->point, line->point + first,
          (size_t)(last - first + 1) * sizeof *line->point);
  line->count = last - first + 1;
}

static int widest_point(const fg__polyline *line, const fg__signed_distance *field)
{
  int widest = 0;
  double most = -HUGE_VAL;
  for (int k = 0; k < line->count; ++k) {
    double distance = fg__signed_distance_at(field, line->point[k]);
    if (distance > most) {
      most = distance;
      widest = k;
    }
  }
  return widest;
}

/* Centres a line with points `step` apart, but not the lengths `held` at its ends. */
static fg_status center(fg__polyline *line, fg_context *context,
                        const fg__signed_distance *field, double step,
                        const double held[2])
{
  if (!fg__polyline_resample(line, step))
    return fg__fail_memory(context, "a spine", line->capacity * sizeof *line->point);
  int points[2];
  for (int side = 0; side < 2; ++side)
    points[side] = (int)fmin(ceil(held[side] / step), line->count);
  return fg__polyline_center(line, context, field, ROUNDS, points);
}

static const double nothing_held[2] = {0.0, 0.0};

/* Takes the ends where the ridge runs into corners off a path of nodes. What is left is
 * shorter than a quarter of the cluster's width when there is no ridge to speak of: then
 * false.
 */
static bool cut_ends(fg__polyline *line, const fg__signed_distance *field, double radius)
{
  int first = covered_end(line, field);
  fg__polyline_reverse(line);
  int last = line->count - 1 - covered_end(line, field);
  fg__polyline_reverse(line);
  if (first >= last)
    return false;
  cut(line, first, last);
  return fg__polyline_length(line) >= fmax(0.5 * radius, cell_size(field->window));
}

/* Makes an open path of nodes into a line from boundary to boundary. */
static fg_status refine_open(fg__polyline *line, fg_context *context,
                             const fg__signed_distance *field)
{
  double step = cell_size(field->window);
  int widest = widest_point(line, field);
  /* a path has points: NOLINTNEXTLINE */
  const double middle[2] = {line->point[widest][0], line->point[widest][1]};
  double radius = fg__signed_distance_at(field, middle);
  /* without the steps of the grid, which make the path up to 8 % too long */
  fg_status status =
      fg__polyline_center(line, context, field, ROUNDS, (int[2]){line->count, 0});
  if (status)
    return status;
  bool enough = true;
  double held[2];
  if (!cut_ends(line, field, radius)) {
    enough = fg__polyline_make_chord(line, field->window, middle);
  } else {
    status = center(line, context, field, fmax(0.5 * radius, step), nothing_held);
    if (!status)
      status = center(line, context, field, step, nothing_held);
    if (!status)
      status = fg__polyline_extend(line, context, field, true, held);
    if (!status)
      status = center(line, context, field, step, held);
    if (!status)
      status = fg__polyline_extend(line, context, field, false, NULL);
  }
  if (!status && !enough)
    status = fg__fail_memory(context, "a spine", line->capacity * sizeof *line->point);
  return status;
}

static fg_status refine_flat(fg__polyline *line, fg_context *context,
                             const fg__signed_distance *field)
{
  double step = cell_size(field->window);
  fg_status status = FG_STATUS_OK;
  if (line->closed) {
    double radius = fg__signed_distance_at(field, line->point[widest_point(line, field)]);
    status = center(line, context, field, fmax(0.5 * radius, step), nothing_held);
    if (!status)
      status = center(line, context, field, step, nothing_held);
  } else {
    status = refine_open(line, context, field);
  }
  if (!status && !fg__polyline_resample(line, step))
    status = fg__fail_memory(context, "a spine", line->capacity * sizeof *line->point);
  return status;
}

/* Of a staircase of nodes: each point but the ends becomes the mean of its neighbours and
 * itself, where that lies in the cluster. */
static void smooth(fg__polyline *line, const fg__window *window)
{
  for (int round = 0; round < SMOOTHINGS; ++round) {
    double before[3];
    memcpy(before, line->point[0], sizeof before);
    for (int n = 1; n + 1 < line->count; ++n) {
      double mean[3];
      for (int k = 0; k < 3; ++k)
        mean[k] = (before[k] + line->point[n][k] + line->point[n + 1][k]) / 3.0;
      memcpy(before, line->point[n], sizeof before);
      if (fg__window_level(window, mean) > 0.0)
        memcpy(line->point[n], mean, sizeof mean);
    }
  }
}

/* The middle by length, on the piece after point `center`. */
static void find_middle(fg__spine *spine)
{
  double left = spine->length / 2.0;
  memcpy(spine->middle, spine->point[0], sizeof spine->middle);
  for (int n = 1; n < spine->count; ++n) {
    const double *a = spine->point[n - 1], *b = spine->point[n];
    double piece = fg__distance(a, b);
    if (piece >= left && piece > 0.0) {
      fg__lerp(a, left / piece, b, spine->middle);
      spine->center = n - 1;
      return;
    }
    left -= piece;
  }
}

static void find_center(fg__spine *spine)
{
  spine->center = (spine->count - 1) / 2;
  for (int k = 0; spine->closed && k < spine->count; ++k) {
    if (spine->distance[k] > spine->distance[spine->center])
      spine->center = k;
  }
  memcpy(spine->middle, spine->point[spine->center], sizeof spine->middle);
}

/* Takes the line's points. */
static fg_status set_spine(fg__spine *spine, fg_context *context, fg__polyline *line,
                           const fg__window *window, const double *distance)
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
    spine->distance[k] = fmax(fg__window_value(window, distance, spine->point[k]), 0.0);
  if (window->dimension == 2)
    find_center(spine);
  else
    find_middle(spine);
  return FG_STATUS_OK;
}

/* In 2D from the signed distance, which is there outside the cluster as well. */
static fg_status make_flat(fg__spine *spine, fg_context *context, fg__polyline *line,
                           const fg__window *window, const double *distance)
{
  fg__signed_distance field = {0};
  fg_status status = fg__signed_distance_create(&field, context, window, distance);
  if (!status)
    status = refine_flat(line, context, &field);
  if (!status)
    status = set_spine(spine, context, line, window, field.value);
  fg__signed_distance_clear(&field);
  return status;
}

fg_status fg__spine_create(fg__spine *out, fg_context *context, const fg__window *window,
                           const double *distance)
{
  *out = (fg__spine){0};
  fg__ridge ridge = {0};
  fg__polyline line = {0};
  fg_status status = fg__ridge_create(&ridge, context, window, distance);
  if (status)
    goto cleanup;
  if (!copy_ridge(&line, window, &ridge) || !line.point) {
    status =
        fg__fail_memory(context, "a spine", (size_t)ridge.count * sizeof *line.point);
    goto cleanup;
  }
  if (window->dimension == 2) {
    status = make_flat(out, context, &line, window, distance);
  } else {
    smooth(&line, window);
    status = set_spine(out, context, &line, window, distance);
  }

cleanup:
  fg__ridge_clear(&ridge);
  fg__polyline_clear(&line);
  return status;
}

void fg__spine_clear(fg__spine *spine)
{
  free(spine->point);
  free(spine->distance);
  *spine = (fg__spine){0};
}
