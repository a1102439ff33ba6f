#include "field/plane.h"

#include <math.h>

static bool scale_to_one(double out[3], const double v[3])
{
  double largest = 0.0;
  for (int k = 0; k < 3; ++k)
    largest = fabs(v[k]) > largest || isnan(v[k]) ? fabs(v[k]) : largest;
  if (!(largest > 0.0) || isinf(largest))
    return false;
  for (int k = 0; k < 3; ++k)
    out[k] = v[k] / largest;
  const double length = fg__length(out);
  for (int k = 0; k < 3; ++k)
    out[k] /= length;
  return true;
}

/* Of components that differ by less the first, or the last, counts as the largest: those
 * of a fitted normal are rounded. */
static const double ALIKE = 1.0 + 1e-4;

bool fg__plane_basis_of(fg__plane_basis *out, const double normal[3])
{
  double *n = out->normal;
  if (!scale_to_one(n, normal))
    return false;
  out->across = 2;
  for (int k = 1; k >= 0; --k)
    if (fabs(n[k]) > ALIKE * fabs(n[out->across]))
      out->across = k;
  out->axis[0] = out->across == 0 ? 1 : 0;
  out->axis[1] = out->across == 2 ? 1 : 2;
  const int first = ALIKE * fabs(n[out->axis[1]]) < fabs(n[out->axis[0]]) ? 1 : 0;
  const int nearer = out->axis[first], other = out->axis[1 - first];
  double along[3], *second = out->direction[1 - first];
  for (int k = 0; k < 3; ++k)
    along[k] = (k == nearer ? 1.0 : 0.0) - n[nearer] * n[k];
  scale_to_one(out->direction[first], along);
  fg__cross(n, out->direction[first], along);
  scale_to_one(second, along);
  if (second[other] < 0.0)
    for (int k = 0; k < 3; ++k)
      second[k] = -second[k];
  for (int k = 0; k < 3; ++k) /* no negative zeros */
    second[k] += 0.0;
  return true;
}

bool fg__plane_is_axis(const fg__plane_basis *basis, int k)
{
  return basis->direction[k][basis->axis[k]] >= 1.0;
}
