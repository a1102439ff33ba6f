#include "solver/cells/images.h"

fg__cell_layout fg__cell_layout_of(int dimension, const int nodes[3])
{
  fg__cell_layout out = {.dimension = dimension, .nodes = {1, 1, 1}};
  for (int k = 0; k < 3 && k < dimension; ++k)
    out.nodes[k] = nodes[k];
  out.row = out.nodes[0] + 1;
  out.plane = out.row * (out.nodes[1] + 1);
  out.origin = 1 + out.row + (dimension == 3 ? out.plane : 0);
  out.size = (size_t)out.plane * (dimension == 3 ? (size_t)out.nodes[2] + 1 : 1);
  return out;
}

/* Images along one axis, of the cells from low to high along the others. */
static void copy_along(const fg__cell_layout *layout, const int low[3], const int high[3],
                       int axis, const int to[2], const int from[2], bool mirrored,
                       fg__copy_cell *copy, const void *cells)
{
  int begin[3] = {low[0], low[1], low[2]}, end[3] = {high[0], high[1], high[2]};
  ptrdiff_t step = axis == 0 ? 1 : axis == 1 ? layout->row : layout->plane;
  begin[axis] = end[axis] = 0;
  for (int k = begin[2]; k <= end[2]; ++k)
    for (int j = begin[1]; j <= end[1]; ++j)
      for (int i = begin[0]; i <= end[0]; ++i) {
        ptrdiff_t n = (ptrdiff_t)i + j * layout->row + k * layout->plane;
        for (int side = 0; side < 2; ++side)
          if (to[side] != from[side])
            copy(cells, n + to[side] * step, n + from[side] * step, axis, mirrored);
      }
}

/* Axis after axis: each copies the images along those before, too. */
void fg__cell_images_fill(const fg__cell_layout *layout, const fg__box *box,
                          const int level_cells[3], const bool periodic[3],
                          fg__copy_cell *copy, const void *cells)
{
  int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  if (fg__box_is_empty(box))
    return;
  bool spans[3] = {false, false, false};
  for (int k = 0; k < 3 && k < layout->dimension; ++k) {
    int first = box->first[k], end = first + box->nodes[k];
    spans[k] = periodic[k] && box->nodes[k] == level_cells[k];
    low[k] = spans[k] || (!periodic[k] && first == 0) ? 0 : -1;
    high[k] = (!periodic[k] && end > level_cells[k] ? level_cells[k] : end) - first - 1;
  }
  for (int k = 0; k < 3 && k < layout->dimension; ++k) {
    bool below = low[k] == 0, above = high[k] < layout->nodes[k] - 1;
    const int to[2] = {below ? -1 : 0, high[k] + above};
    const int from[2] = {spans[k] ? high[k] : 0, high[k]};
    copy_along(layout, low, high, k, to, from, !spans[k], copy, cells);
    low[k] = -1;
    high[k] = layout->nodes[k] - 1;
  }
}
