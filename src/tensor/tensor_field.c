#include "tensor/tensor_field.h"
#include "tensor/length.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/mix.h"
#include "field/fingerprint.h"
#include "tensor/eigenvalues.h"

/* At 1000 an interface across the cheap direction is 35 cells wide (gamma is
 * (1.1 h)^2 / a), as wide as whole clusters. */
static const double most_ratio = 1000.0;

/* Sample n as xx, xy, yy, zz, xz, yz; false where it is missing. */
static bool sample_at(double a[6], const fg_tensors *t, size_t n)
{
  const fg_field_arrays *first = fg_field_contents(t->row[0]);
  const fg_field_arrays *second = fg_field_contents(t->row[1]);
  if ((first->valid && !first->valid[n]) || (second->valid && !second->valid[n]))
    return false;
  a[0] = (double)first->velocity[0][n];
  a[1] = (double)first->velocity[1][n];
  a[2] = (double)second->velocity[first->dimension == 2 ? 1 : 0][n];
  a[3] = a[4] = a[5] = 0.0;
  if (first->dimension == 3) {
    a[4] = (double)first->velocity[2][n];
    a[5] = (double)second->velocity[1][n];
    a[3] = (double)second->velocity[2][n];
  }
  return isfinite(a[0] + a[1] + a[2] + a[3] + a[4] + a[5]);
}

static void ends_of(const double a[6], int dimension, double *least, double *greatest)
{
  if (dimension == 2) {
    double half = fg__length(0.5 * (a[0] - a[2]), a[1], 0.0), mean = 0.5 * (a[0] + a[2]);
    *least = mean - half;
    *greatest = mean + half;
    return;
  }
  double e[3];
  fg__eigenvalues(e, a);
  *least = e[2];
  *greatest = e[0];
}

/* Checks that every sample is positive definite, and finds the range of them all. */
static fg_status check_samples(fg_tensors *t, fg_context *context, const char *path)
{
  const fg_field_arrays *f = fg_field_contents(t->row[0]);
  size_t count = (size_t)f->size[0] * (size_t)f->size[1] *
                 (size_t)(f->dimension == 3 ? f->size[2] : 1);
  double lowest = (double)INFINITY;
  for (size_t n = 0; n < count; ++n) {
    double a[6], least, greatest;
    if (!sample_at(a, t, n))
      continue;
    ends_of(a, f->dimension, &least, &greatest);
    if (!(least > 0.0))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "%s: the tensor of sample %zu of %zu is not positive definite: its "
                      "eigenvalues go from %g to %g",
                      path, n + 1, count, least, greatest);
    lowest = fmin(lowest, least);
    t->greatest = fmax(t->greatest, greatest);
  }
  double ratio = t->greatest / lowest;
  if (!(ratio <= most_ratio)) {
    fg__fail(context, FG_STATUS_ARGUMENT,
             "%s: the tensors' eigenvalues go from %g to %g; at most a factor of %g is "
             "possible",
             path, lowest, t->greatest, most_ratio);
    return FG_STATUS_ARGUMENT;
  }
  t->law.anisotropy = lowest / t->greatest;
  return FG_STATUS_OK;
}

/* The tensor at a place, between samples, over the greatest eigenvalue of all: gamma sets
 * the size. Cells beyond the ends by rounding take what is there. */
static void tensor_at(double tensor[6], const fg_energy_place *place, const void *data)
{
  const fg_tensors *t = data;
  const fg_field_arrays *f = fg_field_contents(t->row[0]);
  double at[3] = {0.0, 0.0, 0.0}, v[2][3] = {{0.0}};
  for (int k = 0; k < f->dimension; ++k) {
    at[k] = place->position[k];
    if (!(f->period[k] > 0.0))
      at[k] = fmin(fmax(at[k], f->axis[k][0]), f->axis[k][f->size[k] - 1]);
  }
  bool here =
      fg_field_velocity(t->row[0], at, v[0]) && fg_field_velocity(t->row[1], at, v[1]);
  double scale = here ? 1.0 / t->greatest : (double)NAN;
  tensor[0] = scale * v[0][0];
  tensor[1] = scale * v[0][1];
  tensor[2] = scale * v[1][f->dimension == 2 ? 1 : 0];
  if (f->dimension == 3) {
    tensor[4] = scale * v[0][2];
    tensor[5] = scale * v[1][1];
    tensor[3] = scale * v[1][2];
  }
}

/* Whether the tensors' grid holds the field's box, but for rounding. */
static fg_status check_place(const fg_tensors *t, fg_context *context, const char *path,
                             const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(t->row[0]), *f = fg_field_contents(field);
  if (a->dimension != f->dimension)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: tensors in %d dimensions for a field in %d", path, a->dimension,
                    f->dimension);
  for (int k = 0; k < f->dimension; ++k) {
    double low = f->axis[k][0], high = f->axis[k][f->size[k] - 1];
    double end = a->axis[k][a->size[k] - 1], slack = 1e-6 * (high - low);
    if (!(a->period[k] > 0.0) && (a->axis[k][0] > low + slack || end < high - slack))
      return fg__fail(
          context, FG_STATUS_ARGUMENT,
          "%s: the tensors go from %g to %g along %c, the field from %g to %g", path,
          a->axis[k][0], end, "xyz"[k], low, high);
  }
  return FG_STATUS_OK;
}

fg_status fg__tensors_create(fg_tensors **out, fg_context *context, fg_field *row[2],
                             const char *name, const fg_field *field)
{
  *out = NULL;
  fg_tensors *t = fg__allocate(1, sizeof *t);
  if (!t) {
    fg_field_destroy(row[0]);
    fg_field_destroy(row[1]);
    return fg__fail_memory(context, "tensors", sizeof *t);
  }
  memcpy(t->row, row, sizeof t->row);
  fg_status status = check_place(t, context, name, field);
  if (!status)
    status = check_samples(t, context, name);
  if (status) {
    fg_tensors_destroy(t);
    return status;
  }
  t->law.name = "of the file";
  t->law.tensor = tensor_at;
  t->law.data = t;
  t->law.identity =
      fg__mix(fg__field_fingerprint(t->row[0])) ^ fg__field_fingerprint(t->row[1]);
  *out = t;
  return FG_STATUS_OK;
}

void fg_tensors_destroy(fg_tensors *tensors)
{
  if (!tensors)
    return;
  for (int k = 0; k < 2; ++k)
    fg_field_destroy(tensors->row[k]);
  free(tensors);
}

const fg_energy_law *fg_tensors_law(const fg_tensors *tensors)
{
  return &tensors->law;
}
