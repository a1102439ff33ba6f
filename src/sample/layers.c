#include "sample/layers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "field/field.h"

/* Of the largest component: vectors that differ by less are the same. */
static const double SAME_VECTOR = 1e-6;

/* Number of a sample of the layer across axis k, and how far the other layer's is. */
static size_t sample_of(size_t *other, const fg_field_arrays *a, int k, size_t n)
{
  size_t inner = 1;
  for (int axis = 0; axis < k; ++axis)
    inner *= (size_t)a->size[axis];
  *other = inner;
  return n / inner * 2 * inner + n % inner;
}

static bool is_valid(const fg_field_arrays *a, size_t n)
{
  return !a->valid || a->valid[n];
}

static size_t layer_size(const fg_field_arrays *a)
{
  return (size_t)a->size[0] * (size_t)a->size[1] * (size_t)a->size[2] / 2;
}

static bool are_alike(const fg_field_arrays *a, int k)
{
  double largest = 0.0;
  for (int c = 0; c < 3; ++c)
    for (size_t n = 0; n < 2 * layer_size(a); ++n)
      if (is_valid(a, n))
        largest = fmax(largest, fabs((double)a->velocity[c][n]));
  for (size_t n = 0; n < layer_size(a); ++n) {
    size_t apart;
    const size_t one = sample_of(&apart, a, k, n), other = one + apart;
    if (is_valid(a, one) != is_valid(a, other))
      return false;
    for (int c = 0; c < 3 && is_valid(a, one); ++c)
      if (!(fabs((double)a->velocity[c][one] - (double)a->velocity[c][other]) <=
            SAME_VECTOR * largest))
        return false;
  }
  return true;
}

/* The layer as a field; its words say where both were. */
static fg_status take_layer(fg_field **out, fg_context *context, const fg_field_arrays *a,
                            int k)
{
  fg_field_arrays plane = *a;
  char level[160];
  float *velocity[2] = {NULL, NULL};
  fg_status status = FG_STATUS_OK;
  const char *units = a->axis_units[k] ? a->axis_units[k] : "";
  snprintf(level, sizeof level, "%.60s = %g and %g%s%.40s",
           a->axis_name[k] ? a->axis_name[k] : "z", a->axis[k][0], a->axis[k][1],
           units[0] ? " " : "", units);
  plane.dimension = 2;
  plane.valid = NULL;
  plane.level = a->level ? a->level : level;
  for (int to = 0, axis = 0; axis < 3 && status == FG_STATUS_OK; ++axis) {
    if (axis == k)
      continue;
    plane.size[to] = a->size[axis];
    plane.axis[to] = a->axis[axis];
    plane.period[to] = a->period[axis];
    plane.axis_name[to] = a->axis_name[axis];
    plane.axis_units[to] = a->axis_units[axis];
    plane.velocity_name[to] = a->velocity_name[axis];
    velocity[to] = fg__allocate(layer_size(a), sizeof **velocity);
    if (!velocity[to])
      status = fg__fail_memory(context, "a layer", layer_size(a) * sizeof **velocity);
    for (size_t n = 0; n < layer_size(a) && status == FG_STATUS_OK; ++n) {
      size_t apart;
      const size_t from = sample_of(&apart, a, k, n);
      velocity[to][n] = is_valid(a, from) ? a->velocity[axis][from] : NAN;
    }
    plane.velocity[to] = velocity[to];
    ++to;
  }
  if (k < 2) {
    plane.scale = FG_SCALE_PLAIN;
    plane.projection = NULL;
  }
  if (status == FG_STATUS_OK)
    status = fg_field_create(out, context, &plane);
  free(velocity[0]);
  free(velocity[1]);
  return status;
}

fg_status fg__drop_layer(fg_field **field, fg_context *context)
{
  const fg_field_arrays *a = fg_field_contents(*field);
  for (int k = 0; k < 3 && a->dimension == 3; ++k) {
    fg_field *plane = NULL;
    if (a->size[k] != 2 || a->period[k] > 0.0 || !are_alike(a, k))
      continue;
    const fg_status status = take_layer(&plane, context, a, k);
    fg_field_destroy(*field);
    *field = plane;
    return status;
  }
  return FG_STATUS_OK;
}

void fg__describe_field(fg_inventory_vector *vector, char name[3][FG__TEXT_BYTES],
                        const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  vector->dimension = vector->components = a->dimension;
  for (int k = 0; k < a->dimension; ++k) {
    vector->size[k] = a->size[k];
    vector->bounds[2 * k] = a->axis[k][0];
    vector->bounds[2 * k + 1] = a->axis[k][a->size[k] - 1];
    vector->periodic[k] = a->period[k] > 0.0;
    snprintf(name[k], FG__TEXT_BYTES, "%s", a->axis_name[k]);
    vector->axis_name[k] = name[k];
  }
  vector->scale = a->scale;
}
