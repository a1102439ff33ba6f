#include "icon/streamline.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Local error allowed a step, in longest steps. A step is at most a cell of the raster,
 * so 100 steps stray by less than 0.03 cells: far below what a print shows. */
static const double TOLERANCE = 3e-4;

/* Shortest step, in longest steps; where the direction turns by more than LARGEST_TURN in
 * it, the radius of curvature is below 0.02 cells: a singular point or line of the
 * direction. */
static const double SHORTEST_STEP = 1e-2;
static const double LARGEST_TURN_COSINE = 0.866; /* 30 degrees a step */

/* Below this share of the speed at the start the flow stands still. */
static const double STANDSTILL = 1e-6;

/* Guards against a line that goes on by shortest steps only. */
enum { LARGEST_NODE_COUNT = 20000, BISECTIONS = 24 };

typedef struct tracing {
  const fg_field *field;
  const fg__window *window;
  const fg__streamline_limits *limits;
  double standstill; /* speed in units of fg_field_tangent */
  double sign;       /* +1 with the flow, -1 against it */
} tracing;

typedef struct trial {
  double position[3];
  double direction[3];
  double error;
} trial;

/* Unit vector of the way to go; false outside the domain and where the flow stands still.
 */
static bool find_direction(const tracing *tracer, const double position[3],
                           double direction[3])
{
  double tangent[3] = {0};
  if (!fg_field_tangent(tracer->field, position, tangent))
    return false;
  double speed = fg__length(tangent);
  if (!(speed > tracer->standstill))
    return false;
  for (int a = 0; a < 3; a++)
    direction[a] = tracer->sign * tangent[a] / speed;
  return true;
}

/* One step of the 3(2) pair from a position with known direction; false when a stage has
 * no direction or turns too far. */
static bool try_step(const tracing *tracer, const double from[3], const double k1[3],
                     double step, trial *out)
{
  double k2[3], k3[3], point[3];
  fg__add_scaled(from, step / 2, k1, point);
  if (!find_direction(tracer, point, k2) || fg__dot(k1, k2) < LARGEST_TURN_COSINE)
    return false;
  for (int a = 0; a < 3; a++)
    point[a] = from[a] + step * k2[a] * 3 / 4;
  if (!find_direction(tracer, point, k3) || fg__dot(k1, k3) < LARGEST_TURN_COSINE)
    return false;
  for (int a = 0; a < 3; a++)
    out->position[a] = from[a] + step * (2 * k1[a] + 3 * k2[a] + 4 * k3[a]) / 9;
  const double *k4 = out->direction;
  if (!find_direction(tracer, out->position, out->direction) ||
      fg__dot(k1, k4) < LARGEST_TURN_COSINE)
    return false;
  double error[3];
  for (int a = 0; a < 3; a++)
    error[a] = step * (-5 * k1[a] + 6 * k2[a] + 8 * k3[a] - 9 * k4[a]) / 72;
  out->error = fg__length(error);
  return true;
}

/* Cubic Hermite between two points with unit tangents, a length apart along the curve. */
static void interpolate(const double p[3], const double d[3], const double q[3],
                        const double e[3], double length, double fraction,
                        double position[3])
{
  double t = fraction, u = 1 - t;
  for (int a = 0; a < 3; a++)
    position[a] = u * u * (1 + 2 * t) * p[a] + t * t * (3 - 2 * t) * q[a] +
                  length * (u * u * t * d[a] - t * t * u * e[a]);
}

/* Its unit tangent. */
static void interpolate_tangent(const double p[3], const double d[3], const double q[3],
                                const double e[3], double length, double fraction,
                                double tangent[3])
{
  double t = fraction, u = 1 - t;
  for (int a = 0; a < 3; a++)
    tangent[a] = 6 * t * u * (q[a] - p[a]) +
                 length * (u * (1 - 3 * t) * d[a] + t * (3 * t - 2) * e[a]);
  if (!fg__normalise(tangent))
    memcpy(tangent, d, 3 * sizeof *tangent);
}

/* The point at a fraction of a step. */
static void point_after(const fg__streamline_node *from, const trial *to, double step,
                        double fraction, double position[3])
{
  interpolate(from->position, from->tangent, to->position, to->direction, step, fraction,
              position);
}

static bool is_inside(const tracing *tracer, const double position[3])
{
  return fg__window_level(tracer->window, position) > 0;
}

