/* The surfaces of clusters, by marching tetrahedra: each cell is cut into the six that
 * share its main diagonal, so that faces of neighbouring cells are cut alike (Kuhn's
 * triangulation) and the surface has no gaps. */
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "base/vector.h"
#include "cluster/raster.h"

/* Edges begin at a node and go to one of the seven others of the cell above it: bit k of
 * an edge's number is its step along axis k. */
enum { EDGES = 8 };

typedef struct isosurface {
  const fg_density_arrays *density;
  const int *label;
  int points[3]; /* of the grid, with the repeated ends of periodic axes */
  fg_surface *out;
  size_t vertex_capacity, corner_capacity, normal_capacity, triangle_capacity;
  int *edge[2]; /* of two planes of points: the vertex on each edge, -1 not yet */
} isosurface;

static size_t node_of(const isosurface *s, const int at[3])
{
  size_t node = 0;
  for (int k = 2; k >= 0; --k)
    node = node * (size_t)s->density->nodes[k] + (size_t)(at[k] % s->density->nodes[k]);
  return node;
}

/* Debris is left out as if it were not positive. */
static double level_at(const isosurface *s, const int at[3])
{
  size_t node = node_of(s, at);
  double u = (double)s->density->u[node];
  return u > 0.0 && s->label[node] <= 0 ? -u / 1024.0 : u;
}

static bool cell_active(const isosurface *s, const int at[3])
{
  size_t cell = 0;
  for (int k = 2; k >= 0; --k)
    cell = cell * (size_t)(s->points[k] - 1) + (size_t)at[k];
  return !s->density->active || s->density->active[cell];
}

/* Central differences, one-sided at a boundary. */
static void gradient_at(const isosurface *s, const int at[3], double out[3])
{
  for (int k = 0; k < 3; ++k) {
    int low[3], high[3], count = s->density->nodes[k];
    memcpy(low, at, sizeof low);
    memcpy(high, at, sizeof high);
    bool periodic = s->density->periodic[k];
    low[k] = periodic ? (at[k] + count - 1) % count : at[k] > 0 ? at[k] - 1 : 0;
    high[k] = periodic ? (at[k] + 1) % count : at[k] < count - 1 ? at[k] + 1 : at[k];
    int steps = periodic ? 2 : high[k] - low[k];
    out[k] = (level_at(s, high) - level_at(s, low)) / (steps * s->density->spacing[k]);
  }
}

/* The vertex on the edge from a point to another whose steps are the bits of `edge`; -1
 * when there is no memory. */
static int vertex_on(isosurface *s, const int from[3], int edge, int plane)
{
  size_t row = (size_t)s->points[0], number = EDGES;
  int *known =
      &s->edge[plane][((size_t)from[1] * row + (size_t)from[0]) * number + (size_t)edge];
  if (*known >= 0)
    return *known;
  fg_surface *out = s->out;
  size_t needed = (size_t)out->vertex_count + 1;
  if (!fg__grow((void **)&out->vertex, &s->vertex_capacity, needed,
                sizeof *out->vertex) ||
      !fg__grow((void **)&out->corner, &s->corner_capacity, needed,
                sizeof *out->corner) ||
      !fg__grow((void **)&out->normal, &s->normal_capacity, needed, sizeof *out->normal))
    return -1;
  int to[3];
  for (int k = 0; k < 3; ++k)
    to[k] = from[k] + (edge >> k & 1);
  double low = level_at(s, from), high = level_at(s, to), one[3], other[3];
  double share = low / (low - high);
  gradient_at(s, from, one);
  gradient_at(s, to, other);
  double normal[3], *vertex = out->vertex[out->vertex_count];
  for (int k = 0; k < 3; ++k) {
    vertex[k] = s->density->origin[k] +
                s->density->spacing[k] * (from[k] + share * (to[k] - from[k]));
    normal[k] = -(one[k] + share * (other[k] - one[k]));
  }
  if (!fg__normalise(normal))
    normal[2] = 1.0;
  for (int k = 0; k < 3; ++k)
    out->normal[out->vertex_count][k] = (float)normal[k];
  out->corner[out->vertex_count] = out->vertex_count;
  out->corner_count++;
  return *known = out->vertex_count++;
}

/* The vertex between two corners of a cell, named by bits; one's are among the other's.
 */
static int vertex_between(isosurface *s, const int cell[3], int a, int b)
{
  int low = a < b ? a : b, high = a < b ? b : a, from[3];
  for (int k = 0; k < 3; ++k)
    from[k] = cell[k] + (low >> k & 1);
  return vertex_on(s, from, high ^ low, low >> 2 & 1);
}

