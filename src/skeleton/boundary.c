#include "skeleton/boundary.h"

#include <math.h>

#include "component/components.h"

/* Lowers the distances of the nodes from `low` to `high` to that from the segment p q,
 * all in node units. */
static void add_segment(double *distance, const fg__window *window, const int low[2],
                        const int high[2], const double p[2], const double q[2])
{
  double along[2] = {(q[0] - p[0]) * window->spacing[0],
                     (q[1] - p[1]) * window->spacing[1]};
  double square = along[0] * along[0] + along[1] * along[1];
  double scale = square > 0.0 ? 1.0 / square : 0.0;
  int first_x = low[0] < 0 ? 0 : low[0];
  int last_x = high[0] > window->nodes[0] - 1 ? window->nodes[0] - 1 : high[0];
  int first_y = low[1] < 0 ? 0 : low[1];
  int last_y = high[1] > window->nodes[1] - 1 ? window->nodes[1] - 1 : high[1];
  for (int y = first_y; y <= last_y; ++y) {
    double *row = distance + (size_t)y * (size_t)window->nodes[0];
    double to_y = (y - p[1]) * window->spacing[1];
    for (int x = first_x; x <= last_x; ++x) {
      double to_x = (x - p[0]) * window->spacing[0];
      double share = (to_x * along[0] + to_y * along[1]) * scale;
      share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
      double off_x = to_x - share * along[0];
      double off_y = to_y - share * along[1];
      double value = sqrt(off_x * off_x + off_y * off_y);
      if (value < row[x])
        row[x] = value;
    }
  }
}

/* Place along an edge from a value > 0 to one that is not, or the other way round. */
static double zero_on_edge(double from, double to)
{
  double share = from / (from - to);
  return share >= 0.0 && share <= 1.0 ? share : 0.5;
}

/* Corners of a cell in turn round it. */
static const int corner_x[4] = {0, 1, 1, 0};
static const int corner_y[4] = {0, 0, 1, 1};

/* The zero of edge k (from corner k to the next one), relative to the cell. */
static void edge_zero(const double v[4], int k, double point[2])
{
  int next = (k + 1) & 3;
  double share = zero_on_edge(v[k], v[next]);
  point[0] = corner_x[k] + share * (corner_x[next] - corner_x[k]);
  point[1] = corner_y[k] + share * (corner_y[next] - corner_y[k]);
}

/* A branch of the zero set, from edge j to edge k of cell (x, y), as two chords that meet
 * on it. Along the wider of its two extents the branch is the graph of a function. */
static void add_branch(double *distance, const fg__window *window, int x, int y,
                       const double v[4], int j, int k)
{
  double ends[2][2];
  edge_zero(v, j, ends[0]);
  edge_zero(v, k, ends[1]);
  double middle[2];
  int axis = fabs(ends[1][0] - ends[0][0]) >= fabs(ends[1][1] - ends[0][1]) ? 0 : 1;
  double at = 0.5 * (ends[0][axis] + ends[1][axis]);
  /* the bilinear level on the line where that coordinate is `at`, at its two ends */
  double low = (1.0 - at) * v[0] + at * (axis == 0 ? v[1] : v[3]);
  double high = (1.0 - at) * (axis == 0 ? v[3] : v[1]) + at * v[2];
  double share = low / (low - high);
  if (!(share >= 0.0 && share <= 1.0))
    share = 0.5 * (ends[0][1 - axis] + ends[1][1 - axis]);
  middle[axis] = at;
  middle[1 - axis] = share;
  for (int m = 0; m < 2; ++m) {
    ends[m][0] += x;
    ends[m][1] += y;
  }
  middle[0] += x;
  middle[1] += y;
  const int from[2] = {x - 1, y - 1};
  const int to[2] = {x + 2, y + 2};
  add_segment(distance, window, from, to, ends[0], middle);
  add_segment(distance, window, from, to, middle, ends[1]);
}

