#include "tensor/tensor.h"

/* in the order of fg_energy */
static fg__energy_law *const laws[] = {fg__energy_flow, fg__energy_isotropic};

fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          fg_energy energy, double anisotropy, const fg__cells *cells)
{
  if ((size_t)energy >= sizeof laws / sizeof laws[0])
    return fg__fail(context, FG_STATUS_ARGUMENT, "there is no energy number %d",
                    (int)energy);
  if (!(anisotropy > 0.0 && anisotropy <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT, "anisotropy %g is not in (0, 1]",
                    anisotropy);
  long active = 0;
  for (int j = 0; j < cells->count[1]; ++j)
    for (int i = 0; i < cells->count[0]; ++i) {
      double center[2] = {cells->origin[0] + (i + 0.5) * cells->spacing[0],
                          cells->origin[1] + (j + 0.5) * cells->spacing[1]};
      double tangent[3] = {0.0, 0.0, 0.0}, a[3] = {0.0, 0.0, 0.0};
      size_t cell = (size_t)j * (size_t)cells->count[0] + (size_t)i;
      tensor->active[cell] = fg_field_tangent(field, center, tangent);
      if (tensor->active[cell])
        laws[energy](a, tangent, anisotropy);
      active += tensor->active[cell];
      tensor->xx[cell] = (float)a[0];
      tensor->xy[cell] = (float)a[1];
      tensor->yy[cell] = (float)a[2];
    }
  if (active == 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "no cell of the mesh, %d x %d, has its centre in the field's domain",
                    cells->count[0], cells->count[1]);
  return FG_STATUS_OK;
}
