#include "cluster/cut.h"

#include <math.h>

#include "component/components.h"

float fg__cut_turned_off(float u)
{
  return fminf(-u / 1024.0F, -0x1p-100F);
}

int fg__cut_place(int *nodes, double *origin, bool at_border[2],
                  const fg_density_arrays *density, const fg__labels *labels, int cluster,
                  int axis)
{
  const int *bounds = labels->bounds[cluster - 1] + 2 * axis;
  bool closed = labels->closed[cluster - 1][axis];
  int rim = closed ? 0 : FG__CUT_RIM, most = density->nodes[axis] - 1;
  int first = bounds[0] - rim, last = bounds[1] + rim;
  at_border[0] = at_border[1] = closed;
  if (!density->periodic[axis]) {
    at_border[0] = first <= 0;
    at_border[1] = last >= most;
    first = first < 0 ? 0 : first;
    last = last > most ? most : last;
  }
  *nodes = last - first + 1;
  *origin = density->origin[axis] + first * density->spacing[axis];
  return first;
}

fg_status fg__cut_keep_largest(float *level, const unsigned char *active,
                               const int nodes[3], fg_context *context)
{
  fg__component_grid grid = {
      .nodes = {nodes[0], nodes[1], nodes[2]}, .u = level, .active = active};
  fg__components pieces = {0};
  fg_status status = fg__components_find(&pieces, context, &grid);
  int largest = 1;
  for (int k = 1; k < pieces.count && !status; ++k)
    if (pieces.area[k] > pieces.area[largest - 1])
      largest = k + 1;
  size_t count = (size_t)nodes[0] * (size_t)nodes[1];
  count *= nodes[2] > 0 ? (size_t)nodes[2] : 1;
  for (size_t k = 0; k < count && !status; ++k)
    if (level[k] > 0.0F && pieces.label[k] != largest)
      level[k] = fg__cut_turned_off(level[k]);
  fg__components_clear(&pieces);
  return status;
}
