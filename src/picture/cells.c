/* Outlines of masked cells: the boundary between masked and other cells is followed along
 * the grid's lines, then smoothed, because its steps belong to the grid and not to the
 * coast: passes of Taubin's filter ("A Signal Processing Approach to Fair Surface
 * Design", SIGGRAPH 1995), which keeps areas, and a quadratic B-spline through the
 * result. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/polygons.h"

/* Pieces that the spline is drawn with from vertex to vertex. */
enum { SPLINE_PIECES = 3 };

/* Eight passes leave 0.13 of a staircase of single cells and 0.89 of a lone cell's width.
 */
enum { SMOOTHING_PASSES = 8 };
static const double smoothing[2] = {0.5, -0.53};

/* East, north, west, south. */
static const int step_x[4] = {1, 0, -1, 0};
static const int step_y[4] = {0, 1, 0, -1};

typedef struct grid {
  const unsigned char *mask;
  const int *size;
  const double *const *edges;
  unsigned char *visited; /* a bit a direction for each corner of the grid */
  fg__polygons *out;
  fg__polygons steps; /* the loop being followed: corners and middles of cell edges */
  double (*smooth)[2];
  size_t smooth_capacity;
} grid;

static bool masked(const grid *g, int i, int j)
{
  return i >= 0 && j >= 0 && i < g->size[0] && j < g->size[1] &&
         g->mask[(size_t)j * (size_t)g->size[0] + (size_t)i];
}

/* Whether the boundary leaves corner (i, j) in a direction: a masked cell to its left and
 * none to its right. */
static bool leads(const grid *g, int i, int j, int direction)
{
  static const int left_x[4] = {0, -1, -1, 0};
  static const int left_y[4] = {0, 0, -1, -1};
  int right = (direction + 3) & 3;
  return masked(g, i + left_x[direction], j + left_y[direction]) &&
         !masked(g, i + left_x[right], j + left_y[right]);
}

/* Where two masked cells touch at a corner only, the boundary turns left: they stay
 * apart.
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

static bool on_boundary(const grid *g, const double point[2])
{
  for (int k = 0; k < 2; ++k)
    if (point[k] == g->edges[k][0] || point[k] == g->edges[k][g->size[k]])
      return true;
  return false;
}

/* One half of a pass: every vertex moves by a share of the way to its neighbours' middle,
 * but for those on the boundary, which the frame shows to be straight. */
static void smooth_once(const grid *g, double (*to)[2], double (*from)[2], size_t count,
                        double share)
{
  for (size_t n = 0; n < count; ++n) {
    const double *before = from[n ? n - 1 : count - 1];
    const double *after = from[n + 1 < count ? n + 1 : 0];
    double weight = on_boundary(g, from[n]) ? 0.0 : share;
    for (int k = 0; k < 2; ++k)
      to[n][k] = from[n][k] + weight * (0.5 * (before[k] + after[k]) - from[n][k]);
  }
}

/* Adds the spline's piece round vertex n: from the middle before it to the one after. */
static bool add_piece(const grid *g, double (*point)[2], size_t count, size_t n)
{
  const double *before = point[n ? n - 1 : count - 1], *at = point[n];
  const double *after = point[n + 1 < count ? n + 1 : 0];
  if (on_boundary(g, at))
    return fg__polygons_add(g->out, at);
  for (int k = 0; k < SPLINE_PIECES; ++k) {
    double t = (double)k / SPLINE_PIECES;
    double a = 0.5 * (1.0 - t) * (1.0 - t), c = 0.5 * t * t, b = 1.0 - a - c;
    double on_curve[2] = {a * before[0] + b * at[0] + c * after[0],
                          a * before[1] + b * at[1] + c * after[1]};
    if (!fg__polygons_add(g->out, on_curve))
      return false;
  }
  return true;
}

static bool add_smoothed(grid *g)
{
  size_t count = g->steps.point_count;
  void *smooth = g->smooth;
  bool good = fg__grow(&smooth, &g->smooth_capacity, count, sizeof *g->smooth);
  g->smooth = smooth;
  if (!good || !fg__polygons_begin(g->out))
    return false;
  for (int pass = 0; pass < SMOOTHING_PASSES; ++pass) {
    smooth_once(g, g->smooth, g->steps.point, count, smoothing[0]);
    smooth_once(g, g->steps.point, g->smooth, count, smoothing[1]);
  }
  for (size_t n = 0; n < count; ++n)
    if (!add_piece(g, g->steps.point, count, n))
      return false;
  return true;
}

static bool follow(grid *g, int i, int j)
{
  size_t row = (size_t)g->size[0] + 1;
  int direction = 0;
  if (g->steps.count)
    fg__polygons_drop_last(&g->steps);
  if (!fg__polygons_begin(&g->steps))
    return false;
  for (;;) {
    unsigned char *seen = &g->visited[(size_t)j * row + (size_t)i];
    if (*seen & 1 << direction)
      return add_smoothed(g);
    *seen = (unsigned char)(*seen | 1 << direction);
    double from[2], to[2];
    corner(g, i, j, from);
    i += step_x[direction];
    j += step_y[direction];
    corner(g, i, j, to);
    double middle[2] = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
    if (!fg__polygons_add(&g->steps, from) || !fg__polygons_add(&g->steps, middle))
      return false;
    direction = turn(g, i, j, direction);
  }
}

fg_status fg__contour_cells(fg__polygons *out, fg_context *context,
                            const unsigned char *mask, const int size[2],
                            const double *const edges[2])
{
  *out = (fg__polygons){0};
  size_t corners = ((size_t)size[0] + 1) * ((size_t)size[1] + 1);
  grid g = {.mask = mask, .size = size, .edges = edges, .out = out};
  g.visited = fg__allocate(corners, 1);
  bool good = g.visited != NULL;
  /* Every loop goes east somewhere. */
  for (int j = 0; good && j <= size[1]; ++j) {
    for (int i = 0; good && i < size[0]; ++i) {
      size_t here = (size_t)j * ((size_t)size[0] + 1) + (size_t)i;
      if (!(g.visited[here] & 1) && leads(&g, i, j, 0))
        good = follow(&g, i, j);
    }
  }
  free(g.visited);
  free(g.smooth);
  fg__polygons_clear(&g.steps);
  if (good)
    return FG_STATUS_OK;
  fg__polygons_clear(out);
  return fg__fail_memory(context, "the outline of the mask", corners);
}
