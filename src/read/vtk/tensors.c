/* Tensors of VTK files: rows of the matrix as fields. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "read/vtk/vtk.h"

/* Components of nine beside their mirror images may differ by so much of the largest. */
static const double most_asymmetry = 1e-4;

/* The first array of nine components, or of six: xx, yy, zz, xy, yz, xz. */
static const fg__vtk_array *find_array(const fg__vtk *vtk)
{
  for (size_t n = 0; vtk->piece_count && n < vtk->pieces[0].array_count; ++n) {
    const fg__vtk_array *array = &vtk->arrays[vtk->pieces[0].first_array + n];
    if (array->place == FG__VTK_POINTS && array->type != FG__VTK_UNKNOWN &&
        (array->components == 9 || array->components == 6))
      return array;
  }
  return NULL;
}

/* Row and column of the file's component, both below 3. */
static double entry(const fg__vtk_values *values, int components, size_t n, int row,
                    int column)
{
  static const size_t place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  size_t of_nine = 3 * (size_t)row + (size_t)column;
  return fg__vtk_value(values, n * (size_t)components +
                                   (components == 9 ? of_nine : place[row][column]));
}

static fg_status check_symmetry(const fg__vtk *vtk, const fg__vtk_array *array,
                                const fg__vtk_values *values, size_t count)
{
  for (size_t n = 0; n < count && array->components == 9; ++n) {
    double largest = 0.0;
    for (int k = 0; k < 9; ++k)
      largest = fmax(largest, fabs(entry(values, 9, n, k / 3, k % 3)));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j) {
        double one = entry(values, 9, n, i, j), other = entry(values, 9, n, j, i);
        if (!(fabs(one - other) <= most_asymmetry * largest))
          return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                          "%s: array \"%.100s\": tensor %zu of %zu is not symmetric: "
                          "%c%c is %g, %c%c is %g",
                          vtk->path, array->name, n + 1, count, "xyz"[j], "xyz"[i], other,
                          "xyz"[i], "xyz"[j], one);
      }
  }
  return FG_STATUS_OK;
}

static fg_status make_row(fg_field **out, const fg__vtk *vtk, const fg__vtk_grid *grid,
                          const fg__vtk_array *array, const fg__vtk_values *values,
                          const int entries[3][2])
{
  size_t count = fg__vtk_grid_points(grid);
  int dimension = grid->dimension;
  float *velocity = fg__allocate(count, (size_t)dimension * sizeof *velocity);
  double *axis[3] = {NULL, NULL, NULL};
  fg_field_arrays arrays = {.dimension = dimension, .scale = FG_SCALE_PLAIN};
  bool whole = velocity != NULL;
  for (int k = 0; k < dimension; ++k) {
    arrays.size[k] = (int)grid->points[k];
    axis[k] = fg__allocate(grid->points[k], sizeof(double));
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = velocity ? velocity + (size_t)k * count : NULL;
    whole = whole && axis[k];
    for (size_t i = 0; i < grid->points[k] && axis[k]; ++i)
      axis[k][i] = fg__vtk_grid_coordinate(grid, vtk, k, i);
  }
  for (int k = 0; k < dimension && whole; ++k) {
    for (size_t n = 0; n < count; ++n)
      velocity[(size_t)k * count + n] =
          (float)entry(values, array->components, n, grid->axis[entries[k][0]],
                       grid->axis[entries[k][1]]);
    fg__vtk_grid_reverse(velocity + (size_t)k * count, grid);
  }
  fg_status status = whole ? fg_field_create(out, vtk->context, &arrays)
                           : fg__fail_memory(vtk->context, "tensors", count * 12);
  free(velocity);
  for (int k = 0; k < 3; ++k)
    free(axis[k]);
  return status;
}

static fg_status make_rows(fg_field *row[2], const fg__vtk *vtk,
                           const fg__vtk_array *array)
{
  static const int plane[2][3][2] = {{{0, 0}, {0, 1}}, {{0, 1}, {1, 1}}};
  static const int space[2][3][2] = {{{0, 0}, {0, 1}, {0, 2}}, {{1, 1}, {1, 2}, {2, 2}}};
  fg__vtk_grid grid;
  fg__vtk_values values;
  fg_status status = fg__vtk_grid_find(&grid, vtk);
  if (status)
    return status;
  /* two layers of points are a plane for fields, but tensors of two layers may differ */
  if (vtk->piece_count > 1 ||
      (grid.flat >= 0 && vtk->extent[2 * grid.flat] != vtk->extent[2 * grid.flat + 1]))
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: tensors of %zu pieces, or two layers thick, can not be read",
                    vtk->path, vtk->piece_count);
  size_t count = fg__vtk_grid_points(&grid);
  status = fg__vtk_values_create(&values, vtk, array, count);
  if (status)
    return status;
  status = check_symmetry(vtk, array, &values, count);
  for (int k = 0; k < 2 && !status; ++k)
    status = make_row(&row[k], vtk, &grid, array, &values,
                      grid.dimension == 2 ? plane[k] : space[k]);
  fg__vtk_values_clear(&values);
  return status;
}

fg_status fg__tensors_of_vtk(fg_field *row[2], bool *found, fg_context *context,
                             const fg__source *source)
{
  fg__vtk vtk;
  bool legacy = source->bytes[0] == '#';
  fg_status status = legacy ? fg__vtk_open_legacy(&vtk, context, source, NULL)
                            : fg__vtk_open_xml(&vtk, context, source, NULL);
  if (!status)
    status = fg__vtk_read_coordinates(&vtk);
  const fg__vtk_array *array = status ? NULL : find_array(&vtk);
  *found = array != NULL;
  if (array && vtk.cells.count > 0)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: tensors on cells that are not along the axes can not be read",
                      vtk.path);
  else if (array)
    status = make_rows(row, &vtk, array);
  return fg__vtk_close(&vtk, status);
}
