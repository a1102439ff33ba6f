#include "solid/path.h"

#include "base/memory.h"
#include "solid/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As in icon/streamline.c, which says why. */
static const double TOLERANCE = 3e-4;
static const double SHORTEST_STEP = 1e-2;
static const double LARGEST_TURN_COSINE = 0.866;
static const double STANDSTILL = 1e-6;
enum { LARGEST_NODE_COUNT = 20000, BISECTIONS = 24 };

/* Points of a line to be drawn: it turns by at most this between two of them, radians (5
 * degrees), and has at least so many pieces. */
static const double LARGEST_TURN = 0.0873;
enum { FEWEST_PIECES = 8 };

typedef struct tracing {
  const fg_field *field;
  const fg__volume *volume;
  const fg__path_limits *limits;
  double standstill;
  double sign; /* +1 with the flow, -1 against it */
} tracing;

typedef struct trial {
  double position[3], direction[3], error;
} trial;

/* False outside the domain and where the flow stands still. */
static bool find_direction(const tracing *tracer, const double position[3],
                           double direction[3])
{
  double tangent[3];
  if (!fg_field_tangent(tracer->field, position, tangent))
    return false;
  double speed = fg__length(tangent);
  if (!(speed > tracer->standstill))
    return false;
  for (int k = 0; k < 3; ++k)
    direction[k] = tracer->sign * tangent[k] / speed;
  return true;
}

/* One step of the pair; false when a stage has no direction or turns too far. */
static bool try_step(const tracing *tracer, const double from[3], const double k1[3],
                     double step, trial *out)
{
  double k2[3], k3[3], point[3], error[3];
  fg__along(from, step / 2, k1, point);
  if (!find_direction(tracer, point, k2) || fg__dot(k1, k2) < LARGEST_TURN_COSINE)
    return false;
  fg__along(from, step * 3 / 4, k2, point);
  if (!find_direction(tracer, point, k3) || fg__dot(k1, k3) < LARGEST_TURN_COSINE)
    return false;
  for (int k = 0; k < 3; ++k)
    out->position[k] = from[k] + step * (2 * k1[k] + 3 * k2[k] + 4 * k3[k]) / 9;
  const double *k4 = out->direction;
  if (!find_direction(tracer, out->position, out->direction) ||
      fg__dot(k1, k4) < LARGEST_TURN_COSINE)
    return false;
  for (int k = 0; k < 3; ++k)
    error[k] = step * (-5 * k1[k] + 6 * k2[k] + 8 * k3[k] - 9 * k4[k]) / 72;
  out->error = fg__length(error);
  return true;
}

/* Cubic Hermite between two points with unit tangents, a length apart along the curve. */
static void interpolate(const double p[3], const double d[3], const double q[3],
                        const double e[3], double length, double t, double position[3],
                        double tangent[3])
{
  double u = 1 - t;
  for (int k = 0; k < 3; ++k) {
    position[k] = u * u * (1 + 2 * t) * p[k] + t * t * (3 - 2 * t) * q[k] +
                  length * (u * u * t * d[k] - t * t * u * e[k]);
    tangent[k] = 6 * t * u * (q[k] - p[k]) +
                 length * (u * (1 - 3 * t) * d[k] + t * (3 * t - 2) * e[k]);
  }
  if (!fg__normalise(tangent))
    memcpy(tangent, d, 3 * sizeof *tangent);
}

