/* Positions of the points, nodes or faces of a mesh. */
#include "base/angle.h"
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"

double fg__degrees_in(const fg__unstructured *mesh, const fg__variable *v)
{
  const fg__attribute *units = fg__attribute_find(v, "units");
  return mesh->in_radians && !(units && units->text && units->text[0])
             ? 1.0 / FG__RADIANS
             : fg__degrees_per_unit(v);
}

fg_status fg__positions_of(double *out[], const fg__dataset *data,
                           const fg__unstructured *mesh, const fg__variable *const at[],
                           size_t count, int coordinates)
{
  for (int k = 0; k < coordinates; ++k) {
    size_t numbers = 1;
    for (int d = 0; d < at[k]->rank; ++d)
      numbers *= data->dimensions[at[k]->dimension[d]].length;
    if (numbers != count)
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: '%s' has %zu numbers instead of %zu", at[k]->path, at[k]->name,
                      numbers, count);
    out[k] = fg__allocate(count, sizeof *out[k]);
    if (!out[k])
      return fg__fail_memory(data->context, "positions", count * sizeof *out[k]);
    const fg_status status = fg__read_all(out[k], data, at[k]);
    if (status != FG_STATUS_OK)
      return status;
    const double factor = fg__degrees_in(mesh, at[k]) / fg__degrees_per_unit(at[k]);
    for (size_t n = 0; n < count && factor > 1.0 && !mesh->in_plane; ++n)
      out[k][n] *= factor;
  }
  return mesh->in_plane
             ? FG_STATUS_OK
             : fg__check_degrees(data->context, at[0]->path, out[0], out[1], count);
}
