#include "icon/territory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "skeleton/heap.h"

/* Fast marching of first order (Sethian, "A fast marching level set method for
 * monotonically advancing fronts", PNAS 93, 1996), twice: from all clusters at once to
 * the boundaries where their fronts meet, and from these boundaries back. */

/* Between the icons' outlines and a boundary: GAP mean extents, and LEAST_GAP cells, for
 * territories must not touch on the grid. */
static const double GAP = 0.05, LEAST_GAP = 1.0;

/* An arrow is not longer than LONGEST mean extents. */
static const double LONGEST = 3.0;

/* A boundary or a zero set nearer to a node than this share of an edge counts as that far
 * away. */
static const double NEAREST = 1e-3;

typedef struct march {
  const fg_density_arrays *grid;
  const int *label;
  size_t nodes;
  int *owner;   /* [nodes] the cluster whose front comes first; 0: none comes */
  double *time; /* [nodes] when it does; then the way to the boundary */
  bool within;  /* fronts stay in the territories */
  fg__heap heap;
} march;

static void place_of(int at[3], const fg_density_arrays *grid, size_t node)
{
  const size_t row = (size_t)grid->nodes[0], plane = row * (size_t)grid->nodes[1];
  at[0] = (int)(node % row);
  at[1] = (int)(node % plane / row);
  at[2] = (int)(node / plane);
}

static int cells_along(const fg_density_arrays *grid, int k)
{
  return k >= grid->dimension ? 1 : grid->nodes[k] - !grid->periodic[k];
}

/* Whether an active cell has the edge from a node along an axis. */
static bool edge_is_active(const fg_density_arrays *grid, const int at[3], int axis)
{
  if (!grid->active)
    return true;
  for (int side = 0; side < 1 << (grid->dimension - 1); ++side) {
    size_t cell = 0;
    bool there = true;
    for (int k = grid->dimension - 1, bit = 0; k >= 0; --k) {
      const int cells = cells_along(grid, k);
      int c = at[k] - (k != axis && (side >> bit & 1));
      bit += k != axis;
      if (c < 0 && grid->periodic[k])
        c += cells;
      there = there && c >= 0 && c < cells;
      cell = cell * (size_t)cells + (size_t)(c < 0 ? 0 : c);
    }
    if (there && grid->active[cell])
      return true;
  }
  return false;
}

/* The node next to one along an axis, before or after it; false: there is none, or no
 * active cell leads there. */
static bool next_node(size_t *next, const march *m, const int at[3], int axis, int way)
{
  const fg_density_arrays *grid = m->grid;
  int to[3] = {at[0], at[1], at[2]};
  to[axis] += way;
  if (to[axis] < 0 || to[axis] >= grid->nodes[axis]) {
    if (!grid->periodic[axis])
      return false;
    to[axis] = (to[axis] + grid->nodes[axis]) % grid->nodes[axis];
  }
  const size_t row = (size_t)grid->nodes[0], plane = row * (size_t)grid->nodes[1];
  *next = (size_t)to[0] + row * (size_t)to[1] + plane * (size_t)to[2];
  return edge_is_active(grid, way > 0 ? at : to, axis);
}

/* When a front comes that is at ways h[k] along the axes at times t[k]: the largest t
 * with sum ((t - t[k]) / h[k])^2 = 1 over the earliest of them that it comes after. */
static double arrival(double t[3], double h[3], int count)
{
  for (int i = 1; i < count; ++i)
    for (int k = i; k > 0 && t[k] < t[k - 1]; --k) {
      const double of_t = t[k], of_h = h[k];
      t[k] = t[k - 1];
      h[k] = h[k - 1];
      t[k - 1] = of_t;
      h[k - 1] = of_h;
    }
  double a = 0.0, b = 0.0, c = -1.0, found = HUGE_VAL;
  for (int k = 0; k < count && t[k] < found; ++k) {
    const double weight = 1.0 / (h[k] * h[k]);
    a += weight;
    b += weight * t[k];
    c += weight * t[k] * t[k];
    const double root = b * b - a * c;
    if (root < 0.0)
      break;
    found = (b + sqrt(root)) / a;
  }
  return found;
}

/* When the front of a cluster comes to a node from neighbours that are its. Towards the
 * cluster itself the way ends at its zero set. */
