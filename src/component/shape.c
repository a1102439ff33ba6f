#include "component/shape.h"

#include <math.h>
#include <string.h>

static void set_sides(fg__shape *shape, int axis, const fg__component_box *box, int of)
{
  int nodes = box->nodes[of], first = box->first[of];
  bool spans = nodes == box->grid_nodes[of];
  shape->nodes[axis] = nodes;
  shape->low[axis] = first > 0 ? FG__SIDE_RING : FG__SIDE_BOUNDARY;
  shape->high[axis] =
      first + nodes < box->grid_nodes[of] ? FG__SIDE_RING : FG__SIDE_BOUNDARY;
  if (box->periodic[of])
    shape->low[axis] = shape->high[axis] = spans ? FG__SIDE_WRAP : FG__SIDE_RING;
}

fg__shape fg__shape_of(const fg__component_box *box)
{
  bool flat = box->grid_nodes[2] <= 1;
  int64_t width = box->grid_nodes[0], height = box->grid_nodes[1];
  fg__shape out = {.u = box->u, .active = box->active};
  set_sides(&out, 0, box, 0);
  out.stride[0] = out.cell_stride[0] = out.step[0] = 1;
  out.first = box->first[0] + width * box->first[1];
  if (flat) {
    out.nodes[1] = 1;
    out.high[1] = FG__SIDE_FLAT;
    set_sides(&out, 2, box, 1);
    out.stride[2] = box->row;
    out.cell_stride[2] = box->cell_row;
    out.step[2] = width;
    return out;
  }
  set_sides(&out, 1, box, 1);
  set_sides(&out, 2, box, 2);
  out.stride[1] = box->row;
  out.stride[2] = box->plane;
  out.cell_stride[1] = box->cell_row;
  out.cell_stride[2] = box->cell_plane;
  out.step[1] = width;
  out.step[2] = width * height;
  out.first += width * height * box->first[2];
  return out;
}

fg__gate fg__gate_of(const fg__shape *shape, int j, int j_last, int k, int k_last)
{
  fg__gate out;
  out.masked = shape->active != NULL;
  out.count = 0;
  for (int n = k; n <= k_last && out.masked; ++n)
    for (int m = j; m <= j_last; ++m) {
      int middle = fg__shape_cell(shape, 1, m), outer = fg__shape_cell(shape, 2, n);
      if (middle != FG__NOWHERE && outer != FG__NOWHERE)
        out.row[out.count++] = shape->active + middle * shape->cell_stride[1] +
                               outer * shape->cell_stride[2];
    }
  return out;
}

bool fg__gate_open(const fg__gate *gate, const fg__shape *shape, int x, int x_last)
{
  if (!gate->masked)
    return true;
  for (int n = x; n <= x_last; ++n) {
    int cell = fg__shape_cell(shape, 0, n);
    for (int m = 0; m < gate->count && cell != FG__NOWHERE; ++m)
      if (gate->row[m][cell])
        return true;
  }
  return false;
}

bool fg__components_saddle_joins(float a, float b, float c, float d)
{
  /* the value at the saddle point is (ad - bc)/(a + d - b - c), its denominator positive
   */
  return (double)a * (double)d > (double)b * (double)c;
}

/* |u| of a row of nodes and the one beyond it along the outer axis, added: a stretch of
 * sums, and a node more on each side that has one. */
static void add_rows(const fg__shape *shape, int j, int k, fg__component_stretch at,
                     float *sum)
{
  const float *low = fg__shape_row(shape, j, fg__shape_node(shape, 2, k));
  const float *high = fg__shape_row(shape, j, fg__shape_node(shape, 2, k + 1));
  for (int x = at.first; x <= at.last; ++x)
    sum[x] = fabsf(low[x]) + fabsf(high[x]);
  int before = fg__shape_node(shape, 0, at.first - 1);
  int after = fg__shape_node(shape, 0, at.last + 1);
  sum[at.first - 1] =
      before == FG__NOWHERE ? 0.0F : fabsf(low[before]) + fabsf(high[before]);
  sum[at.last + 1] = after == FG__NOWHERE ? 0.0F : fabsf(low[after]) + fabsf(high[after]);
}

/* 1 / sum; 0 when all corners are 0, or one is not a number. */
static inline float reciprocal(float sum)
{
  return 1.0F / (sum > 0.0F ? sum : INFINITY);
}

/* One over the sum of |u| at the corners of each cell of a row, 0 where there is none, on
 * both sides of a stretch of nodes: inverse[first - 1 ... last]. In 2D `high` is not
 * looked at. */
static void invert(const fg__shape *shape, int j, int k, fg__component_stretch at,
                   const float *low, const float *high, float *inverse)
{
  if (shape->high[1] == FG__SIDE_FLAT)
    for (int x = at.first - 1; x <= at.last; ++x)
      inverse[x] = reciprocal(low[x] + low[x + 1]);
  else
    for (int x = at.first - 1; x <= at.last; ++x)
      inverse[x] = reciprocal((low[x] + low[x + 1]) + (high[x] + high[x + 1]));
  if (fg__shape_cell(shape, 0, at.first - 1) == FG__NOWHERE)
    inverse[at.first - 1] = 0.0F;
  if (fg__shape_cell(shape, 0, at.last) == FG__NOWHERE)
    inverse[at.last] = 0.0F;
  if (!shape->active)
    return;
  fg__gate gate = fg__gate_of(shape, j, j, k, k);
  for (int x = at.first - 1; x <= at.last; ++x)
    if (!fg__gate_open(&gate, shape, x, x))
      inverse[x] = 0.0F;
}

void fg__share_plane(const fg__shape *shape, int k, fg__component_stretch nodes,
                     float *space, float *shares)
{
  int width = shape->nodes[0], height = shape->nodes[1];
  ptrdiff_t pitch = width + 2;
  float *sum[2] = {space + 1, space + pitch + 1}, *inverse = space + 2 * pitch + 1;
  for (int row = 0; row < height; ++row)
    memset(shares + (ptrdiff_t)row * width + nodes.first, 0,
           (size_t)(nodes.last - nodes.first + 1) * sizeof *shares);
  if (fg__shape_cell(shape, 2, k) == FG__NOWHERE)
    return;
  bool flat = shape->high[1] == FG__SIDE_FLAT;
  int j = fg__shape_cell(shape, 1, -1) == FG__NOWHERE ? 0 : -1;
  add_rows(shape, fg__shape_node(shape, 1, j), k, nodes, sum[0]);
  for (; j < height && fg__shape_cell(shape, 1, j) != FG__NOWHERE; ++j) {
    if (!flat)
      add_rows(shape, fg__shape_node(shape, 1, j + 1), k, nodes, sum[1]);
    invert(shape, j, k, nodes, sum[0], sum[1], inverse);
    for (int row = j; row <= j + 1; ++row) {
      if (row < 0 || row >= height)
        continue;
      float *out = shares + (ptrdiff_t)row * width;
      for (int x = nodes.first; x <= nodes.last; ++x)
        out[x] += inverse[x - 1] + inverse[x];
    }
    float *swap = sum[0];
    sum[0] = sum[1];
    sum[1] = swap;
  }
}
