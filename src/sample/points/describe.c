/* The field of points in an inventory. */
#include "interpret/inventory.h"
#include "sample/points/points.h"

fg_status fg__scatter_describe(fg_inventory *inventory, fg_context *context,
                               const fg_field *field, fg_inventory_vector vector)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t samples = 1, missing = 0;
  for (int k = 0; k < a->dimension && k < 3; ++k) {
    samples *= (size_t)a->size[k];
    vector.size[k] = a->size[k];
    vector.bounds[2 * k] = a->axis[k][0];
    vector.bounds[2 * k + 1] = a->axis[k][a->size[k] - 1];
    vector.periodic[k] = a->period[k] > 0.0;
  }
  for (size_t n = 0; n < samples && a->valid; ++n)
    missing += !a->valid[n];
  vector.dimension = vector.components = a->dimension;
  vector.times = vector.times > 0 ? vector.times : 1;
  vector.levels = vector.levels > 0 ? vector.levels : 1;
  vector.missing_share = (double)missing / (double)samples;
  vector.scale = a->scale;
  return fg__inventory_add(inventory, context, &vector);
}
