#include "grid/layout.h"

static ptrdiff_t round_to_lanes(int count)
{
  return (count + FG__LANES - 1) / FG__LANES * FG__LANES;
}

fg__layout fg__layout_of(int dimension, const int nodes[3])
{
  fg__layout out = {.dimension = dimension};
  for (int k = 0; k < 3; ++k)
    out.nodes[k] = k < dimension ? nodes[k] : 1;
  /* room for the ghosts: column -1 is the odd part's [-1], the last place of the even
   * part; the last column follows those of its parity */
  out.odd_offset = round_to_lanes(nodes[0] / 2 + 2);
  out.stride = out.odd_offset + round_to_lanes((nodes[0] + 1) / 2);
  ptrdiff_t rows = nodes[1] + 2, planes = 1;
  if (dimension == 3) {
    out.plane = rows * out.stride;
    planes = nodes[2] + 2;
  }
  out.first = out.plane + out.stride;
  out.array_size = (size_t)(rows * planes * out.stride);
  return out;
}

void fg__row_export(const fg__layout *layout, const float *array, int j, int k,
                    float *plain)
{
  const float *even = array + fg__row_at(layout, j, k);
  const float *odd = even + layout->odd_offset;
  int columns = layout->nodes[0];
  for (int n = 0; n < columns / 2; ++n) {
    plain[2 * n] = even[n];
    plain[2 * n + 1] = odd[n];
  }
  if (columns % 2)
    plain[columns - 1] = even[columns / 2];
}
