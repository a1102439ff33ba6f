#include <math.h>

#include "tensor/length.h"
#include "tensor/tensor.h"

/* Garcke et al. 2000, section 3: an interface across the streamline costs 1, along it a.
 * Where the velocity vanishes there is no direction to prefer, and a tends to 1. */
void fg__tensor_along(double tensor[6], const double direction[3], double anisotropy)
{
  double speed = fg__length(direction[0], direction[1], direction[2]);
  if (!(speed > 0.0)) {
    fg__tensor_unit(tensor);
    return;
  }
  double x = direction[0] / speed, y = direction[1] / speed, z = direction[2] / speed;
  tensor[0] = x * x + anisotropy * y * y + anisotropy * z * z;
  tensor[1] = (1.0 - anisotropy) * x * y;
  tensor[2] = y * y + anisotropy * x * x + anisotropy * z * z;
  tensor[3] = z * z + anisotropy * x * x + anisotropy * y * y;
  tensor[4] = (1.0 - anisotropy) * x * z;
  tensor[5] = (1.0 - anisotropy) * y * z;
}

/* How much the direction of a place counts. Smoothing gives the full anisotropy back from
 * fg__full_coherence on: so, where directions agree, 1 - a is in proportion to the speed
 * below the given one. */
static double weight_of(const fg_energy_place *place, double isotropic_below)
{
  double v[3] = {0.0, 0.0, 0.0};
  fg_field_velocity(place->field, place->position, v);
  double speed = fg__length(v[0], v[1], v[2]);
  return fmin(fg__full_coherence * speed / isotropic_below, 1.0);
}

static void tensor_at(double tensor[6], const fg_energy_place *place, const void *data)
{
  fg__tensor_along(tensor, place->direction, place->anisotropy);
  if (!data)
    return;
  double unit[6], weight = weight_of(place, *(const double *)data);
  fg__tensor_unit(unit);
  for (int k = 0; k < 6; ++k)
    tensor[k] = weight * tensor[k] + (1.0 - weight) * unit[k];
}

const fg_energy_law fg__law_flow = {.name = "flow", .tensor = tensor_at, .axes = true};
