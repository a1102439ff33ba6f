#include "write/field_close.h"

#include "base/memory.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t fg__field_samples(const fg_field_arrays *field)
{
  size_t count = 1;
  for (int k = 0; k < field->dimension; ++k)
    count *= (size_t)field->size[k];
  return count;
}

static fg_status close_axis(fg__closed_field *out, fg_context *context,
                            const fg_field_arrays *field, int k)
{
  size_t count = (size_t)out->arrays.size[k], known = (size_t)field->size[k];
  out->axis[k] = fg__allocate(count, sizeof(double));
  if (!out->axis[k])
    return fg__fail_memory(context, "an axis", count * sizeof(double));
  memcpy(out->axis[k], field->axis[k], known * sizeof(double));
  if (count > known)
    out->axis[k][known] = field->axis[k][0] + field->period[k];
  out->arrays.axis[k] = out->axis[k];
  return FG_STATUS_OK;
}

static fg_status close_samples(fg__closed_field *out, fg_context *context,
                               const fg_field_arrays *field)
{
  const size_t count = fg__field_samples(&out->arrays);
  size_t size[3] = {1, 1, 1}, known[3] = {1, 1, 1};
  for (int k = 0; k < field->dimension; ++k) {
    size[k] = (size_t)out->arrays.size[k];
    known[k] = (size_t)field->size[k];
    out->velocity[k] = fg__allocate(count, sizeof(float));
    if (!out->velocity[k])
      return fg__fail_memory(context, "a closed field", count * sizeof(float));
    out->arrays.velocity[k] = out->velocity[k];
  }
  for (size_t n = 0; n < count; ++n) {
    size_t x = n % size[0] % known[0], y = n / size[0] % size[1] % known[1];
    size_t z = n / size[0] / size[1] % known[2];
    size_t from = (z * known[1] + y) * known[0] + x;
    bool missing = fg__field_is_missing(field, from);
    for (int k = 0; k < field->dimension; ++k)
      out->velocity[k][n] = missing ? NAN : field->velocity[k][from];
  }
  out->arrays.valid = NULL;
  return FG_STATUS_OK;
}

fg_status fg__closed_field_create(fg__closed_field *out, fg_context *context,
                                  const fg_field_arrays *field)
{
  *out = (fg__closed_field){.arrays = *field};
  bool closes = false;
  for (int k = 0; k < field->dimension; ++k)
    if (field->period[k] > 0.0 && field->scale != FG_SCALE_GEO) {
      ++out->arrays.size[k];
      out->arrays.period[k] = 0.0;
      closes = true;
    }
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < field->dimension && closes && status == FG_STATUS_OK; ++k)
    status = close_axis(out, context, field, k);
  if (closes && status == FG_STATUS_OK)
    status = close_samples(out, context, field);
  return status;
}

void fg__closed_field_clear(fg__closed_field *closed)
{
  for (int k = 0; k < 3; ++k) {
    free(closed->axis[k]);
    free(closed->velocity[k]);
  }
}