/* Largest fraction of the step that is still inside, by bisection. */
static double find_border(const tracing *tracer, const fg__path_node *from,
                          const trial *to, double step, double outside)
{
  double inside = 0;
  for (int i = 0; i < BISECTIONS; i++) {
    double middle = (inside + outside) / 2, position[3], tangent[3];
    interpolate(from->position, from->tangent, to->position, to->direction, step, middle,
                position, tangent);
    if (fg__volume_level(tracer->volume, position) > 0)
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

static fg_status add_node(fg__path *path, fg_context *context, const fg__path_node *node)
{
  size_t needed = (size_t)path->count + 1;
  if (!fg__grow((void **)&path->node, &path->capacity, needed, sizeof *node))
    return fg__fail_memory(context, "a streamline", needed * sizeof *node);
  path->node[path->count++] = *node;
  return FG_STATUS_OK;
}

static fg__path_node node_after(const fg__path_node *from, const trial *to, double step,
                                double fraction)
{
  fg__path_node node = {.s = from->s + step * fraction};
  interpolate(from->position, from->tangent, to->position, to->direction, step, fraction,
              node.position, node.tangent);
  double across[3];
  fg__cross(from->tangent, node.tangent, across);
  node.turning =
      from->turning + atan2(fg__length(across), fg__dot(from->tangent, node.tangent));
  return node;
}

/* Goes one way from the last node; directions, s and turning are those of the way gone.
 */
static fg_status trace_one_way(fg__path *path, fg_context *context, const tracing *tracer)
{
  const fg__path_limits *limits = tracer->limits;
  fg__path_node last = path->node[path->count - 1];
  double first_s = last.s, first_turning = last.turning, step = limits->step;
  const double allowed = TOLERANCE * limits->step;
  for (int steps = 0; steps < LARGEST_NODE_COUNT; steps++) {
    trial next;
    while (!try_step(tracer, last.position, last.tangent, step, &next) ||
           next.error > allowed) {
      if (step <= SHORTEST_STEP * limits->step)
        return FG_STATUS_OK;
      step = fmax(step / 2, SHORTEST_STEP * limits->step);
    }
    double fraction = 1, middle[3], direction[3];
    interpolate(last.position, last.tangent, next.position, next.direction, step, 0.5,
                middle, direction);
    if (!(fg__volume_level(tracer->volume, middle) > 0))
      fraction = find_border(tracer, &last, &next, step, 0.5);
    else if (!(fg__volume_level(tracer->volume, next.position) > 0))
      fraction = find_border(tracer, &last, &next, step, 1);
    fg__path_node node = node_after(&last, &next, step, fraction);
    if (fraction > 0) {
      fg_status status = add_node(path, context, &node);
      if (status != FG_STATUS_OK)
        return status;
    }
    last = node;
    if (fraction < 1 || node.turning - first_turning >= limits->turning ||
        node.s - first_s >= limits->length)
      return FG_STATUS_OK;
    /* the error of the pair grows with the third power of the step */
    double growth = 0.9 * cbrt(allowed / fmax(next.error, 1e-3 * allowed));
    step = fmin(fmax(step * fmin(growth, 2), SHORTEST_STEP * limits->step), limits->step);
  }
  return FG_STATUS_OK;
}

/* Turns a line gone against the flow round, so that it arrives at the start point. */
static void reverse(fg__path *path)
{
  const fg__path_node end = path->node[path->count - 1];
  for (int i = 0, j = path->count - 1; i < j; i++, j--) {
    fg__path_node first = path->node[i];
    path->node[i] = path->node[j];
    path->node[j] = first;
  }
  for (int i = 0; i < path->count; i++) {
    fg__path_node *node = &path->node[i];
    node->s = end.s - node->s;
    node->turning = end.turning - node->turning;
    for (int k = 0; k < 3; ++k)
      node->tangent[k] = -node->tangent[k];
  }
}

fg_status fg__path_trace(fg__path *out, fg_context *context, const fg_field *field,
                         const fg__volume *volume, const double start[3],
                         const fg__path_limits *limits)
{
  out->count = out->start = 0;
  double tangent[3];
  if (!(fg__volume_level(volume, start) > 0) || !fg_field_tangent(field, start, tangent))
    return FG_STATUS_OK;
  double speed = fg__length(tangent);
  if (!(speed > 0) || !isfinite(speed))
    return FG_STATUS_OK;
  tracing tracer = {field, volume, limits, STANDSTILL * speed, -1};
  fg__path_node first = {0};
  for (int k = 0; k < 3; ++k) {
    first.position[k] = start[k];
    first.tangent[k] = -tangent[k] / speed;
  }
  fg_status status = add_node(out, context, &first);
  if (status == FG_STATUS_OK)
    status = trace_one_way(out, context, &tracer);
  if (status != FG_STATUS_OK)
    return status;
  reverse(out);
  out->start = out->count - 1;
  tracer.sign = 1;
  return trace_one_way(out, context, &tracer);
}

void fg__path_clear(fg__path *path)
{
  free(path->node);
  *path = (fg__path){0};
}

double fg__path_length(const fg__path *path)
{
  return path->count > 0 ? path->node[path->count - 1].s : 0;
}

double fg__path_at(const fg__path *path, double s, int *hint, double position[3],
                   double tangent[3])
{
  const fg__path_node *node = path->node;
  int last = path->count - 1;
  int i = hint && *hint > 0 && *hint < last && node[*hint].s <= s ? *hint : 0;
  while (i + 1 < last && node[i + 1].s < s)
    i++;
  if (hint)
    *hint = i;
  if (last == 0) {
    memcpy(position, node[0].position, 3 * sizeof *position);
    memcpy(tangent, node[0].tangent, 3 * sizeof *tangent);
    return node[0].turning;
  }
  double length = node[i + 1].s - node[i].s;
  double fraction = length > 0 ? (s - node[i].s) / length : 0;
  fraction = fmin(fmax(fraction, 0), 1);
  interpolate(node[i].position, node[i].tangent, node[i + 1].position,
              node[i + 1].tangent, length, fraction, position, tangent);
  return node[i].turning + fraction * (node[i + 1].turning - node[i].turning);
}

fg_status fg__path_points(double (**points)[3], int *count, fg_context *context,
                          const fg__path *path, double from, double to, double turning,
                          double spacing)
{
  double tangent[3];
  int pieces = (int)ceil(fmax((to - from) / spacing, turning / LARGEST_TURN));
  pieces = pieces < FEWEST_PIECES ? FEWEST_PIECES : pieces;
  *points = fg__allocate((size_t)pieces + 1, sizeof **points);
  if (!*points)
    return fg__fail_memory(context, "an icon", ((size_t)pieces + 1) * sizeof **points);
  int hint = 0;
  for (int i = 0; i <= pieces; i++)
    fg__path_at(path, from + (to - from) * i / pieces, &hint, (*points)[i], tangent);
  *count = pieces + 1;
  return FG_STATUS_OK;
}
