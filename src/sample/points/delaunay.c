/* Incremental construction (Bowyer 1981, Watson 1981) with a point at infinity, so that
 * every edge has two triangles. Points come in rounds of random ones, each along a
 * Hilbert curve (Amenta, Choi and Rote 2003), which keeps the expected time at
 * O(n log n) for any input. */
#include "sample/points/delaunay.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"

enum {
  BITS = 30,       /* of a rounded coordinate: incircle() then fits 127 bits */
  CURVE_BITS = 16, /* of the place along the Hilbert curve, each way */
  ROUNDS = 20,
  STOP_EVERY = 4096
};

__extension__ typedef __int128 wide_integer;

typedef struct place {
  int64_t x, y;
} place;

typedef struct turn {
  uint64_t key;
  int point;
} turn;

/* Edge 3 t + k goes from corner k of triangle t to the next; twin is the same edge as its
 * other triangle has it. */
typedef struct mesh {
  place *at;
  int *corner, *twin;
  int triangles;
  int *cavity, *edge; /* triangles that a new point takes away, edges round them */
  int cavity_count, edge_count;
  size_t cavity_capacity, edge_capacity;
  unsigned char *taken; /* of each triangle: in the cavity */
  int *from;            /* [points + 1], the new triangle whose outer edge starts there */
} mesh;

/* Of a point, with its two triangles and its turn. */
static const double POINT_BYTES =
    sizeof(place) + 2 * 6 * sizeof(int) + 2 + sizeof(int) + sizeof(turn);

static int next_edge(int edge)
{
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}

/* Twice the area of the triangle: > 0 when a, b, p turn left. */
static int64_t turn_of(const place *a, const place *b, const place *p)
{
  return (b->x - a->x) * (p->y - a->y) - (b->y - a->y) * (p->x - a->x);
}

/* > 0 when p is inside the circle through a, b, c, which turn left. */
static wide_integer incircle(const place *a, const place *b, const place *c,
                             const place *p)
{
  const int64_t ax = a->x - p->x, ay = a->y - p->y;
  const int64_t bx = b->x - p->x, by = b->y - p->y;
  const int64_t cx = c->x - p->x, cy = c->y - p->y;
  return (wide_integer)(ax * ax + ay * ay) * (bx * cy - by * cx) +
         (wide_integer)(bx * bx + by * by) * (cx * ay - cy * ax) +
         (wide_integer)(cx * cx + cy * cy) * (ax * by - ay * bx);
}

/* Of three points on a line, whether p is strictly between the others. */
static bool is_between(const place *a, const place *b, const place *p)
{
  return (a->x - p->x) * (b->x - p->x) + (a->y - p->y) * (b->y - p->y) < 0;
}

/* Whether p takes triangle t away: it lies in its circle; that of a triangle with the
 * point at infinity is the half-plane beyond its edge. */
static bool takes(const mesh *m, int t, const place *p)
{
  const int *corner = m->corner + 3 * t;
  for (int k = 0; k < 3; ++k)
    if (corner[k] == FG__FAR_POINT) {
      const place *a = &m->at[corner[(k + 1) % 3]], *b = &m->at[corner[(k + 2) % 3]];
      const int64_t side = turn_of(a, b, p);
      return side > 0 || (side == 0 && is_between(a, b, p));
    }
  return incircle(&m->at[corner[0]], &m->at[corner[1]], &m->at[corner[2]], p) > 0;
}

/* Walks from triangle t to one that holds p, or beyond the hull's edge that p is behind.
 * Across each edge p is on the other side, which in a Delaunay triangulation never leads
 * round (Edelsbrunner 1990). */
static int walk(const mesh *m, int t, const place *p)
{
  for (int k = 0; k < 3; ++k)
    if (m->corner[3 * t + k] == FG__FAR_POINT) {
      t = m->twin[3 * t + (k + 1) % 3] / 3;
      break;
    }
  for (int came = -1;;) {
    int crossed = -1;
    for (int k = 0; k < 3 && crossed < 0; ++k) {
      const int a = m->corner[3 * t + k], b = m->corner[3 * t + (k + 1) % 3];
      if (a == FG__FAR_POINT || b == FG__FAR_POINT)
        return t;
      if (3 * t + k != came && turn_of(&m->at[a], &m->at[b], p) < 0)
        crossed = 3 * t + k;
    }
    if (crossed < 0)
      return t;
    came = m->twin[crossed];
    t = came / 3;
  }
}

static bool push(int **list, size_t *capacity, int *count, int value)
{
  void *grown = *list;
  if (!fg__grow(&grown, capacity, (size_t)*count + 1, sizeof **list))
    return false;
  *list = grown;
  (*list)[(*count)++] = value;
  return true;
}

/* Finds the triangles that p takes away, which hang together, and the edges round them.
 */