/* Turned so that it faces where u falls. */
static bool add_triangle(isosurface *s, const int v[3])
{
  fg_surface *out = s->out;
  if (v[0] < 0 || v[1] < 0 || v[2] < 0 ||
      !fg__grow((void **)&out->triangle, &s->triangle_capacity,
                (size_t)out->triangle_count + 1, sizeof *out->triangle))
    return false;
  double a[3], b[3], face[3], side = 0.0;
  fg__subtract(out->vertex[v[1]], out->vertex[v[0]], a);
  fg__subtract(out->vertex[v[2]], out->vertex[v[0]], b);
  fg__cross(a, b, face);
  for (int n = 0; n < 3; ++n)
    for (int k = 0; k < 3; ++k)
      side += face[k] * (double)out->normal[v[n]][k];
  int *triangle = out->triangle[out->triangle_count++];
  triangle[0] = v[0];
  triangle[1] = side < 0.0 ? v[2] : v[1];
  triangle[2] = side < 0.0 ? v[1] : v[2];
  return true;
}

/* One tetrahedron, by the bits of its corners, inside ones first. */
static bool cut_tetrahedron(isosurface *s, const int cell[3], const int corner[4],
                            const bool inside[8])
{
  int order[4], in = 0, out = 0;
  for (int n = 0; n < 4; ++n)
    if (inside[corner[n]])
      order[in++] = corner[n];
  for (int n = 0; n < 4; ++n)
    if (!inside[corner[n]])
      order[in + out++] = corner[n];
  if (in == 0 || out == 0)
    return true;
  int v[4];
  if (in == 2) {
    for (int n = 0; n < 4; ++n) /* round the quadrilateral: 02, 03, 13, 12 */
      v[n] = vertex_between(s, cell, order[n >> 1], order[2 + ((n + 1) >> 1 & 1)]);
    const int one[3] = {v[0], v[1], v[2]}, other[3] = {v[0], v[2], v[3]};
    return add_triangle(s, one) && add_triangle(s, other);
  }
  int lone = in == 1 ? order[0] : order[3];
  for (int n = 0; n < 3; ++n)
    v[n] = vertex_between(s, cell, lone, in == 1 ? order[n + 1] : order[n]);
  return add_triangle(s, v);
}

static bool cut_cell(isosurface *s, const int cell[3])
{
  static const int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                       {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
  bool inside[8];
  int count = 0;
  for (int c = 0; c < 8; ++c) {
    const int at[3] = {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
    inside[c] = level_at(s, at) > 0.0;
    count += inside[c];
  }
  if (count == 0 || count == 8 || !cell_active(s, cell))
    return true;
  for (int n = 0; n < 6; ++n)
    if (!cut_tetrahedron(s, cell, tetrahedra[n], inside))
      return false;
  return true;
}

static bool cut_all(isosurface *s)
{
  size_t plane = (size_t)s->points[0] * (size_t)s->points[1] * EDGES;
  int cell[3];
  memset(s->edge[0], -1, plane * sizeof(int));
  for (cell[2] = 0; cell[2] < s->points[2] - 1; ++cell[2]) {
    memset(s->edge[1], -1, plane * sizeof(int));
    for (cell[1] = 0; cell[1] < s->points[1] - 1; ++cell[1])
      for (cell[0] = 0; cell[0] < s->points[0] - 1; ++cell[0])
        if (!cut_cell(s, cell))
          return false;
    int *swap = s->edge[0];
    s->edge[0] = s->edge[1];
    s->edge[1] = swap;
  }
  return true;
}

fg_status fg_density_surface(fg_surface **out, fg_context *context,
                             const fg_density *density)
{
  if (!out || !density || fg_density_is_distributed(density) ||
      fg_density_contents(density)->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "a surface: a whole density in 3 dimensions is needed");
  isosurface s = {.density = fg_density_contents(density)};
  fg__labels labels;
  *out = NULL;
  fg_status status = fg__labels_create(&labels, context, density);
  if (status)
    return status;
  s.label = labels.label;
  for (int k = 0; k < 3; ++k)
    s.points[k] = s.density->nodes[k] + s.density->periodic[k];
  size_t plane = (size_t)s.points[0] * (size_t)s.points[1] * EDGES;
  for (int k = 0; k < 2; ++k)
    s.edge[k] = fg__allocate(plane, sizeof *s.edge[k]);
  s.out = fg__allocate(1, sizeof *s.out);
  if (!s.edge[0] || !s.edge[1] || !s.out || !cut_all(&s)) {
    status = fg__fail_memory(context, "clusters' surfaces", plane * sizeof(int));
    fg_surface_destroy(s.out);
    s.out = NULL;
  }
  *out = s.out;
  free(s.edge[0]);
  free(s.edge[1]);
  fg__labels_clear(&labels);
  return status;
}
