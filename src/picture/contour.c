#include "picture/contour.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/polygons.h"

/* The density with its repeated last column or row where it is periodic, and a rim of
 * negative nodes that lie on the boundary itself: every line of u = 0 is then closed,
 * along the boundary where the domain ends. Cell (i, j) has its lower left corner in node
 * (i - 1, j - 1). */
typedef struct level_grid {
  const fg_density_arrays *density;
  int nodes[2]; /* without the rim */
} level_grid;

static int wrapped(int index, int count)
{
  return index >= count ? index - count : index;
}

/* Inactive where no active cell touches the node. */
static bool touches_active(const fg_density_arrays *density, int i, int j)
{
  if (!density->active)
    return true;
  int cells[2];
  for (int k = 0; k < 2; ++k)
    cells[k] = density->periodic[k] ? density->nodes[k] : density->nodes[k] - 1;
  for (int dj = -1; dj <= 0; ++dj) {
    for (int di = -1; di <= 0; ++di) {
      int x = i + di, y = j + dj;
      if (density->periodic[0])
        x = (x + cells[0]) % cells[0];
      if (density->periodic[1])
        y = (y + cells[1]) % cells[1];
      if (x < 0 || y < 0 || x >= cells[0] || y >= cells[1])
        continue;
      if (density->active[(size_t)y * (size_t)cells[0] + (size_t)x])
        return true;
    }
  }
  return false;
}

static double level_at(const level_grid *s, int i, int j)
{
  if (i < 0 || j < 0 || i >= s->nodes[0] || j >= s->nodes[1])
    return -1.0;
  i = wrapped(i, s->density->nodes[0]);
  j = wrapped(j, s->density->nodes[1]);
  double level =
      (double)s->density->u[(size_t)j * (size_t)s->density->nodes[0] + (size_t)i];
  if (!isfinite(level) || !touches_active(s->density, i, j))
    return -1.0;
  return level;
}

static double coordinate(const level_grid *s, int axis, int index)
{
  int inside = index < 0 ? 0 : index >= s->nodes[axis] ? s->nodes[axis] - 1 : index;
  return s->density->origin[axis] + inside * s->density->spacing[axis];
}

/* Corners of a cell against the clock from the lower left; edge k joins corner k to the
 * next one. */
static const int corner_x[4] = {0, 1, 1, 0};
static const int corner_y[4] = {0, 0, 1, 1};

typedef struct walker {
  int cell[2];
  int edge; /* along it, against the clock, the level falls through zero */
} walker;

static void corner_levels(const level_grid *s, const int cell[2], double level[4])
{
  for (int k = 0; k < 4; ++k)
    level[k] = level_at(s, cell[0] - 1 + corner_x[k], cell[1] - 1 + corner_y[k]);
}

static bool falls(const double level[4], int edge)
{
  return level[edge] > 0.0 && !(level[(edge + 1) & 3] > 0.0);
}

static bool rises(const double level[4], int edge)
{
  return !(level[edge] > 0.0) && level[(edge + 1) & 3] > 0.0;
}

/* Value of the bilinear density at its saddle point has the sign of this difference times
 * that of the sum below; both diagonals differ in sign, so one comparison tells whether
 * the positive corners are joined. */
static bool positive_joined(const double level[4])
{
  double sum = level[0] - level[1] + level[2] - level[3];
  double saddle = level[0] * level[2] - level[1] * level[3];
  return saddle * sum > 0.0;
}

static int exit_edge(const double level[4], int entry)
{
  bool saddle = falls(level, entry) && falls(level, (entry + 2) & 3);
  if (saddle)
    return positive_joined(level) ? (entry + 1) & 3 : (entry + 3) & 3;
  for (int step = 1; step < 4; ++step)
    if (rises(level, (entry + step) & 3))
      return (entry + step) & 3;
  return (entry + 2) & 3;
}

static void crossing(const level_grid *s, const walker *at, const double level[4],
                     double point[2])
{
  int a = at->edge, b = (at->edge + 1) & 3;
  double share = level[a] / (level[a] - level[b]);
  const int *corner[2] = {corner_x, corner_y};
  for (int k = 0; k < 2; ++k) {
    double from = coordinate(s, k, at->cell[k] - 1 + corner[k][a]);
    double to = coordinate(s, k, at->cell[k] - 1 + corner[k][b]);
    point[k] = from + share * (to - from);
  }
}

/* Follows one line of u = 0 with the positive side to its left. */
static bool follow(fg__polygons *out, const level_grid *s, unsigned char *visited,
                   walker at)
{
  static const int step_x[4] = {0, 1, 0, -1};
  static const int step_y[4] = {-1, 0, 1, 0};
  size_t row = (size_t)s->nodes[0] + 1;
  if (!fg__polygons_begin(out))
    return false;
  for (;;) {
    unsigned char *seen = &visited[(size_t)at.cell[1] * row + (size_t)at.cell[0]];
    if (*seen & 1 << at.edge)
      return true;
    *seen = (unsigned char)(*seen | 1 << at.edge);
    double level[4], point[2];
    corner_levels(s, at.cell, level);
    crossing(s, &at, level, point);
    if (!fg__polygons_add(out, point))
      return false;
    int leave = exit_edge(level, at.edge);
    at.cell[0] += step_x[leave];
    at.cell[1] += step_y[leave];
    at.edge = (leave + 2) & 3;
  }
}

static bool at_periodic_boundary(const level_grid *s, const fg__polygons *polygons,
                                 size_t loop)
{
  for (int k = 0; k < 2; ++k) {
    if (!s->density->periodic[k])
      continue;
    double low = coordinate(s, k, 0), high = coordinate(s, k, s->nodes[k] - 1);
    for (size_t n = polygons->start[loop]; n < polygons->start[loop + 1]; ++n)
      if (polygons->point[n][k] <= low || polygons->point[n][k] >= high)
        return true;
  }
  return false;
}

fg_status fg__contour_positive(fg__polygons *out, fg_context *context,
                               const fg_density_arrays *density)
{
  level_grid s = {density,
                  {density->nodes[0] + density->periodic[0],
                   density->nodes[1] + density->periodic[1]}};
  size_t cells = ((size_t)s.nodes[0] + 1) * ((size_t)s.nodes[1] + 1);
  unsigned char *visited = fg__allocate(cells, 1);
  *out = (fg__polygons){0};
  if (!visited)
    return fg__fail_memory(context, "the tint of the clusters", cells);
  for (walker at = {{0, 0}, 0}; at.cell[1] <= s.nodes[1]; ++at.cell[1]) {
    for (at.cell[0] = 0; at.cell[0] <= s.nodes[0]; ++at.cell[0]) {
      double level[4];
      corner_levels(&s, at.cell, level);
      size_t here = (size_t)at.cell[1] * ((size_t)s.nodes[0] + 1) + (size_t)at.cell[0];
      for (at.edge = 0; at.edge < 4; ++at.edge) {
        if (!falls(level, at.edge) || visited[here] & 1 << at.edge)
          continue;
        if (!follow(out, &s, visited, at)) {
          free(visited);
          fg__polygons_clear(out);
          return fg__fail_memory(context, "the tint of the clusters", cells);
        }
        size_t loop = out->count - 1;
        double area = fg__polygon_area(out, loop);
        if (area >= 0.0 && area < density->debris_area &&
            !at_periodic_boundary(&s, out, loop))
          fg__polygons_drop_last(out);
      }
    }
  }
  free(visited);
  return FG_STATUS_OK;
}
