#include "solid/make.h"

#include "base/memory.h"
#include "solid/march.h"
#include "solid/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As in icon/choose.c: points of the cluster that an arrow is compared with, points of
 * the arrow, and starts all over the cluster. */
enum { SAMPLES = 250, ARROW_SAMPLES = 32, SPREAD = 12 };
static const double REACH = 0.2, WIDTH_WORTH = 0.25;

/* Where on the spine lines begin, in parts of its length, and how far beside it, in
 * distances to the border there. */
static const double PLACES[] = {0.5, 0.35, 0.65, 0.2, 0.8};
static const double ASIDE = 0.45;

/* From this turning on an arrow is a ring, as in icon/icons_create.c. */
static const double RING_TURNING = 4.4;

/* An arrow that does not lie in its cluster is made this much smaller, up to so often. */
static const double SMALLER = 0.93;
enum { ATTEMPTS = 12 };

/* The centreline turns by at most this between two points, radians (5 degrees), and has a
 * point a spacing. */
static const double LARGEST_TURN = 0.0873;

typedef struct making {
  fg__solid_maker *maker;
  fg_context *context;
  const fg_field *field;
  fg__solid_room room;
  fg__path_limits limits;
  double reach; /* square of the distance that an arrow stands for */
  fg__shaft shaft;
  double cost;
} making;

/* Whether a node is one of every stride-th along an axis, taken alike from either end. */
static bool is_sampled(int index, int nodes, int stride)
{
  int odd = (nodes - 1) % 2, from_middle = (abs(2 * index - (nodes - 1)) - odd) / 2;
  return from_middle % stride == 0;
}

/* Nodes inside the cluster, every stride-th along each axis. */
static fg_status collect_samples(const making *m)
{
  const fg__volume *v = m->room.volume;
  fg__solid_maker *maker = m->maker;
  size_t nodes = fg__volume_count(v), inside = 0;
  for (size_t n = 0; n < nodes; n++)
    inside += v->level[n] > 0;
  int stride = (int)ceil(cbrt((double)inside / SAMPLES));
  stride = stride < 1 ? 1 : stride;
  maker->sample_count = 0;
  for (int z = 0; z < v->nodes[2]; z++)
    for (int y = 0; y < v->nodes[1]; y++)
      for (int x = 0; x < v->nodes[0]; x++) {
        if (!(v->level[fg__volume_node(v, x, y, z)] > 0) ||
            !is_sampled(x, v->nodes[0], stride) || !is_sampled(y, v->nodes[1], stride) ||
            !is_sampled(z, v->nodes[2], stride))
          continue;
        size_t needed = (size_t)maker->sample_count + 1;
        if (!fg__grow((void **)&maker->sample, &maker->sample_capacity, needed,
                      sizeof *maker->sample))
          return fg__fail_memory(m->context, "points of a cluster",
                                 needed * sizeof *maker->sample);
        double *sample = maker->sample[maker->sample_count++];
        const int place[3] = {x, y, z};
        for (int k = 0; k < 3; k++)
          sample[k] = v->origin[k] + place[k] * v->spacing[k];
      }
  return FG_STATUS_OK;
}

/* Root of the mean square distance from the cluster's points to a part of the line just
 * tried, weighed with an arrow's width: the less the better. */
static double cost_of(const making *m, double tail, double tip, double width)
{
  const fg__solid_maker *maker = m->maker;
  double line[ARROW_SAMPLES][3], tangent[3], sum = 0;
  int hint = 0;
  for (int k = 0; k < ARROW_SAMPLES; k++)
    fg__path_at(&maker->tried, tail + (tip - tail) * k / (ARROW_SAMPLES - 1), &hint,
                line[k], tangent);
  for (int i = 0; i < maker->sample_count; i++) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < ARROW_SAMPLES; k++) {
      const double d[3] = {line[k][0] - maker->sample[i][0],
                           line[k][1] - maker->sample[i][1],
                           line[k][2] - maker->sample[i][2]};
      nearest = fmin(nearest, fg__dot(d, d));
    }
    sum += nearest / (nearest + m->reach);
  }
  return sqrt(sum / fmax(maker->sample_count, 1)) / pow(width, WIDTH_WORTH);
}

static fg_status consider(making *m, const double start[3])
{
  fg__solid_maker *maker = m->maker;
  fg_status status = fg__path_trace(&maker->tried, m->context, m->field, m->room.volume,
                                    start, &m->limits);
  if (status != FG_STATUS_OK || maker->tried.count < 2)
    return status;
  double length = fg__path_length(&maker->tried);
  if (!(length > 0) || cost_of(m, 0, length, fg__shaft_widest(length)) >= m->cost)
    return FG_STATUS_OK;
  fg__shaft shaft;
  status = fg__shaft_fit(&shaft, m->context, &maker->tried, &m->room, &maker->stations);
  if (status != FG_STATUS_OK || !(shaft.width > 0))
    return status;
  double cost = cost_of(m, shaft.tail, shaft.tip, shaft.width);
  if (cost < m->cost) {
    fg__path swap = maker->best;
    maker->best = maker->tried;
    maker->tried = swap;
    m->cost = cost;
    m->shaft = shaft;
  }
  return FG_STATUS_OK;
}