/* The zero set inside an active cell. */
static void add_cell(double *distance, const fg__window *window, int x, int y)
{
  size_t width = (size_t)window->nodes[0];
  const float *low = window->level + (size_t)y * width + (size_t)x;
  const float *high = low + width;
  bool positive[4] = {low[0] > 0.0F, low[1] > 0.0F, high[1] > 0.0F, high[0] > 0.0F};
  int count = positive[0] + positive[1] + positive[2] + positive[3];
  if (count == 0 || count == 4)
    return;
  const double v[4] = {(double)low[0], (double)low[1], (double)high[1], (double)high[0]};
  if (count == 2 && positive[0] == positive[2]) {
    /* two branches: each cuts off a negative corner when the positive ones are joined
     * across the cell, else a positive one */
    int p = positive[0] ? 0 : 1;
    bool joined = fg__components_saddle_joins((float)v[p], (float)v[p + 1],
                                              (float)v[(p + 3) & 3], (float)v[p + 2]);
    int first = joined ? p + 1 : p;
    add_branch(distance, window, x, y, v, (first + 3) & 3, first);
    add_branch(distance, window, x, y, v, (first + 1) & 3, (first + 2) & 3);
    return;
  }
  int crossed[4];
  int crossings = 0;
  for (int k = 0; k < 4; ++k) {
    if (positive[k] != positive[(k + 1) & 3])
      crossed[crossings++] = k;
  }
  add_branch(distance, window, x, y, v, crossed[0], crossed[1]);
}

/* The positive part of the edge from node (x, y) along `axis`. */
static void add_edge(double *distance, const fg__window *window, int x, int y, int axis)
{
  size_t step = axis == 0 ? 1 : (size_t)window->nodes[0];
  const float *start = window->level + (size_t)y * (size_t)window->nodes[0] + x;
  double from = (double)start[0];
  double to = (double)start[step];
  if (!(from > 0.0) && !(to > 0.0))
    return;
  double first = from > 0.0 ? 0.0 : zero_on_edge(from, to);
  double last = to > 0.0 ? 1.0 : zero_on_edge(from, to);
  double p[2] = {x, y};
  double q[2] = {x, y};
  p[axis] += first;
  q[axis] += last;
  const int low[2] = {x - 1, y - 1};
  const int high[2] = {x + (axis == 0 ? 2 : 1), y + (axis == 0 ? 1 : 2)};
  add_segment(distance, window, low, high, p, q);
}

static bool cell_active(const fg__window *window, int x, int y)
{
  return window->active[(size_t)y * (size_t)(window->nodes[0] - 1) + (size_t)x];
}

/* Whether what lies on the two sides of a cell's side is domain on one and none on the
 * other: beyond the window only the domain's boundary makes a difference. */
static bool is_end_of_domain(const fg__window *window, int x, int y, int side,
                             bool domain_boundary_counts)
{
  int beyond_x = x + (side == 0 ? -1 : side == 1 ? 1 : 0);
  int beyond_y = y + (side == 2 ? -1 : side == 3 ? 1 : 0);
  if (beyond_x < 0 || beyond_x >= window->nodes[0] - 1 || beyond_y < 0 ||
      beyond_y >= window->nodes[1] - 1)
    return domain_boundary_counts && window->at_boundary[side];
  return !cell_active(window, beyond_x, beyond_y);
}

void fg__boundary_distance(double *distance, const fg__window *window,
                           bool domain_boundary_counts)
{
  if (window->dimension == 3) {
    fg__boundary_distance_solid(distance, window, domain_boundary_counts);
    return;
  }
  for (size_t k = 0; k < fg__window_count(window); ++k)
    distance[k] = HUGE_VAL;
  for (int y = 0; y < window->nodes[1] - 1; ++y) {
    for (int x = 0; x < window->nodes[0] - 1; ++x) {
      if (!cell_active(window, x, y))
        continue;
      add_cell(distance, window, x, y);
      for (int side = 0; side < 4; ++side) {
        if (is_end_of_domain(window, x, y, side, domain_boundary_counts))
          add_edge(distance, window, x + (side == 1), y + (side == 3), side < 2);
      }
    }
  }
}
