#include <math.h>

#include "skeleton/boundary.h"

/* A node that touches a masked cell, or lies on a side of the window where the cluster
 * ends by itself. */
static bool touches_boundary(const fg__window *window, const int place[3],
                             bool domain_boundary_counts)
{
  for (int k = 0; k < 3 && domain_boundary_counts; ++k)
    if ((place[k] == 0 && window->at_boundary[2 * k]) ||
        (place[k] == window->nodes[k] - 1 && window->at_boundary[2 * k + 1]))
      return true;
  for (int c = 0; c < 8; ++c) {
    const int x = place[0] - (c & 1), y = place[1] - (c >> 1 & 1),
              z = place[2] - (c >> 2);
    if (x >= 0 && y >= 0 && z >= 0 && x < window->nodes[0] - 1 &&
        y < window->nodes[1] - 1 && z < window->nodes[2] - 1 &&
        !window->active[fg__window_cell(window, x, y, z)])
      return true;
  }
  return false;
}

/* Distance to the plane through the crossings of the zero set on the node's own edges;
 * HUGE_VAL when there is none. */
static double plane_distance(const fg__window *window, size_t node, const int place[3])
{
  const ptrdiff_t stride[3] = {1, window->nodes[0],
                               (ptrdiff_t)window->nodes[0] * window->nodes[1]};
  double inverse = 0.0, here = (double)window->level[node];
  for (int k = 0; k < 3; ++k) {
    double nearest = HUGE_VAL;
    for (int step = -1; step <= 1; step += 2) {
      if (place[k] + step < 0 || place[k] + step >= window->nodes[k])
        continue;
      double there = (double)window->level[(ptrdiff_t)node + step * stride[k]];
      if (!(there > 0.0))
        nearest = fmin(nearest, window->spacing[k] * here / (here - there));
    }
    if (!(nearest > 0.0))
      return 0.0;
    inverse += 1.0 / (nearest * nearest);
  }
  return inverse > 0.0 ? 1.0 / sqrt(inverse) : HUGE_VAL;
}

void fg__boundary_distance_solid(double *distance, const fg__window *window,
                                 bool domain_boundary_counts)
{
  for (size_t node = 0; node < fg__window_count(window); ++node) {
    int place[3];
    distance[node] = HUGE_VAL;
    if (!(window->level[node] > 0.0F))
      continue;
    fg__window_place(window, node, place);
    distance[node] = touches_boundary(window, place, domain_boundary_counts)
                         ? 0.0
                         : plane_distance(window, node, place);
  }
}