/* A point of the spine, and four points round it across the flow. */
static fg_status consider_around(making *m, const double center[3])
{
  fg_status status = consider(m, center);
  double tangent[3], normal[2][3];
  if (status != FG_STATUS_OK || !fg_field_tangent(m->field, center, tangent) ||
      !fg__normalise(tangent))
    return status;
  fg__any_normal(tangent, normal[0]);
  fg__cross(tangent, normal[0], normal[1]);
  double radius = fg__volume_value(m->room.volume, m->room.distance, center);
  for (int side = 0; side < 4 && status == FG_STATUS_OK; side++) {
    double start[3];
    fg__along(center, side < 2 ? ASIDE * radius : -ASIDE * radius, normal[side % 2],
              start);
    status = consider(m, start);
  }
  return status;
}

/* Longest step: no longer than a cell of the data, where the field has its bends. */
static double step_limit(const fg_field *field, double spacing)
{
  const fg_field_arrays *contents = fg_field_contents(field);
  double step = spacing;
  for (int k = 0; k < 3; k++) {
    int n = contents->size[k];
    step = fmin(step, (contents->axis[k][n - 1] - contents->axis[k][0]) / (n - 1));
  }
  return step;
}

/* Tries points of the cluster, each as far as can be from the centre and from those
 * before it. */
static fg_status consider_everywhere(making *m, const double center[3])
{
  const fg__solid_maker *maker = m->maker;
  double away[2 * SAMPLES];
  int count = maker->sample_count < 2 * SAMPLES ? maker->sample_count : 2 * SAMPLES;
  for (int i = 0; i < count; i++)
    away[i] = fg__apart(maker->sample[i], center);
  fg_status status = FG_STATUS_OK;
  for (int turn = 0; turn < SPREAD && turn < count && status == FG_STATUS_OK; turn++) {
    int farthest = 0;
    for (int i = 1; i < count; i++)
      farthest = away[i] > away[farthest] ? i : farthest;
    double start[3];
    memcpy(start, maker->sample[farthest], sizeof start);
    for (int i = 0; i < count; i++)
      away[i] = fmin(away[i], fg__apart(maker->sample[i], start));
    status = consider(m, start);
  }
  return status;
}

static fg_status choose(making *m, const fg__core *core)
{
  fg_status status = collect_samples(m);
  for (size_t i = 0; i < sizeof PLACES / sizeof *PLACES && status == FG_STATUS_OK; i++) {
    const double *point = core->point[(int)lround(PLACES[i] * (core->count - 1))];
    status = consider_around(m, i == 0 ? core->center : point);
  }
  if (status == FG_STATUS_OK)
    status = consider_everywhere(m, core->center);
  return status;
}

/* Points of a part of the best line, dense enough to be drawn as straight pieces. */
static fg_status sample_line(double (**points)[3], int *count, const making *m,
                             double tail, double tip, double turning)
{
  const fg__path *path = &m->maker->best;
  int pieces = (int)ceil(fmax((tip - tail) / m->room.spacing, turning / LARGEST_TURN));
  pieces = pieces < 8 ? 8 : pieces;
  *points = fg__allocate((size_t)pieces + 1, sizeof **points);
  if (!*points)
    return fg__fail_memory(m->context, "an icon", (size_t)pieces * sizeof **points);
  int hint = 0;
  double tangent[3];
  for (int i = 0; i <= pieces; i++)
    fg__path_at(path, tail + (tip - tail) * i / pieces, &hint, (*points)[i], tangent);
  *count = pieces + 1;
  return FG_STATUS_OK;
}

static void set_width(fg_icon *icon, double width)
{
  icon->width = width;
  icon->tail_width = FG__SOLID_TAIL_WIDTH * width;
  icon->head_length = FG__SOLID_HEAD_LENGTH * width;
  icon->head_width = FG__SOLID_HEAD_WIDTH * width;
}

/* The point of the centreline nearest to the spine's centre. */
static void set_center(fg_icon *icon, const double center[3])
{
  double nearest = HUGE_VAL;
  for (int i = 0; i + 1 < icon->point_count; i++) {
    const double *p = icon->points[i], *q = icon->points[i + 1];
    double along[3], to[3], on[3];
    fg__along(q, -1, p, along);
    fg__along(center, -1, p, to);
    double t = fmin(fmax(fg__dot(to, along) / fg__dot(along, along), 0), 1);
    fg__along(p, t, along, on);
    if (fg__apart(on, center) < nearest) {
      nearest = fg__apart(on, center);
      memcpy(icon->center, on, sizeof on);
    }
  }
}

