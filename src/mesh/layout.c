#include "mesh/layout.h"

static ptrdiff_t round_to_lanes(int count)
{
  return (count + FG__LANES - 1) / FG__LANES * FG__LANES;
}

fg__layout fg__layout_of(int dimension, const int nodes[3])
{
  fg__layout out = {.dimension = dimension};
  for (int k = 0; k < 3; ++k)
    out.nodes[k] = k < dimension ? nodes[k] : 1;
  /* each part has a pad of one vector before it and at least one ghost after it */
  ptrdiff_t even_part = round_to_lanes((nodes[0] + 1) / 2 + 1);
  ptrdiff_t odd_part = round_to_lanes(nodes[0] / 2 + 1);
  out.odd_offset = even_part + FG__LANES;
  out.stride = even_part + odd_part + 2 * FG__LANES;
  ptrdiff_t rows = nodes[1] + 2, planes = 1;
  if (dimension == 3) {
    out.plane = rows * out.stride;
    planes = nodes[2] + 2;
  }
  out.array_size = (size_t)(rows * planes * out.stride + FG__LANES);
  out.first = out.plane + out.stride + FG__LANES;
  return out;
}