/* Largest fraction of the step that is still inside, by bisection on the dense output. */
static double find_boundary(const tracing *tracer, const fg__streamline_node *from,
                            const trial *to, double step, double outside)
{
  double inside = 0;
  for (int i = 0; i < BISECTIONS; i++) {
    double middle = (inside + outside) / 2, position[3];
    point_after(from, to, step, middle, position);
    if (is_inside(tracer, position))
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

static fg_status add_node(fg__streamline *line, fg_context *context,
                          const fg__streamline_node *node)
{
  if (!fg__grow((void **)&line->node, &line->capacity, (size_t)line->count + 1,
                sizeof *node))
    return fg__fail_memory(context, "a streamline",
                           ((size_t)line->count + 1) * sizeof *node);
  line->node[line->count++] = *node;
  return FG_STATUS_OK;
}

/* The node that ends a step, at a fraction of it. */
static fg__streamline_node node_after(int dimension, const fg__streamline_node *from,
                                      const trial *to, double step, double fraction)
{
  fg__streamline_node node = {.s = from->s + step * fraction};
  point_after(from, to, step, fraction, node.position);
  interpolate_tangent(from->position, from->tangent, to->position, to->direction, step,
                      fraction, node.tangent);
  double across[3];
  fg__cross(from->tangent, node.tangent, across);
  double sine = dimension == 2 ? across[2] : fg__length(across);
  node.turning = from->turning + atan2(sine, fg__dot(from->tangent, node.tangent));
  return node;
}

/* Goes one way from the last node; directions, s and turning are those of the way gone.
 */
static fg_status trace_one_way(fg__streamline *line, fg_context *context,
                               const tracing *tracer, fg__streamline_end *end)
{
  const fg__streamline_limits *limits = tracer->limits;
  fg__streamline_node last = line->node[line->count - 1];
  double first_s = last.s, lowest = last.turning, highest = last.turning;
  double step = limits->step;
  for (int steps = 0; steps < LARGEST_NODE_COUNT; steps++) {
    trial next;
    double allowed = TOLERANCE * limits->step;
    while (!try_step(tracer, last.position, last.tangent, step, &next) ||
           next.error > allowed) {
      if (step <= SHORTEST_STEP * limits->step) {
        *end = FG__STREAMLINE_SINGULAR;
        return FG_STATUS_OK;
      }
      step = fmax(step / 2, SHORTEST_STEP * limits->step);
    }
    double fraction = 1, middle[3];
    point_after(&last, &next, step, 0.5, middle);
    if (!is_inside(tracer, middle))
      fraction = find_boundary(tracer, &last, &next, step, 0.5);
    else if (!is_inside(tracer, next.position))
      fraction = find_boundary(tracer, &last, &next, step, 1);
    fg__streamline_node node = node_after(line->dimension, &last, &next, step, fraction);
    if (fraction > 0) {
      fg_status status = add_node(line, context, &node);
      if (status != FG_STATUS_OK)
        return status;
    }
    if (fraction < 1) {
      *end = FG__STREAMLINE_LEFT;
      return FG_STATUS_OK;
    }
    last = node;
    lowest = fmin(lowest, node.turning);
    highest = fmax(highest, node.turning);
    if (highest - lowest >= limits->turning) {
      *end = FG__STREAMLINE_TURNED;
      return FG_STATUS_OK;
    }
    if (node.s - first_s >= limits->length)
      break;
    /* the error of the pair grows with the third power of the step */
    double growth = 0.9 * cbrt(allowed / fmax(next.error, 1e-3 * allowed));
    step = fmin(fmax(step * fmin(growth, 2), SHORTEST_STEP * limits->step), limits->step);
  }
  *end = FG__STREAMLINE_LONG;
  return FG_STATUS_OK;
}

/* Turns a line gone against the flow round, so that it arrives at the start point. */
static void reverse(fg__streamline *line)
{
  double length = line->node[line->count - 1].s;
  double turned = line->node[line->count - 1].turning;
  /* the angle of the reversed tangent in 2D is half a turn more: the same differences */
  double sense = line->dimension == 2 ? 1 : -1;
  for (int i = 0, j = line->count - 1; i <= j; i++, j--) {
    fg__streamline_node first = line->node[i], last = line->node[j];
    line->node[i] = last;
    line->node[j] = first;
  }
  for (int i = 0; i < line->count; i++) {
    fg__streamline_node *node = &line->node[i];
    node->s = length - node->s;
    node->turning = sense * (node->turning - turned);
    for (int a = 0; a < 3; a++)
      node->tangent[a] = -node->tangent[a];
  }
}

fg_status fg__streamline_trace(fg__streamline *out, fg_context *context,
                               const fg_field *field, const fg__window *window,
                               const double start[], const fg__streamline_limits *limits)
{
  out->count = 0;
  out->start = 0;
  out->dimension = window->dimension;
  if (!(fg__window_level(window, start) > 0))
    return FG_STATUS_OK;
  double tangent[3] = {0};
  if (!fg_field_tangent(field, start, tangent))
    return FG_STATUS_OK;
  double speed = fg__length(tangent);
  if (!(speed > 0) || !isfinite(speed))
    return FG_STATUS_OK;

  tracing tracer = {field, window, limits, STANDSTILL * speed, -1};
  fg__streamline_node first = {0};
  for (int a = 0; a < window->dimension; a++) {
    first.position[a] = start[a];
    first.tangent[a] = -tangent[a] / speed;
  }
  fg_status status = add_node(out, context, &first);
  if (status != FG_STATUS_OK)
    return status;
  status = trace_one_way(out, context, &tracer, &out->end[0]);
  if (status != FG_STATUS_OK)
    return status;
  reverse(out);
  out->start = out->count - 1;
  tracer.sign = 1;
  return trace_one_way(out, context, &tracer, &out->end[1]);
}

void fg__streamline_clear(fg__streamline *streamline)
{
  free(streamline->node);
  *streamline = (fg__streamline){0};
}

double fg__streamline_length(const fg__streamline *streamline)
{
  return streamline->count > 0 ? streamline->node[streamline->count - 1].s : 0;
}

double fg__streamline_at(const fg__streamline *streamline, double s, int *hint,
                         double position[3], double tangent[3])
{
  const fg__streamline_node *node = streamline->node;
  int last = streamline->count - 1;
  int i = hint && *hint > 0 && *hint < last && node[*hint].s <= s ? *hint : 0;
  while (i + 1 < last && node[i + 1].s < s)
    i++;
  if (hint)
    *hint = i;
  const fg__streamline_node *a = &node[i], *b = &node[i < last ? i + 1 : i];
  double length = b->s - a->s;
  double fraction = length > 0 ? fmin(fmax((s - a->s) / length, 0), 1) : 0;
  interpolate(a->position, a->tangent, b->position, b->tangent, length, fraction,
              position);
  if (tangent)
    interpolate_tangent(a->position, a->tangent, b->position, b->tangent, length,
                        fraction, tangent);
  return a->turning + fraction * (b->turning - a->turning);
}