static bool find_cavity(mesh *m, int first, const place *p)
{
  m->cavity_count = m->edge_count = 0;
  m->taken[first] = 1;
  bool good = push(&m->cavity, &m->cavity_capacity, &m->cavity_count, first);
  for (int i = 0; i < m->cavity_count && good; ++i)
    for (int k = 0; k < 3 && good; ++k) {
      const int edge = 3 * m->cavity[i] + k, other = m->twin[edge] / 3;
      if (m->taken[other])
        continue;
      if (takes(m, other, p)) {
        m->taken[other] = 1;
        good = push(&m->cavity, &m->cavity_capacity, &m->cavity_count, other);
      } else {
        good = push(&m->edge, &m->edge_capacity, &m->edge_count, edge);
      }
    }
  return good;
}

static void link_edges(mesh *m, int edge, int other)
{
  m->twin[edge] = other;
  m->twin[other] = edge;
}

/* Each edge round the cavity becomes a triangle with the new point. */
static int fill_cavity(mesh *m, int point)
{
  int last = 0;
  for (int i = 0; i < m->cavity_count; ++i)
    m->taken[m->cavity[i]] = 0;
  for (int i = 0; i < m->edge_count; ++i) { /* before triangles are overwritten */
    const int edge = m->edge[i];
    m->edge[i] = m->twin[edge];
  }
  for (int i = 0; i < m->edge_count; ++i) {
    const int t = i < m->cavity_count ? m->cavity[i] : m->triangles++;
    const int outer = m->edge[i];
    m->corner[3 * t] = m->corner[next_edge(outer)];
    m->corner[3 * t + 1] = m->corner[outer];
    m->corner[3 * t + 2] = point;
    link_edges(m, 3 * t, outer);
    m->from[m->corner[3 * t] + 1] = t;
    last = t;
  }
  for (int i = 0; i < m->edge_count; ++i) {
    const int t = m->twin[m->edge[i]] / 3;
    link_edges(m, 3 * t + 1, 3 * m->from[m->corner[3 * t + 1] + 1] + 2);
  }
  return last;
}

/* False when memory is lacking. *near: a triangle close to the last point. */
static bool insert(mesh *m, int *near, int point)
{
  const place *p = &m->at[point];
  const int t = walk(m, *near, p);
  *near = t;
  if (!takes(m, t, p)) /* it is one of its corners */
    return true;
  if (!find_cavity(m, t, p))
    return false;
  *near = fill_cavity(m, point);
  return true;
}

/* The triangle a, b, c, which turn left, and those beyond its edges. */
static void begin(mesh *m, int a, int b, int c)
{
  const int corner[3] = {a, b, c};
  m->triangles = 4;
  for (int k = 0; k < 3; ++k) {
    const int far = 3 * (k + 1);
    m->corner[k] = corner[k];
    m->corner[far] = corner[(k + 1) % 3];
    m->corner[far + 1] = corner[k];
    m->corner[far + 2] = FG__FAR_POINT;
    link_edges(m, k, far);
    link_edges(m, far + 1, 3 * ((k + 2) % 3 + 1) + 2);
  }
}

/* Puts two more points at places 1 and 2 of the order, with which the first makes a
 * triangle that turns left; false when all lie on a line. */
static bool find_first(turn *order, size_t points, const place *at)
{
  const place *first = &at[order[0].point];
  size_t second = 1, third;
  while (second < points && at[order[second].point].x == first->x &&
         at[order[second].point].y == first->y)
    ++second;
  third = second + 1;
  while (third < points &&
         turn_of(first, &at[order[second].point], &at[order[third].point]) == 0)
    ++third;
  if (third >= points)
    return false;
  const turn found[2] = {order[second], order[third]};
  order[second] = order[1];
  order[1] = found[0];
  order[third] = order[2];
  order[2] = found[1];
  if (turn_of(first, &at[order[1].point], &at[order[2].point]) < 0) {
    order[1] = found[1];
    order[2] = found[0];
  }
  return true;
}

/* Place along the Hilbert curve (Skilling 2004 has it for any dimension). */
static uint64_t along_curve(const place *p)
{
  uint32_t x = (uint32_t)(p->x >> (BITS - CURVE_BITS));
  uint32_t y = (uint32_t)(p->y >> (BITS - CURVE_BITS));
  const uint32_t all = (1U << CURVE_BITS) - 1;
  uint64_t key = 0;
  for (uint32_t bit = 1U << (CURVE_BITS - 1); bit > 0; bit >>= 1) {
    const uint32_t right = (x & bit) != 0, up = (y & bit) != 0;
    key = (key << 2) | ((3 * right) ^ up);
    if (!up) {
      if (right) {
        x = all - x;
        y = all - y;
      }
      const uint32_t swapped = x;
      x = y;
      y = swapped;
    }
  }
  return key;
}

