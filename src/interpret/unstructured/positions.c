/* Positions of the points, nodes or faces of a mesh. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"

#include <string.h>

static const double DEGREES_PER_RADIAN = 57.29577951308232;

double fg__degrees_in(const fg__unstructured *mesh, const fg__variable *v)
{
  char units[FG__TEXT_BYTES];
  if (!fg__attribute_text(v, "units", units, sizeof units) || !units[0])
    return mesh->in_radians ? DEGREES_PER_RADIAN : 1.0;
  return strncmp(units, "rad", 3) == 0 ? DEGREES_PER_RADIAN : 1.0;
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
    const double factor = mesh->in_plane ? 1.0 : fg__degrees_in(mesh, at[k]);
    for (size_t n = 0; n < count && factor > 1.0; ++n)
      out[k][n] *= factor;
  }
  return FG_STATUS_OK;
}