/* Mean of |v| by arc length, trapezoidal. */
static double mean_speed(const fg_field *field, const fg_icon *icon)
{
  double sum = 0, length = 0, before = 0;
  for (int i = 0; i < icon->point_count; i++) {
    double velocity[3], speed = before;
    if (fg_field_velocity(field, icon->points[i], velocity))
      speed = fg__length(velocity);
    if (i > 0) {
      double piece = fg__apart(icon->points[i], icon->points[i - 1]);
      sum += piece * (speed + before) / 2;
      length += piece;
    }
    before = speed;
  }
  return length > 0 ? sum / length : 0;
}

static fg_status lies_inside(bool *inside, fg_context *context, const fg_icon *icon,
                             const fg__volume *volume)
{
  fg_surface *solid;
  fg_status status = fg_icon_solid(&solid, context, icon);
  *inside = status == FG_STATUS_OK;
  if (status != FG_STATUS_OK)
    return status;
  for (int i = 0; i < solid->vertex_count && *inside; i++)
    *inside = fg__volume_level(volume, solid->vertex[i]) > 0;
  fg_surface_destroy(solid);
  return FG_STATUS_OK;
}

static void free_line(const double (**points)[3])
{
  free((void *)(uintptr_t)*points);
  *points = NULL;
}

/* Turns the chosen arrow into an icon, made smaller until its solid lies inside. */
static fg_status build(fg_icon *icon, const making *m, const double center[3])
{
  fg__shaft shaft = m->shaft;
  icon->kind = shaft.turning >= RING_TURNING ? FG_ICON_RING : FG_ICON_ARROW;
  bool inside = false;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < ATTEMPTS && !inside && status == FG_STATUS_OK; i++) {
    double(*points)[3] = NULL;
    free_line(&icon->points);
    status =
        sample_line(&points, &icon->point_count, m, shaft.tail, shaft.tip, shaft.turning);
    icon->points = (const double(*)[3])points;
    set_width(icon, shaft.width);
    if (status == FG_STATUS_OK)
      status = lies_inside(&inside, m->context, icon, m->room.volume);
    double less = (1 - SMALLER) / 2 * (shaft.tip - shaft.tail);
    shaft.width *= SMALLER;
    shaft.tail += less;
    shaft.tip -= less;
  }
  if (!inside) {
    free_line(&icon->points);
    icon->point_count = 0;
    return status;
  }
  set_center(icon, center);
  icon->speed = mean_speed(m->field, icon);
  double(*line)[3];
  const fg__path *path = &m->maker->best;
  status = sample_line(&line, &icon->streamline_count, m, 0, fg__path_length(path),
                       path->node[path->count - 1].turning);
  if (status == FG_STATUS_OK)
    icon->streamline = (const double(*)[3])line;
  return status;
}

fg_status fg__solid_icon_make(fg_icon *out, fg_context *context, fg__solid_maker *maker,
                              const fg_field *field, const fg__volume *volume)
{
  *out = (fg_icon){0};
  size_t nodes = fg__volume_count(volume);
  double spacing = fmin(fmin(volume->spacing[0], volume->spacing[1]), volume->spacing[2]);
  fg__core core = {0};
  making m = {.maker = maker, .context = context, .field = field, .cost = HUGE_VAL};
  double *distance = fg__allocate(nodes, sizeof *distance);
  if (!distance)
    return fg__fail_memory(context, "a distance map", nodes * sizeof *distance);
  m.room = (fg__solid_room){volume, distance, spacing};
  m.limits.step = step_limit(field, spacing);
  m.limits.turning = FG__SOLID_TURNING;
  for (int k = 0; k < 3; k++)
    m.limits.length += 4 * volume->nodes[k] * volume->spacing[k];
  fg_status status = fg__march_volume(distance, context, volume);
  if (status == FG_STATUS_OK)
    status = fg__core_create(&core, context, volume, distance);
  if (status != FG_STATUS_OK)
    goto cleanup;
  double reach = REACH * core.length + core.radius;
  m.reach = reach * reach;
  status = choose(&m, &core);
  if (status == FG_STATUS_OK && m.shaft.width > 0)
    status = build(out, &m, core.center);
  if (out->points) {
    out->spine = (const double(*)[3])core.point;
    out->spine_count = core.count;
    core.point = NULL;
  }
cleanup:
  fg__core_clear(&core);
  free(distance);
  if (status != FG_STATUS_OK)
    fg__solid_icon_free(out);
  return status;
}

void fg__solid_icon_free(fg_icon *icon)
{
  free_line(&icon->points);
  free_line(&icon->spine);
  free_line(&icon->streamline);
  icon->point_count = icon->spine_count = icon->streamline_count = 0;
}

void fg__solid_maker_clear(fg__solid_maker *maker)
{
  fg__path_clear(&maker->best);
  fg__path_clear(&maker->tried);
  fg__shaft_stations_clear(&maker->stations);
  free(maker->sample);
  *maker = (fg__solid_maker){0};
}
