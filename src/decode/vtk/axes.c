/* Where the points of a grid are along axes of uneven steps. */
#include "base/memory.h"
#include "decode/vtk/vtk.h"

#include <math.h>

/* Every piece's coordinates must be there, and no byte may serve two: then the whole axis
 * is no longer than the file can fill. */
static fg_status check_coordinates(const fg__vtk *vtk, int axis)
{
  size_t whole = fg__vtk_length(vtk->extent, axis, FG__VTK_POINTS), sum = 0, bytes = 0;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_piece *piece = &vtk->pieces[p];
    const fg__vtk *file = fg__vtk_home(vtk, p);
    const fg__vtk_array *array = &file->arrays[piece->coordinates + (size_t)axis];
    size_t length = fg__vtk_length(piece->extent, axis, FG__VTK_POINTS), stored = 0;
    fg_status status = fg__vtk_values_check(file, array, length, &stored);
    if (status != FG_STATUS_OK)
      return status;
    if (array->components != 1 || stored > vtk->file_size - bytes)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: the coordinates along %c of piece %zu are %s", vtk->path,
                      "xyz"[axis], p + 1,
                      array->components != 1 ? "vectors" : "those of another piece");
    bytes += stored;
    sum += length;
  }
  if (sum < whole)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: %zu coordinates along %c for %zu points", vtk->path, sum,
                    "xyz"[axis], whole);
  return FG_STATUS_OK;
}

static fg_status read_axis(fg__vtk *vtk, int axis)
{
  size_t whole = fg__vtk_length(vtk->extent, axis, FG__VTK_POINTS);
  double *out = vtk->coordinate[axis] = fg__allocate(whole, sizeof *out);
  if (!out)
    return fg__fail_memory(vtk->context, "an axis", whole * sizeof *out);
  for (size_t i = 0; i < whole; ++i)
    out[i] = (double)NAN;
  for (size_t p = 0; p < vtk->piece_count; ++p) {
    const fg__vtk_piece *piece = &vtk->pieces[p];
    size_t length = fg__vtk_length(piece->extent, axis, FG__VTK_POINTS);
    const fg__vtk *file = fg__vtk_home(vtk, p);
    double *first = out + ((int64_t)piece->extent[2 * axis] - vtk->extent[2 * axis]);
    const fg_status status = fg__vtk_read_numbers(
        first, file, &file->arrays[piece->coordinates + (size_t)axis], length);
    if (status != FG_STATUS_OK)
      return status;
  }
  for (size_t i = 0; i < whole; ++i)
    if (!isfinite(out[i]))
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: coordinate %zu of %zu along %c is missing or no number",
                      vtk->path, i, whole, "xyz"[axis]);
  return FG_STATUS_OK;
}

fg_status fg__vtk_read_coordinates(fg__vtk *vtk)
{
  for (int k = 0; k < 3 && vtk->uneven; ++k) {
    fg_status status = check_coordinates(vtk, k);
    if (status == FG_STATUS_OK)
      status = read_axis(vtk, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}
