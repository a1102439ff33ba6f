/* The plane or volume that a grid is. */
#include "read/vtk/vtk.h"

/* The axis that an image is flat along: one point thick, else two; -1 for a volume, or
 * -2 for a line. */
static int flat_axis(const fg__vtk *vtk)
{
  int single = 0, flat = -1, thin = -1;
  for (int k = 0; k < 3; ++k) {
    size_t points = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
    if (points == 1) {
      ++single;
      flat = k;
    } else if (points == 2) {
      thin = k;
    }
  }
  if (single > 1)
    return -2;
  return flat < 0 ? thin : flat;
}

bool fg__vtk_is_volume(const fg__vtk *vtk)
{
  return flat_axis(vtk) == -1;
}

size_t fg__vtk_grid_points(const fg__vtk_grid *grid)
{
  return grid->points[0] * grid->points[1] * grid->points[2];
}

static int last_axis(const fg__vtk_grid *grid)
{
  return grid->dimension - 1;
}

size_t fg__vtk_grid_wanted(const fg__vtk_grid *grid)
{
  return fg__vtk_grid_points(grid) / grid->points[last_axis(grid)] * grid->rows;
}

double fg__vtk_grid_coordinate(const fg__vtk_grid *grid, const fg__vtk *vtk, int k,
                               size_t i)
{
  return fg__vtk_coordinate(vtk, grid->axis[k],
                            grid->descends[k] ? grid->points[k] - 1 - i : i);
}

static void exchange(float *a, float *b, size_t count)
{
  for (size_t i = 0; i < count; ++i) {
    const float kept = a[i];
    a[i] = b[i];
    b[i] = kept;
  }
}

void fg__vtk_grid_reverse(float *samples, const fg__vtk_grid *grid)
{
  const float *end = samples + fg__vtk_grid_wanted(grid);
  size_t step = 1;
  for (int k = 0; k < grid->dimension; ++k) {
    const size_t length = k == last_axis(grid) ? grid->rows : grid->points[k];
    for (float *at = samples; grid->descends[k] && at < end; at += length * step)
      for (size_t i = 0; i < length / 2; ++i)
        exchange(at + i * step, at + (length - 1 - i) * step, step);
    step *= length;
  }
}

fg_status fg__vtk_grid_find(fg__vtk_grid *out, const fg__vtk *vtk)
{
  size_t points[3];
  for (int k = 0; k < 3; ++k)
    points[k] = fg__vtk_length(vtk->extent, k, FG__VTK_POINTS);
  *out = (fg__vtk_grid){.flat = flat_axis(vtk), .points = {1, 1, 1}};
  if (out->flat == -2)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: a line of %zu x %zu x %zu points; a field needs two directions",
                    vtk->path, points[0], points[1], points[2]);
  for (int k = 0; k < 3; ++k)
    if (k != out->flat) {
      out->axis[out->dimension] = k;
      out->descends[out->dimension] =
          vtk->uneven && vtk->coordinate[k][points[k] - 1] < vtk->coordinate[k][0];
      out->points[out->dimension++] = points[k];
    }
  out->rows = out->points[last_axis(out)];
  return FG_STATUS_OK;
}