static double front_at(const march *m, size_t node, int cluster)
{
  const fg_density_arrays *grid = m->grid;
  double t[3], h[3];
  int at[3], count = 0;
  place_of(at, grid, node);
  for (int axis = 0; axis < grid->dimension; ++axis) {
    double earliest = HUGE_VAL, start = 0.0, length = 0.0;
    for (int way = -1; way < 2; way += 2) {
      size_t next;
      if (!next_node(&next, m, at, axis, way) || m->owner[next] != cluster ||
          m->time[next] == HUGE_VAL)
        continue;
      double edge = grid->spacing[axis];
      if (!m->within && m->label[next] == cluster && grid->u[node] <= 0.0F) {
        const double u = (double)grid->u[node], v = (double)grid->u[next];
        edge *= fmax(u / (u - v), NEAREST);
      }
      if (m->time[next] + edge >= earliest)
        continue;
      earliest = m->time[next] + edge;
      start = m->time[next];
      length = edge;
    }
    if (earliest < HUGE_VAL) {
      t[count] = start;
      h[count++] = length;
    }
  }
  return count > 0 ? arrival(t, h, count) : HUGE_VAL;
}

/* Offers the front at a node to its neighbours. False: no memory. */
static bool propagate(march *m, size_t node)
{
  const int cluster = m->owner[node];
  int at[3];
  place_of(at, m->grid, node);
  for (int axis = 0; axis < m->grid->dimension; ++axis)
    for (int way = -1; way < 2; way += 2) {
      size_t next;
      if (!next_node(&next, m, at, axis, way) || m->time[next] <= m->time[node] ||
          (m->within ? m->owner[next] != cluster : m->label[next] > 0))
        continue;
      const double time = front_at(m, next, cluster);
      if (!(time < m->time[next]))
        continue;
      m->time[next] = time;
      m->owner[next] = cluster;
      if (!fg__heap_push(&m->heap, time, (int)next))
        return false;
    }
  return true;
}

static bool run(march *m)
{
  bool room = true;
  for (size_t n = 0; n < m->nodes && room; ++n)
    if (m->time[n] < HUGE_VAL)
      room = propagate(m, n);
  while (room && m->heap.count > 0) {
    const fg__heap_entry next = fg__heap_pop(&m->heap);
    if (next.key <= m->time[next.index])
      room = propagate(m, (size_t)next.index);
  }
  return room;
}

/* The way from a node to the boundary of its territory, beside which it lies: half of the
 * time by which the nearest other front is later. */
static double way_to_boundary(const march *m, size_t node)
{
  double way = HUGE_VAL;
  int at[3];
  place_of(at, m->grid, node);
  for (int axis = 0; axis < m->grid->dimension; ++axis)
    for (int side = -1; side < 2; side += 2) {
      size_t next;
      if (!next_node(&next, m, at, axis, side) || m->owner[next] == 0 ||
          m->owner[next] == m->owner[node])
        continue;
      const double later = front_at(m, node, m->owner[next]) - m->time[node];
      way = fmin(way, fmax(0.5 * later, NEAREST * m->grid->spacing[axis]));
    }
  return way;
}

/* Sets m->time to the ways to the boundaries. */
static bool march_back(march *m)
{
  double *way = fg__allocate(m->nodes, sizeof *way);
  if (!way)
    return false;
  for (size_t n = 0; n < m->nodes; ++n)
    way[n] = m->owner[n] > 0 ? way_to_boundary(m, n) : HUGE_VAL;
  free(m->time);
  m->time = way;
  m->within = true;
  return run(m);
}

/* Leaves of each territory what is connected with its cluster. False: no memory. */
static bool keep_connected(float *level, const march *m)
{
  unsigned char *reached = fg__allocate(m->nodes, 1);
  size_t *stack = fg__allocate(m->nodes, sizeof *stack), waiting = 0;
  const bool room = reached && stack;
  for (size_t n = 0; n < m->nodes && room; ++n) {
    reached[n] = level[n] > 0.0F && m->label[n] > 0;
    if (reached[n])
      stack[waiting++] = n;
  }
  while (waiting > 0) {
    const size_t node = stack[--waiting];
    int at[3];
    place_of(at, m->grid, node);
    for (int axis = 0; axis < m->grid->dimension; ++axis)
      for (int way = -1; way < 2; way += 2) {
        size_t next;
        if (!next_node(&next, m, at, axis, way) || reached[next] ||
            !(level[next] > 0.0F) || m->owner[next] != m->owner[node])
          continue;
        reached[next] = 1;
        stack[waiting++] = next;
      }
  }
  for (size_t n = 0; n < m->nodes && room; ++n)
    if (!reached[n])
      level[n] = -fabsf(level[n]);
  free(reached);
  free(stack);
  return room;
}

