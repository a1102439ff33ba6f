#include "read/tensor_rows.h"

/* Components in variables of their own: xx, xy, yy, and in 3D xz, yz, zz. */
static fg_status read_components(fg_field *row[2], fg_context *context, const char *path,
                                 int dimension)
{
  static const char *const names[2][2] = {{"xx,xy", "xy,yy"}, {"xx,xy,xz", "yy,yz,zz"}};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && !status; ++k) {
    fg_read_options options = {.vars = names[dimension - 2][k], .scale = FG_SCALE_PLAIN};
    status = fg_field_read(&row[k], context, path, &options);
  }
  if (status)
    fg__hint(context, "An energy is read from a VTK array of tensors, or from variables "
                      "xx, xy, yy, in 3D xx, xy, yy, zz, xz, yz.");
  return status;
}

fg_status fg__tensor_rows_read(fg_field *row[2], fg_context *context, const char *path,
                               int dimension)
{
  fg__source source;
  const fg__format *format;
  bool found = false;
  row[0] = row[1] = NULL;
  fg_status status = fg__source_open_known(&source, &format, context, path);
  if (!status && format->has_tensors)
    status = fg__dataset_tensors(row, &found, context, format, &source);
  status = fg__source_close(&source, context, status);
  if (!status && !found)
    status = read_components(row, context, path, dimension);
  for (int k = 0; k < 2 && status; ++k) {
    fg_field_destroy(row[k]);
    row[k] = NULL;
  }
  return status;
}
