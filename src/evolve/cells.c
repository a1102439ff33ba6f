#include "evolve/cells.h"

#include <stdlib.h>

#include "base/memory.h"

/* The axes whose mirror image changes a component's sign. */
static const unsigned char odd_axes[FG__TENSOR_COMPONENTS][2] = {{0, 0}, {0, 1}, {1, 1},
                                                                 {2, 2}, {0, 2}, {1, 2}};

static int component_count(int dimension)
{
  return dimension == 3 ? FG__TENSOR_COMPONENTS : 3;
}

static fg_status allocate(fg__cells_of_box *out, fg_context *context, int dimension,
                          const int cells[3], const bool periodic[3])
{
  *out = (fg__cells_of_box){.dimension = dimension, .nodes = {1, 1, 1}};
  for (int k = 0; k < dimension; ++k)
    out->nodes[k] = periodic[k] ? cells[k] : cells[k] + 1;
  out->row = out->nodes[0] + 1;
  out->plane = out->row * (out->nodes[1] + 1);
  size_t planes = dimension == 3 ? (size_t)out->nodes[2] + 1 : 1;
  size_t size = (size_t)out->plane * planes;
  size_t arrays = (size_t)component_count(dimension) + 1;
  float *memory = fg__allocate(size * arrays, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "the tensor", size * arrays * sizeof *memory);
  out->memory = memory;
  float *origin = memory + out->row + 1 + (dimension == 3 ? out->plane : 0);
  for (size_t n = 0; n + 1 < arrays; ++n)
    out->component[n] = origin + n * size;
  out->weight = origin + (arrays - 1) * size;
  return FG_STATUS_OK;
}

/* A row of cells beyond a side (or a cell, a plane) from its image; `step` to the next of
 * `count` cells, flipped along `axis`. */
static void copy_image(const fg__cells_of_box *cells, ptrdiff_t to, ptrdiff_t from,
                       int axis, bool mirrored)
{
  for (int c = 0; c < component_count(cells->dimension); ++c) {
    bool odd = mirrored && odd_axes[c][0] != odd_axes[c][1] &&
               (odd_axes[c][0] == axis || odd_axes[c][1] == axis);
    float value = cells->component[c][from];
    cells->component[c][to] = odd ? -value : value;
  }
  cells->weight[to] = cells->weight[from];
}

/* Images along one axis, for all cells along the axes done before (their images included)
 * and the true ones of those to come. */
static void fill_images(const fg__cells_of_box *cells, const int count[3], int axis,
                        bool periodic)
{
  int low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    bool done = k < axis && k < cells->dimension;
    low[k] = done ? -1 : 0;
    high[k] = done ? cells->nodes[k] - 1 : count[k] - 1;
  }
  low[axis] = high[axis] = 0;
  ptrdiff_t step = axis == 0 ? 1 : axis == 1 ? cells->row : cells->plane;
  ptrdiff_t last = count[axis] - 1;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) {
        ptrdiff_t n = fg__cell_at(cells, i, j, k);
        copy_image(cells, n - step, n + (periodic ? last * step : 0), axis, !periodic);
        if (!periodic)
          copy_image(cells, n + (last + 1) * step, n + last * step, axis, true);
      }
}

static void fill_all_images(const fg__cells_of_box *cells, const int count[3],
                            const bool periodic[3])
{
  for (int axis = 0; axis < cells->dimension; ++axis)
    fill_images(cells, count, axis, periodic[axis]);
}

fg_status fg__cells_from_tensor(fg__cells_of_box *out, fg_context *context,
                                const fg__tensor *tensor, int dimension,
                                const int cells[3], const bool periodic[3])
{
  fg_status status = allocate(out, context, dimension, cells, periodic);
  if (status)
    return status;
  const float *source[FG__TENSOR_COMPONENTS] = {tensor->xx, tensor->xy, tensor->yy,
                                                tensor->zz, tensor->xz, tensor->yz};
  int count[3] = {cells[0], cells[1], dimension == 3 ? cells[2] : 1};
  size_t n = 0;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i, ++n) {
        ptrdiff_t at = fg__cell_at(out, i, j, k);
        bool active = tensor->active[n];
        for (int c = 0; c < component_count(dimension); ++c)
          out->component[c][at] = active ? source[c][n] : 0.0F;
        out->weight[at] = active ? 1.0F : 0.0F;
      }
  fill_all_images(out, count, periodic);
  return FG_STATUS_OK;
}

static float mean_of_cells(const fg__cells_of_box *fine, const float *values, int i,
                           int j, int k)
{
  const float *low = values + fg__cell_at(fine, 2 * i, 2 * j, 2 * k);
  const float *high = low + fine->row;
  float plane = low[0] + low[1] + high[0] + high[1];
  if (fine->dimension == 2)
    return 0.25F * plane;
  low += fine->plane;
  high += fine->plane;
  return 0.125F * (plane + (low[0] + low[1] + high[0] + high[1]));
}

fg_status fg__cells_coarsen(fg__cells_of_box *out, fg_context *context,
                            const fg__cells_of_box *fine, const int fine_cells[3],
                            const bool periodic[3])
{
  int dimension = fine->dimension;
  int count[3] = {fine_cells[0] / 2, fine_cells[1] / 2,
                  dimension == 3 ? fine_cells[2] / 2 : 1};
  fg_status status = allocate(out, context, dimension, count, periodic);
  if (status)
    return status;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        ptrdiff_t at = fg__cell_at(out, i, j, k);
        for (int c = 0; c < component_count(dimension); ++c)
          out->component[c][at] = mean_of_cells(fine, fine->component[c], i, j, k);
        out->weight[at] = mean_of_cells(fine, fine->weight, i, j, k);
      }
  fill_all_images(out, count, periodic);
  return FG_STATUS_OK;
}

void fg__cells_clear(fg__cells_of_box *cells)
{
  free(cells->memory);
  *cells = (fg__cells_of_box){0};
}