static int by_key(const void *a, const void *b)
{
  const turn *s = a, *t = b;
  return s->key != t->key ? (s->key > t->key) - (s->key < t->key)
                          : (s->point > t->point) - (s->point < t->point);
}

/* Half of the points come in the last round, half of the others in the one before. */
static void choose_order(turn *order, size_t points, const place *at)
{
  for (size_t i = 0; i < points; ++i) {
    const uint64_t dice = fg__mix(i);
    uint64_t round = 0;
    while (round < ROUNDS && (dice >> round & 1) != 0)
      ++round;
    order[i].point = (int)i;
    order[i].key = ((ROUNDS - round) << 2 * CURVE_BITS) | along_curve(&at[i]);
  }
  qsort(order, points, sizeof *order, by_key);
}

/* Of so narrow places the inverse is no number. */
static const double NO_WIDTH = 1e-290;

static void round_places(place *at, size_t points, const double *x, const double *y)
{
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < points; ++i) {
    low[0] = fmin(low[0], x[i]);
    low[1] = fmin(low[1], y[i]);
    high[0] = fmax(high[0], x[i]);
    high[1] = fmax(high[1], y[i]);
  }
  const double width = fmax(high[0] - low[0], high[1] - low[1]);
  const double scale = width > NO_WIDTH ? (double)((1 << BITS) - 1) / width : 0.0;
  for (size_t i = 0; i < points; ++i) {
    at[i].x = (int64_t)((x[i] - low[0]) * scale + 0.5);
    at[i].y = (int64_t)((y[i] - low[1]) * scale + 0.5);
  }
}

/* Keeps the triangles that are wanted, and hands them over. */
static void hand_over(fg__triangles *out, mesh *m, bool closed)
{
  int kept = 0;
  for (int t = 0; t < m->triangles; ++t) {
    const int *corner = m->corner + 3 * t;
    if (!closed && (corner[0] < 0 || corner[1] < 0 || corner[2] < 0))
      continue;
    for (int k = 0; k < 3; ++k)
      m->corner[3 * kept + k] = corner[k];
    ++kept;
  }
  *out = (fg__triangles){.count = (size_t)kept, .corner = m->corner};
  m->corner = NULL;
}

static fg_status triangulate(mesh *m, fg_context *context, const turn *order,
                             size_t points)
{
  int near = 0;
  begin(m, order[0].point, order[1].point, order[2].point);
  for (size_t i = 3; i < points; ++i) {
    if (i % STOP_EVERY == 0 && fg__check_stop(context) != FG_STATUS_OK)
      return FG_STATUS_STOPPED;
    if (!insert(m, &near, order[i].point))
      return fg__fail_memory(context, "a triangulation", points * sizeof(int));
  }
  return FG_STATUS_OK;
}

static void clear(mesh *m)
{
  free(m->at);
  free(m->corner);
  free(m->twin);
  free(m->cavity);
  free(m->edge);
  free(m->taken);
  free(m->from);
}

fg_status fg__delaunay(fg__triangles *out, fg_context *context, size_t points,
                       const double *x, const double *y, bool closed)
{
  *out = (fg__triangles){0};
  if (points > FG__DELAUNAY_MOST)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%zu points; at most %d can be triangulated", points,
                    FG__DELAUNAY_MOST);
  if (points < 3)
    return FG_STATUS_OK;
  fg_status status = fg__check_memory(context, "field", (double)points, POINT_BYTES);
  if (status != FG_STATUS_OK)
    return status;
  /* Euler: n points and the one at infinity have 2 (n + 1) - 4 triangles */
  const size_t triangles = 2 * points;
  mesh m = {.at = fg__allocate(points, sizeof *m.at),
            .corner = fg__allocate(3 * triangles, sizeof *m.corner),
            .twin = fg__allocate(3 * triangles, sizeof *m.twin),
            .taken = fg__allocate(triangles, sizeof *m.taken),
            .from = fg__allocate(points + 1, sizeof *m.from)};
  turn *order = fg__allocate(points, sizeof *order);
  if (!m.at || !m.corner || !m.twin || !m.taken || !m.from || !order)
    status = fg__fail_memory(context, "a triangulation", points * 6 * sizeof(int));
  if (status == FG_STATUS_OK) {
    round_places(m.at, points, x, y);
    choose_order(order, points, m.at);
    if (find_first(order, points, m.at)) {
      status = triangulate(&m, context, order, points);
      if (status == FG_STATUS_OK)
        hand_over(out, &m, closed);
    }
  }
  free(order);
  clear(&m);
  return status;
}

void fg__triangles_clear(fg__triangles *triangles)
{
  free(triangles->corner);
  *triangles = (fg__triangles){0};
}