/* The mean extent of a cluster: the root (cube root) of the domain over their number. */
static double mean_extent(const fg_density *density)
{
  const fg_density_arrays *grid = fg_density_contents(density);
  const int *label = fg_density_labels(density);
  double cells = 1.0, volume = 1.0;
  size_t nodes = 1;
  int clusters = 1;
  for (int k = 0; k < grid->dimension; ++k) {
    cells *= cells_along(grid, k);
    volume *= cells_along(grid, k) * grid->spacing[k];
    nodes *= (size_t)grid->nodes[k];
  }
  for (size_t n = 0; n < nodes; ++n)
    clusters = label[n] > clusters ? label[n] : clusters;
  double active = grid->active ? 0.0 : cells;
  for (size_t n = 0; grid->active && n < (size_t)cells; ++n)
    active += grid->active[n] != 0;
  const double each = volume * active / cells / clusters;
  return grid->dimension == 3 ? cbrt(each) : sqrt(each);
}

/* The territories as a density, and whose they are. */
static fg_status make(fg_density **out, int **cluster, fg_context *context,
                      const march *m, float *level, double gap)
{
  const size_t nodes = m->nodes;
  fg_density_arrays arrays = *m->grid;
  for (size_t n = 0; n < nodes; ++n)
    level[n] = m->owner[n] > 0 ? (float)fmin((m->time[n] - gap) / gap, 1e3) : -1.0F;
  if (!keep_connected(level, m))
    return fg__fail_memory(context, "the territories of clusters", nodes);
  arrays.u = level;
  fg_status status = fg_density_create_from_arrays(out, context, &arrays);
  if (status != FG_STATUS_OK)
    return status;
  const int *label = fg_density_labels(*out);
  *cluster = fg__allocate(nodes + 1, sizeof **cluster);
  if (!*cluster)
    return fg__fail_memory(context, "the territories of clusters", nodes);
  for (size_t n = 0; n < nodes; ++n)
    if (label[n] > 0)
      (*cluster)[label[n]] = m->owner[n];
  return FG_STATUS_OK;
}

fg_status fg__territories_create(fg_density **territories, fg__territory *out,
                                 fg_context *context, const fg_density *density)
{
  march m = {.grid = fg_density_contents(density), .label = fg_density_labels(density)};
  *territories = NULL;
  out->cluster = NULL;
  if (!m.label)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "icons: territories of a distributed density");
  m.nodes = 1;
  const double extent = mean_extent(density);
  double gap = GAP * extent;
  out->longest = LONGEST * extent;
  for (int k = 0; k < m.grid->dimension; ++k) {
    m.nodes *= (size_t)m.grid->nodes[k];
    gap = fmax(gap, LEAST_GAP * m.grid->spacing[k]);
  }
  float *level = fg__allocate(m.nodes, sizeof *level);
  m.owner = fg__allocate(m.nodes, sizeof *m.owner);
  m.time = fg__allocate(m.nodes, sizeof *m.time);
  bool room = level && m.owner && m.time;
  for (size_t n = 0; n < m.nodes && room; ++n) {
    m.owner[n] = m.label[n] > 0 ? m.label[n] : 0;
    m.time[n] = m.label[n] > 0 ? 0.0 : HUGE_VAL;
  }
  room = room && run(&m) && march_back(&m);
  fg_status status = room ? make(territories, &out->cluster, context, &m, level, gap)
                          : fg__fail_memory(context, "the territories of clusters",
                                            m.nodes * sizeof *m.time);
  fg__heap_clear(&m.heap);
  free(m.owner);
  free(m.time);
  free(level);
  if (status != FG_STATUS_OK) {
    fg_density_destroy(*territories);
    free(out->cluster);
    *territories = NULL;
    out->cluster = NULL;
  }
  return status;
}

double fg__territory_longest(const fg__territory *territory)
{
  return territory ? territory->longest : HUGE_VAL;
}

bool fg__territory_meets(const fg__territory *territory, int label,
                         const double position[])
{
  const fg_density_arrays *grid = fg_density_contents(territory->density);
  size_t node = 0;
  for (int k = grid->dimension - 1; k >= 0; --k) {
    const double x = (position[k] - grid->origin[k]) / grid->spacing[k];
    const int nodes = grid->nodes[k];
    int at = (int)fmin(fmax(floor(x + 0.5), -nodes), 2 * nodes);
    if (grid->periodic[k])
      at = (at % nodes + nodes) % nodes;
    at = at < 0 ? 0 : at >= nodes ? nodes - 1 : at;
    node = node * (size_t)nodes + (size_t)at;
  }
  return fg_density_labels(territory->density)[node] == territory->cluster[label];
}
