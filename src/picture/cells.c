/* Outlines of masked cells: the border between masked and other cells is followed along
 * the grid's lines, and its corners are rounded by a quadratic B-spline, whose control
 * points are the grid's corners: it runs through the middle of every cell edge. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/polygons.h"

/* Pieces that a rounded corner is drawn with: a quarter turn in 6 pieces departs from the
 * curve by 1/300 of the cell. */
enum { CORNER_PIECES = 6 };

/* East, north, west, south. */
static const int step_x[4] = {1, 0, -1, 0};
static const int step_y[4] = {0, 1, 0, -1};

typedef struct grid {
  const unsigned char *mask;
  const int *size;
  const double *const *edges;
  unsigned char *visited; /* a bit a direction for each corner of the grid */
  fg__polygons *out;
} grid;

static bool masked(const grid *g, int i, int j)
{
  return i >= 0 && j >= 0 && i < g->size[0] && j < g->size[1] &&
         g->mask[(size_t)j * (size_t)g->size[0] + (size_t)i];
}

/* Whether the border leaves corner (i, j) in a direction: a masked cell to its left and
 * none to its right. */
static bool leads(const grid *g, int i, int j, int direction)
{
  static const int left_x[4] = {0, -1, -1, 0};
  static const int left_y[4] = {0, 0, -1, -1};
  int right = (direction + 3) & 3;
  return masked(g, i + left_x[direction], j + left_y[direction]) &&
         !masked(g, i + left_x[right], j + left_y[right]);
}

/* Where two masked cells touch at a corner only, the border turns left: they stay apart.
 */
static int turn(const grid *g, int i, int j, int direction)
{
  if (leads(g, i, j, (direction + 1) & 3))
    return (direction + 1) & 3;
  return leads(g, i, j, direction) ? direction : (direction + 3) & 3;
}

static void corner(const grid *g, int i, int j, double point[2])
{
  point[0] = g->edges[0][i];
  point[1] = g->edges[1][j];
}

static bool on_border(const grid *g, int i, int j)
{
  return i == 0 || j == 0 || i == g->size[0] || j == g->size[1];
}

/* Adds the corner where the border, coming along `from`, turns to `to`. */
static bool add_turn(const grid *g, int i, int j, int from, int to)
{
  double before[2], at[2], after[2];
  corner(g, i, j, at);
  if (on_border(g, i, j))
    return fg__polygons_add(g->out, at);
  corner(g, i - step_x[from], j - step_y[from], before);
  corner(g, i + step_x[to], j + step_y[to], after);
  for (int k = 0; k <= CORNER_PIECES; ++k) {
    double t = (double)k / CORNER_PIECES;
    double a = 0.5 * (1.0 - t) * (1.0 - t), c = 0.5 * t * t, b = 1.0 - a - c;
    double point[2] = {a * before[0] + b * at[0] + c * after[0],
                       a * before[1] + b * at[1] + c * after[1]};
    if (!fg__polygons_add(g->out, point))
      return false;
  }
  return true;
}

static bool follow(const grid *g, int i, int j)
{
  size_t row = (size_t)g->size[0] + 1;
  int direction = 0;
  if (!fg__polygons_begin(g->out))
    return false;
  for (;;) {
    unsigned char *seen = &g->visited[(size_t)j * row + (size_t)i];
    if (*seen & 1 << direction)
      return true;
    *seen = (unsigned char)(*seen | 1 << direction);
    i += step_x[direction];
    j += step_y[direction];
    int next = turn(g, i, j, direction);
    if (next != direction && !add_turn(g, i, j, direction, next))
      return false;
    direction = next;
  }
}

fg_status fg__contour_cells(fg__polygons *out, fg_context *context,
                            const unsigned char *mask, const int size[2],
                            const double *const edges[2])
{
  *out = (fg__polygons){0};
  size_t corners = ((size_t)size[0] + 1) * ((size_t)size[1] + 1);
  grid g = {mask, size, edges, fg__allocate(corners, 1), out};
  if (!g.visited)
    return fg__fail_memory(context, "the outline of the mask", corners);
  /* Every loop goes east somewhere. */
  for (int j = 0; j <= size[1]; ++j) {
    for (int i = 0; i < size[0]; ++i) {
      size_t here = (size_t)j * ((size_t)size[0] + 1) + (size_t)i;
      if (g.visited[here] & 1 || !leads(&g, i, j, 0))
        continue;
      if (!follow(&g, i, j)) {
        free(g.visited);
        fg__polygons_clear(out);
        return fg__fail_memory(context, "the outline of the mask", corners);
      }
    }
  }
  free(g.visited);
  return FG_STATUS_OK;
}
